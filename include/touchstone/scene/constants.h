// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_constants_h
#define touchstone_scene_constants_h

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The key "Constants" of a scene: names for numbers, which formulas and numbers of the
   * scene may use.
   *
   * Their values are put into the scene where it is read. All that follows, checkpoints and the
   * printed scene included, has numbers and does not know the constants.
   */
  class Constants
  {
  public:
    /**
     * @brief Add a list such as "R = 10, p0 = 5*R".
     *
     * A name that is there already takes its new expression if that comes from a file which
     * includes the other one, or from the command line.
     * @param depth    How many files include the one that the list stands in; less than zero for
     *                 the command line.
     * @param location For messages.
     * @throws InputError for names that cannot be, and for those that are defined twice.
     */
    void
    define(const std::string &list, int depth, const std::string &location);

    /** @brief Compute all values, in whatever order they need each other.
     * @throws InputError for what cannot be computed. */
    void
    evaluate();

    /** @brief The formula with the values of the constants in it. */
    std::string
    insert(const std::string &formula) const;

    /**
     * @brief The value of a number that is given as an expression, as text that reads back to the
     * same number.
     * @param whole It must be a whole number; one that is off by round-off is rounded.
     * @param list  There may be several, with commas or semicolons between them.
     * @return nothing if any cannot be computed.
     */
    std::optional<std::string>
    numbers(const std::string &text, bool whole, bool list) const;

    /** @brief Names, in their order. */
    std::vector<std::string>
    names() const;

    /** @brief Call when the scene is read. @throws InputError for a constant of the command line
     * that nothing has used: it would change nothing without a word. */
    void
    check_used() const;

  private:
    struct Constant
    {
      std::string name, expression;
      int         depth;
      std::string location;
      /** Defined by a file, whether or not the command line has changed it. */
      bool                     in_file;
      std::optional<double>    value;
      bool                     in_progress = false;
      std::vector<std::size_t> needs;
      /** Looking into a scene does not change it, but it is known thereafter what is used. */
      mutable bool used = false;
    };
    std::vector<Constant> all;

    std::optional<std::size_t>
    find(const std::string &name) const;
    double
    value(std::size_t number);
    void
    mark_used(std::size_t number) const;
    /** Each name of a constant in @p formula by what @p text_of says of its number. */
    std::string
    replace(const std::string                             &formula,
            const std::function<std::string(std::size_t)> &text_of) const;
  };
} // namespace Touchstone

#endif
