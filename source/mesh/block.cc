// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/body_mesh.h>

#include <deal.II/base/geometry_info.h>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** @brief A hexahedral block between given corners. */
    class Block : public Geometry
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        prm.add_parameter("Corners",
                          corners,
                          "Four corners, counter-clockwise as seen from where 'Extrusion' points "
                          "to; or eight, then the last four lie opposite to the first four in "
                          "the same order. Points x, y, z, separated by semicolons; length.",
                          Patterns::List(Patterns::List(Patterns::Double(), 3, 3, ","), 4, 8, ";"));
        prm.add_parameter("Extrusion",
                          extrusion,
                          "From each of four corners to the one opposite; x, y, z; length. Of no "
                          "meaning with eight.");
        prm.add_parameter("Cells",
                          cells,
                          "Number of cells from the first corner to the second, from the first "
                          "to the fourth, and from the first to the fifth (in the direction of "
                          "'Extrusion').",
                          Patterns::List(Patterns::Integer(1), 3, 3));
        prm.add_parameter("Grading",
                          grading,
                          "Size of the last cell over that of the first in these directions; the "
                          "cells between grow geometrically. No unit; 1 is uniform.",
                          Patterns::List(Patterns::Double(1e-6, 1e6), 3, 3));
      }

      void
      check(const std::string &section) const override
      {
        if (corners.size() != 4 && corners.size() != 8)
          throw InputError(section,
                           "Corners",
                           Patterns::Tools::to_string(corners),
                           "there are " + std::to_string(corners.size()) + " points",
                           "give four corners, or eight");
        // The block as one cell: straight edges stay, so its corners tell.
        BodyMesh one;
        for (unsigned int v = 0; v < 8; ++v)
          one.vertices.push_back(corner(v));
        one.cells.emplace_back();
        for (unsigned int v = 0; v < 8; ++v)
          one.cells[0].vertices[v] = v;
        const Orientation wrong = orientation(one);
        if (wrong.negative + wrong.distorted > 0)
          throw InputError(section,
                           "Corners",
                           Patterns::Tools::to_string(corners),
                           wrong.negative ? "the block is inside out"
                                          : "the block has a corner that is flat or re-entrant",
                           "give the corners counter-clockwise, convex, and 'Extrusion' or the "
                           "last four on the side from which they are counter-clockwise");
      }

      BodyMesh
      create(const double factor, const std::string &, const std::string &) const override
      {
        std::array<unsigned int, 3>        n;
        std::array<std::vector<double>, 3> positions;
        for (unsigned int d = 0; d < 3; ++d)
          {
            n[d]         = scaled_cells(cells[d], factor);
            positions[d] = graded_positions(0., 1., n[d], grading[d]);
          }

        // The block is meshed on the unit cube, with the grading of each direction, and mapped to
        // its corners.
        BodyMesh mesh =
          make_block(n,
                     false,
                     [&](const unsigned int i, const unsigned int j, const unsigned int k) {
                       const Point<3> unit(positions[0][i], positions[1][j], positions[2][k]);
                       // Trilinear interpolation between the corners: edges are straight, faces
                       // may be warped.
                       Point<3> x;
                       for (unsigned int v = 0; v < 8; ++v)
                         x += GeometryInfo<3>::d_linear_shape_function(unit, v) * corner(v);
                       return x;
                     },
                     {{0, 1, 2, 3, 4, 5}});
        // The same ids as those of a box, so that a box can be replaced by a block.
        mesh.boundary_names = {
          {"left", 0}, {"right", 1}, {"front", 2}, {"back", 3}, {"bottom", 4}, {"top", 5}};
        return mesh;
      }

    private:
      std::vector<Point<3>>     corners   = {Point<3>(0., 0., 0.),
                                             Point<3>(1., 0., 0.),
                                             Point<3>(1., 1., 0.),
                                             Point<3>(0., 1., 0.)};
      Tensor<1, 3>              extrusion = Tensor<1, 3>({0., 0., 1.});
      std::vector<unsigned int> cells     = {1, 1, 1};
      std::vector<double>       grading   = {1., 1., 1.};

      /** Corner @p v in the order of deal.II's cells. */
      Point<3>
      corner(const unsigned int v) const
      {
        // Users go round the face, deal.II goes in rows.
        const unsigned int round[4] = {0, 1, 3, 2};
        if (corners.size() == 8)
          return corners[round[v % 4] + v / 4 * 4];
        return corners[round[v % 4]] + (v / 4) * extrusion;
      }
    };

    const GeometryRegistry::Entry<Block> block_entry(
      "block",
      "A block with straight edges between any four or eight corners, with the boundaries "
      "front (from the first corner to the second), right (second to third), back (third "
      "to fourth), left (fourth to first), bottom (the first four corners), top (those "
      "opposite), numbered as in a box.");
  } // namespace
} // namespace Touchstone
