// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_preview_h
#define touchstone_output_preview_h

#include <touchstone/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief Faces of a boundary, or the part of an obstacle that is opposite to slave faces. */
  struct PreviewPart
  {
    /** Empty for an obstacle. */
    std::string body, name;
    /** What it is to contact pairs: "slave of fit". */
    std::vector<std::string> roles;

    std::vector<dealii::Point<3>> points;
    /** Corners around the face, seen from outside counter-clockwise. */
    std::vector<std::array<unsigned int, 4>> quads;

    /** @brief "BODY/NAME", or "obstacle NAME". */
    std::string
    title() const;
  };

  /** @brief A drawing of the parts from two sides, with their names, as SVG. */
  std::string
  draw_preview(const std::string &title, const std::vector<PreviewPart> &parts);

  /** @brief Turn the file @p drawing (SVG) into the file @p image (PNG) by the program
   * rsvg-convert.
   * @return whether it is there and did. */
  bool
  draw_image(const std::string &drawing, const std::string &image);

  /**
   * @brief Option --preview: the meshes at t = 0 with the names of boundaries, into the output
   * folder: preview.vtm with a block for the cells of each body, each boundary and each
   * obstacle, the drawing preview.svg and, where rsvg-convert is installed, the image preview.png.
   *
   * Each rank makes the whole mesh, and the first one writes.
   *
   * @param folder_of_scene For mesh files with relative names.
   * @return what was written, as sentences.
   * @throws InputError for a bad scene; OutputError
   */
  std::vector<std::string>
  write_preview(const Scene &scene, const std::string &folder_of_scene, MPI_Comm communicator);
} // namespace Touchstone

#endif
