// SPDX-License-Identifier: LGPL-2.1-or-later

// Shapes of eight distorted cells at once against those of single cells: mean gradients, volumes
// and their rates, forces of bulk viscosity, mobilities, edges; and that hourglass modes see no
// linear motion.

#include <touchstone/explicit/block_kernels.h>
#include <touchstone/explicit/one_point_kernels.h>
#include <touchstone/explicit/stable_step.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

using namespace Touchstone;
using namespace dealii;

namespace
{
  constexpr unsigned int n_nodes = NodeMap::nodes_per_cell;
  std::mt19937           generator(11);

  double
  random(const double low, const double high)
  {
    return low + (high - low) * generator() / double(generator.max());
  }

  /** Eight boxes with moved corners, each with nodes of its own, and a displacement and a velocity
   * of them. */
  struct Cells
  {
    BlockNodes nodes;
    double     x[dim * n_nodes * n_lanes], u[dim * n_nodes * n_lanes], v[dim * n_nodes * n_lanes];

    Cells()
    {
      for (unsigned int c = 0; c < n_lanes; ++c)
        {
          const double sizes[dim] = {random(0.5, 2.), random(0.5, 2.), random(0.5, 2.)};
          for (unsigned int a = 0; a < n_nodes; ++a)
            {
              // In another order than that of the cells.
              const unsigned int n = nodes.of_cells[c][a] = a * n_lanes + c;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  x[dim * n + d] = sizes[d] * (((a >> d) & 1) + random(-0.15, 0.15));
                  u[dim * n + d] = random(-0.05, 0.05);
                  v[dim * n + d] = random(-1., 1.);
                }
            }
        }
    }

    Tensor<1, dim>
    get(const double *field, const unsigned int c, const unsigned int a) const
    {
      Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = field[dim * nodes.of_cells[c][a] + d];
      return result;
    }
  };

  void
  report(const std::string &what, const double error)
  {
    std::cout << what << ": " << (error < 1e-13 ? "the same" : "DIFFERENT") << std::endl;
  }
} // namespace



int
main()
{
  MaterialParameters material;
  material.young_modulus = 1.;
  const ExplicitParameters parameters;
  const Viscosity          viscosity(material, parameters, 0.);
  double gradients = 0., modes = 0., rates = 0., forces = 0., mobilities = 0., edges = 0.;
  for (unsigned int k = 0; k < 100; ++k)
    {
      const Cells            cells;
      OnePointBlock          block;
      OnePointBlock::Control control;
      block.reinit(cells.nodes, cells.x, control);
      BlockKernels::Derivatives derivatives;
      double                    rate[n_lanes], periods[n_lanes], square[n_lanes], volume[n_lanes],
        masses[n_nodes][n_lanes], force[dim * n_nodes][n_lanes], mobility[2 * dim][n_lanes];
      for (double &period : periods)
        period = random(0.5, 1.);
      for (auto &of_nodes : masses)
        for (double &mass : of_nodes)
          mass = random(1., 2.);
      BlockKernels::set_volume_rates(cells.nodes, cells.x, cells.u, cells.v, rate, derivatives);
      BlockKernels::set_viscous_forces(viscosity, periods, rate, derivatives, force);
      BlockKernels::set_mobilities(cells.nodes, cells.x, cells.u, masses, volume, mobility);
      BlockKernels::set_edge_rates(cells.nodes, cells.x, cells.u, cells.v, square);
      for (unsigned int c = 0; c < n_lanes; ++c)
        {
          Hexahedron::Corners X, x;
          for (unsigned int a = 0; a < n_nodes; ++a)
            {
              X[a] = cells.get(cells.x, c, a);
              x[a] = X[a] + cells.get(cells.u, c, a);
            }
          const auto at_rest = volume_derivative(X), now = volume_derivative(x);
          double     V = 0., present = 0., change = 0., fastest = 0.;
          for (unsigned int a = 0; a < n_nodes; ++a)
            {
              V += at_rest[a] * X[a] / dim;
              present += now[a] * x[a] / dim;
              change += now[a] * cells.get(cells.v, c, a);
            }
          rates                            = std::max({rates,
                                                       std::abs(rate[c] - change / present),
                                                       std::abs(volume[c] - present),
                                                       std::abs(block.volume[c] - V)});
          const double            pressure = viscosity(rate[c], periods[c]) * rate[c];
          SymmetricTensor<2, dim> G;
          for (unsigned int a = 0; a < n_nodes; ++a)
            for (unsigned int i = 0; i < dim; ++i)
              {
                gradients =
                  std::max(gradients, std::abs(block.gradient(a, i, c) - at_rest[a][i] / V));
                forces = std::max(forces, std::abs(force[dim * a + i][c] - pressure * now[a][i]));
                for (unsigned int j = i; j < dim; ++j)
                  G[i][j] += now[a][i] * now[a][j] / masses[a][c];
                if (const unsigned int e = a | (1U << i); e != a)
                  fastest =
                    std::max(fastest,
                             (cells.get(cells.v, c, e) - cells.get(cells.v, c, a)).norm_square() /
                               (x[e] - x[a]).norm_square());
              }
          edges = std::max(edges, std::abs(square[c] / fastest - 1.));
          for (unsigned int i = 0; i < dim; ++i)
            mobilities =
              std::max({mobilities,
                        std::abs(mobility[i][c] - G[i][i]),
                        std::abs(mobility[dim + i][c] - G[(i + 1) % dim][(i + 2) % dim])});
          for (unsigned int m = 0; m < OnePointBlock::n_modes; ++m)
            {
              Tensor<1, dim> of_positions;
              double         sum = 0.;
              for (unsigned int a = 0; a < n_nodes; ++a)
                {
                  of_positions += block.mode(m, a, c) * X[a];
                  sum += block.mode(m, a, c);
                }
              modes = std::max({modes, of_positions.norm(), std::abs(sum)});
            }
        }
    }
  report("Mean gradients", gradients);
  report("Volumes and their rates", rates);
  report("Forces of bulk viscosity", forces);
  report("Mobilities", mobilities);
  report("Rates of edges", edges);
  report("Hourglass modes of linear motions and none", modes);
  return 0;
}
