// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/round_lattice.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <map>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Half width of the core and how far its sides bulge towards a circle
     * (0 to 1): a compromise between flat cells in the core's corners and thin
     * ones on its sides. */
    constexpr double core_width = 0.5;
    constexpr double core_bulge = 0.4;

    /** A lattice point of the core, or with a ring > 0 the one that has been
     * pushed outward from there by so many rings. */
    struct Key
    {
      std::array<int, 3> i;
      int                ring;

      bool
      operator<(const Key &other) const
      {
        return std::tie(i, ring) < std::tie(other.i, other.ring);
      }
    };
  } // namespace



  RoundLattice::RoundLattice(const unsigned int              dimensions,
                             const std::vector<std::string> &keep,
                             const unsigned int              core,
                             const unsigned int              rings,
                             const unsigned int              layers,
                             const double                    grading)
  {
    const double sides = dimensions == 2 ? 4. : 6.; // where rings stand on the core
    check_number_of_cells((2. * core) * (2. * core) * (dimensions == 2 ? layers : 2. * core) +
                          sides * (2. * core) * rings * (dimensions == 2 ? layers : 2. * core));
    const int          n = core;
    std::array<int, 3> lower{{0, 0, 0}}, upper{{n, n, static_cast<int>(layers)}};
    for (unsigned int d = 0; d < dimensions; ++d)
      {
        lower[d] = keep[d] == "+" ? 0 : -n;
        upper[d] = keep[d] == "-" ? 0 : n;
      }

    const std::vector<double> fractions = graded_positions(0., 1., rings, grading);
    const auto                position  = [&](const Key &key) {
      Tensor<1, 3> straight, direction;
      double       size = 0.;
      for (unsigned int d = 0; d < dimensions; ++d)
        {
          straight[d] = static_cast<double>(key.i[d]) / n;
          size        = std::max(size, std::abs(straight[d]));
        }
      // Equal angles on the surface; the tangent of zero stays exactly zero,
      // which keeps the cut planes plane.
      if (size > 0.)
        for (unsigned int d = 0; d < dimensions; ++d)
          direction[d] = std::tan(numbers::PI / 4. * straight[d] / size);
      if (size > 0.)
        direction /= direction.norm();

      // Inside the core a blend of the square lattice and circles; outside of it straight lines
      // from the side of the core to the surface.
      const Tensor<1, 3> inside =
        core_width * ((1. - core_bulge) * straight + core_bulge * size * direction);
      const double fraction = fractions[key.ring];
      Tensor<1, 3> x        = (1. - fraction) * inside + fraction * direction;
      if (dimensions == 2)
        x[2] = static_cast<double>(key.i[2]) / layers;
      return x;
    };

    // Points are numbered by integer keys, so common points of neighbouring stacks are found
    // without comparing coordinates.
    std::map<Key, unsigned int> numbers;
    const auto                  vertex = [&](const Key &key) {
      const auto [where, is_new] = numbers.insert({key, points.size()});
      if (is_new)
        points.push_back(position(key));
      return where->second;
    };

    std::array<int, 3> c;
    for (c[2] = lower[2]; c[2] < upper[2]; ++c[2])
      for (c[1] = lower[1]; c[1] < upper[1]; ++c[1])
        for (c[0] = lower[0]; c[0] < upper[0]; ++c[0])
          {
            CellData<3> cell;
            for (int v = 0; v < 8; ++v)
              cell.vertices[v] = vertex({{{c[0] + v % 2, c[1] + v / 2 % 2, c[2] + v / 4}}, 0});
            cells.push_back(cell);

            // A stack of cells on each outer side of the core fills the space up to the surface.
            for (unsigned int d = 0; d < dimensions; ++d)
              for (const int side : {-1, 1})
                if (c[d] == (side > 0 ? n - 1 : -n))
                  for (unsigned int ring = 0; ring < rings; ++ring)
                    {
                      CellData<3> outer;
                      for (int v = 0; v < 8; ++v)
                        {
                          const int local[3] = {v % 2, v / 2 % 2, v / 4};
                          Key       key{c, 0};
                          for (unsigned int e = 0; e < 3; ++e)
                            key.i[e] += local[e];
                          key.i[d]          = side * n;
                          key.ring          = ring + (side > 0 ? local[d] : 1 - local[d]);
                          outer.vertices[v] = vertex(key);
                        }
                      cells.push_back(outer);
                    }
          }
  }
} // namespace Touchstone
