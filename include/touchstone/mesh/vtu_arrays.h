// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_vtu_arrays_h
#define touchstone_mesh_vtu_arrays_h

#include <cstddef>
#include <iosfwd>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief The arrays of an unstructured grid in VTK's XML format: as text, in base64, or appended
   * raw or in base64, compressed by zlib or not. */
  class VtuArrays
  {
  public:
    /** @throws MeshFileError if the file is none, or damaged, or of several pieces. */
    explicit VtuArrays(std::istream &in);

    std::size_t
    n_points() const
    {
      return points;
    }

    std::size_t
    n_cells() const
    {
      return cells;
    }

    /** @brief The numbers of an array, or null; arrays of points and cells with one component,
     * and the array of Points by any name. */
    const std::vector<double> *
    find(const std::string &section, const std::string &name) const;

    /** @brief The arrays of points and cells, for messages. */
    std::string
    names() const;

  private:
    using Attributes = std::map<std::string, std::string>;

    std::string                                                        text;
    std::size_t                                                        points = 0, cells = 0;
    std::map<std::pair<std::string, std::string>, std::vector<double>> values;
    /** Of the element VTKFile. */
    Attributes file;
    /** Where the appended bytes begin, and how they are written. */
    std::size_t appended = 0;
    std::string appended_encoding;

    void
    read_file();
    void
    read_array(const std::string &section, const Attributes &array, std::size_t begin);
    /** The bytes of an array that is not text. */
    std::string
    decode(std::size_t begin, bool base64) const;
  };
} // namespace Touchstone

#endif
