// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/body_mesh.h>

namespace Touchstone
{
  namespace
  {
    /** @brief A unit box whose top face slopes in x. */
    class Wedge : public Geometry
    {
    public:
      void
      declare(dealii::ParameterHandler &prm) override
      {
        prm.add_parameter("Slope", slope, "Rise of the top face along x; no unit.");
        prm.add_parameter("Cells",
                          cells,
                          "Number of cells in x, y, z.",
                          dealii::Patterns::List(dealii::Patterns::Integer(1), 3, 3));
      }

      void
      check(const std::string &section) const override
      {
        if (!(slope > -1.))
          throw InputError(section,
                           "Slope",
                           dealii::Patterns::Tools::to_string(slope),
                           "the top face cuts the bottom",
                           "take more than -1");
      }

      BodyMesh
      create(const double factor, const std::string &, const std::string &) const override
      {
        const std::array<unsigned int, 3> n = {{scaled_cells(cells[0], factor),
                                                scaled_cells(cells[1], factor),
                                                scaled_cells(cells[2], factor)}};
        BodyMesh                          mesh =
          make_block(n,
                     false,
                     [&](const unsigned int i, const unsigned int j, const unsigned int k) {
                       const double x = double(i) / n[0], y = double(j) / n[1],
                                    z = double(k) / n[2];
                       return dealii::Point<3>(x, y, z * (1. + slope * x));
                     },
                     {{0, 1, 2, 3, 4, 5}});
        mesh.boundary_names = {
          {"left", 0}, {"right", 1}, {"front", 2}, {"back", 3}, {"bottom", 4}, {"top", 5}};
        return mesh;
      }

    private:
      double                    slope = 0.;
      std::vector<unsigned int> cells = {1, 1, 1};
    };

    const GeometryRegistry::Entry<Wedge> wedge("wedge", "A unit box whose top slopes in x.");
  } // namespace
} // namespace Touchstone
