// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_gmsh_numbers_h
#define touchstone_mesh_gmsh_numbers_h

#include <touchstone/mesh/mesh_text.h>

namespace Touchstone
{
  /**
   * @brief The numbers of a .msh file, words in ASCII files and bytes in binary ones.
   *
   * Errors (MeshFileError) name the section, which is always the last argument.
   */
  class GmshNumbers
  {
  public:
    /** @param text Must live as long as this. */
    explicit GmshNumbers(MeshText &text)
      : text(text)
    {
    }

    /** @brief Read $MeshFormat, which decides how the others are read. */
    void
    read_format();

    /** @brief Zero before read_format(). Versions 2 and 4.1 are read; 4.0 has another layout of
     * entities and nodes. */
    double
    version() const
    {
      return format;
    }

    /** @brief Numbers are bytes: size_t, int and double of this machine. */
    bool
    binary() const
    {
      return has_bytes;
    }

    unsigned long
    size(const char *section);
    long
    integer(const char *section);
    double
    real(const char *section);
    /** @brief Numbers of entities and types, which have a sign in the format only. */
    unsigned long
    tag(const char *section);

  private:
    MeshText &text;
    double    format    = 0.;
    bool      has_bytes = false;

    template <class T>
    T
    value(const char *section);
  };
} // namespace Touchstone

#endif
