// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/body_mesh.h>

#include <deal.II/base/numbers.h>
#include <deal.II/physics/transformations.h>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** @brief A box, graded and rotated if the user wants. */
    class Box : public Geometry
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        prm.add_parameter("Lower corner", lower, "Corner with the smallest x, y, z; length.");
        prm.add_parameter("Upper corner", upper, "Corner with the largest x, y, z; length.");
        prm.add_parameter("Cells",
                          cells,
                          "Number of cells in x, y, z.",
                          Patterns::List(Patterns::Integer(1), 3, 3));
        prm.add_parameter("Grading",
                          grading,
                          "Size of the last cell over that of the first in x, y, z; the "
                          "cells between grow geometrically. No unit; 1 is uniform.",
                          Patterns::List(Patterns::Double(1e-6, 1e6), 3, 3));
        prm.add_parameter("Rotation",
                          rotation,
                          "Angles by which the box is turned about its lower corner, about "
                          "the directions of x, then y, then z; degrees.");
      }

      void
      check(const std::string &section) const override
      {
        // An extent of zero or less would give cells without volume or inside out.
        for (unsigned int d = 0; d < 3; ++d)
          if (!(upper[d] > lower[d]))
            throw InputError(section,
                             "Upper corner",
                             Patterns::Tools::to_string(upper),
                             std::string("it is not above the lower corner in ") + "xyz"[d] + ".",
                             "make each coordinate larger than that of 'Lower corner' (" +
                               Patterns::Tools::to_string(lower) + ")");
      }

      BodyMesh
      create(const double factor, const std::string &, const std::string &) const override
      {
        std::array<unsigned int, 3>        n;
        std::array<std::vector<double>, 3> positions;
        for (unsigned int d = 0; d < 3; ++d)
          {
            n[d]         = scaled_cells(cells[d], factor);
            positions[d] = graded_positions(lower[d], upper[d], n[d], grading[d]);
          }

        // Rotations about fixed axes, the first applied first, hence from the left.
        Tensor<2, 3> turn = unit_symmetric_tensor<3>();
        for (unsigned int d = 0; d < 3; ++d)
          if (rotation[d] != 0.)
            {
              Point<3> axis;
              axis[d] = 1.;
              turn    = Physics::Transformations::Rotations::rotation_matrix_3d(axis,
                                                                             rotation[d] *
                                                                               numbers::PI / 180.) *
                     turn;
            }
        const bool turned = rotation.norm() > 0.;

        BodyMesh mesh =
          make_block(n,
                     false,
                     [&](const unsigned int i, const unsigned int j, const unsigned int k) {
                       const Point<3> x(positions[0][i], positions[1][j], positions[2][k]);
                       // A box that is not rotated gets its coordinates without the round-off of
                       // a product.
                       return turned ? Point<3>(lower + turn * (x - lower)) : x;
                     },
                     {{0, 1, 2, 3, 4, 5}});
        // Ids follow deal.II's order of the faces of a hyper-rectangle: lower before upper side,
        // x before y before z.
        mesh.boundary_names = {
          {"left", 0}, {"right", 1}, {"front", 2}, {"back", 3}, {"bottom", 4}, {"top", 5}};
        return mesh;
      }

    private:
      Point<3>                  lower   = Point<3>(0., 0., 0.);
      Point<3>                  upper   = Point<3>(1., 1., 1.);
      std::vector<unsigned int> cells   = {1, 1, 1};
      std::vector<double>       grading = {1., 1., 1.};
      Tensor<1, 3>              rotation;
    };

    const GeometryRegistry::Entry<Box>
      box_entry("box",
                "A box with the boundaries left, right (x), front, back (y), bottom, top (z), "
                "also called 0 to 5.");
  } // namespace
} // namespace Touchstone
