// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_mesh_text_h
#define touchstone_mesh_mesh_text_h

#include <deal.II/base/point.h>

#include <istream>
#include <stdexcept>
#include <string>

namespace Touchstone
{
  /** @brief What is wrong with a mesh file, where, and what helps. */
  class MeshFileError : public std::runtime_error
  {
  public:
    /** @param problem, remedy Sentences; the remedy without a capital and full stop. */
    explicit MeshFileError(const std::string &problem, std::string remedy = default_remedy);

    /** @brief The same with the line, counted from one, where it was found. */
    MeshFileError(unsigned int       line,
                  const std::string &problem,
                  std::string        remedy = default_remedy);

    static const char *const default_remedy;

    const std::string remedy;
  };

  /** @brief That a surface has an @p element other than quadrilaterals, which would mark nothing.
   */
  MeshFileError
  surface_error(const std::string &element);

  /** @brief Whole numbers and coordinates of a mesh file: the whole of @p word, or an error. */
  unsigned long
  whole_number(const std::string &word);
  double
  finite_number(const std::string &word);

  /** @brief The words of a mesh file, and the lines where they stand. */
  class MeshText
  {
  public:
    explicit MeshText(std::istream &in);

    /** @brief The next word. @return whether there is one */
    bool
    word(std::string &text);

    /** @brief The next word as what it should be.
     * @param what The section, for the message if there is none. */
    std::string
    text(const char *what);
    unsigned long
    number(const char *what);
    /** @brief A number that may be negative. */
    long
    signed_number(const char *what);
    double
    real(const char *what);
    dealii::Point<3>
    point(const char *what);

    /** @brief How many entries follow. Each takes two bytes and more: a damaged file
     * must not make the program exhaust the memory. */
    unsigned int
    announced(const char *what);

    /** @brief The same for a number that has been read. */
    unsigned int
    announced(const char *what, unsigned long n) const;

    /** @brief The next @p n bytes of a binary part, which has no words and lines. */
    void
    bytes(void *to, std::size_t n, const char *what);

    /** @brief Whatever follows the last word on its line. */
    std::string
    rest_of_line();

    /** @brief Go to the next line. */
    void
    next_line();

    /** @brief The first character of the next word, which stays there. */
    int
    next_character();

    /** @brief Whether the last word is the last of its line. */
    bool
    at_end_of_line();

    /** @brief Line of the last word, counted from one. */
    unsigned int
    line() const
    {
      return line_of_word;
    }

    /** @brief An error at the line of the last word. */
    [[noreturn]] void
    fail(const std::string &problem, const std::string &remedy = "") const;

    /** @brief That the file ends or is damaged here. */
    [[noreturn]] void
    fail_in(const char *what) const;

  private:
    std::istream &in;
    unsigned int  current_line = 1, line_of_word = 1;
  };
} // namespace Touchstone

#endif
