// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/one_point_cells.h>
#include <touchstone/explicit/one_point_kernels.h>
#include <touchstone/explicit/stable_step.h>

#include <algorithm>
#include <cmath>

// Hexahedra with one point of integration, eight at a time (doc/explicit.md, section 5).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_cells = OnePointBlock::n_cells, n_nodes = OnePointBlock::n_nodes,
                           n_modes = OnePointBlock::n_modes;
  } // namespace



  OnePointCells::OnePointCells(const NodeMap                   &map,
                               const std::vector<unsigned int> &cells,
                               const BodyParameters            &body)
    : CellForces(map, cells, body)
    , law(body)
    , finite(law.finite_strain())
    , states(cells.size(), law.law(), 1)
    , blocks((cells.size() + n_cells - 1) / n_cells)
  {
    for (unsigned int b = 0; b < blocks.size(); ++b)
      set_block(blocks[b], b * n_cells);
  }



  void
  OnePointCells::set_block(OnePointBlock &block, const unsigned int first)
  {
    const double young  = body.material.young_modulus;
    const double factor = body.hourglass_factor();
    for (unsigned int lane = 0; lane < n_cells; ++lane)
      {
        // The last block is filled with copies, whose results are dropped.
        const NodeMap::Cell &one = cell(std::min<unsigned int>(first + lane, cells.size() - 1));
        const auto           x   = corners(map, one);
        const auto           b   = volume_derivative(x);
        double               V   = 0.;
        for (unsigned int a = 0; a < n_nodes; ++a)
          V += b[a] * x[a] / dim;
        block.volume[lane] = V;
        Tensor<2, dim> edges; // mean edge vectors
        for (unsigned int a = 0; a < n_nodes; ++a)
          {
            block.nodes[lane][a] = one.nodes[a];
            for (unsigned int i = 0; i < dim; ++i)
              {
                block.gradients[dim * a + i][lane] = b[a][i] / V;
                edges[i] += (((a >> i) & 1) ? 0.25 : -0.25) * x[a];
              }
          }
        double square[dim], mass = body.material.density * V / n_nodes;
        for (unsigned int i = 0; i < dim; ++i)
          square[i] = edges[i].norm_square();
        for (unsigned int m = 0; m < n_modes; ++m)
          {
            for (unsigned int i = 0; i < dim; ++i)
              {
                block.warp[dim * m + i][lane] = 0.;
                for (unsigned int a = 0; a < n_nodes; ++a)
                  block.warp[dim * m + i][lane] += hourglass_sign(m, a) * x[a][i];
              }
          }
        // Exact for bending of a box: the normal strains of the modes with the modulus of bars.
        // What is left, warping, has the stiffness of the twist of a plate.
        const double shear    = body.material.shear_modulus();
        const double shortest = std::min({square[0], square[1], square[2]}),
                     longest  = std::max({square[0], square[1], square[2]});
        double k[n_modes];
        for (unsigned int i = 0; i < dim; ++i)
          k[i] = young * V / (48. * square[i]);
        k[dim] = shear * V * shortest / (12. * longest * longest);
        for (unsigned int m = 0; m < n_modes; ++m)
          {
            double softest = std::numeric_limits<double>::max();
            for (unsigned int i = 0; i < dim; ++i)
              softest =
                std::min(softest,
                         OnePointBlock::warps(m, i) ? k[dim] : OnePointBlock::part(m) * k[i]);
            // The part of critical damping of the softest direction, 8 c / mass = 2 xi omega.
            block.control[m][lane] = body.hourglass == BodyParameters::Hourglass::none ? 0.
                                     : body.hourglass == BodyParameters::Hourglass::viscous
                                       ? factor * 0.25 * mass * std::sqrt(n_nodes * softest / mass)
                                       : factor * k[m];
          }
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            block.edges[dim * i + j][lane] = edges[i][j] / std::sqrt(square[i]);
      }
  }



  unsigned int
  OnePointCells::subtract_forces(const NodeField           &u,
                                 const NodeField           &v,
                                 const double               step,
                                 const BulkViscosity *const bulk,
                                 NodeField                 &force,
                                 NodeField                 &viscous)
  {
    using Hourglass      = OnePointKernels::Hourglass;
    unsigned int failed  = numbers::invalid_unsigned_int;
    const bool   damped  = body.hourglass == BodyParameters::Hourglass::viscous;
    const auto   control = body.hourglass != BodyParameters::Hourglass::stiffness ? Hourglass::none
                           : finite ? Hourglass::convected
                                    : Hourglass::fixed;
    double       values[dim * n_nodes][n_cells], forces[dim * n_nodes][n_cells],
      gradient[dim * dim][n_cells], stress[dim * dim][n_cells];
    for (unsigned int b = 0; b < blocks.size(); ++b)
      {
        const OnePointBlock &block  = blocks[b];
        const unsigned int   first  = b * n_cells;
        const unsigned int   n_used = std::min<unsigned int>(n_cells, cells.size() - first);
        OnePointKernels::gather(block, numbers_of(u), values);
        OnePointKernels::set_gradients(block, values, gradient);
        const unsigned int lane = law.respond(gradient, step, n_used, states.block(b), stress);
        if (lane < n_used)
          failed = std::min(failed, first + lane);
        OnePointKernels::set_forces(block, values, gradient, stress, control, forces);
        scatter(block.nodes, n_used, forces, force);
        if (!damped && bulk == nullptr)
          continue;
        OnePointKernels::gather(block, numbers_of(v), values);
        if (bulk != nullptr)
          {
            double periods[n_cells];
            for (unsigned int l = 0; l < n_cells; ++l)
              periods[l] = bulk->periods[first + std::min(l, n_used - 1)];
            OnePointKernels::set_viscous_forces(
              block, values, finite ? gradient : nullptr, bulk->viscosity, periods, forces);
            scatter(block.nodes, n_used, forces, viscous);
          }
        if (damped)
          {
            std::fill_n(&stress[0][0], dim * dim * n_cells, 0.);
            OnePointKernels::set_gradients(block, values, gradient);
            OnePointKernels::set_forces(block, values, gradient, stress, Hourglass::damped, forces);
            scatter(block.nodes, n_used, forces, viscous);
          }
      }
    return failed;
  }



  double
  OnePointCells::stiffness(const unsigned int c, const unsigned int m, const unsigned int i) const
  {
    if (body.hourglass != BodyParameters::Hourglass::stiffness)
      return 0.;
    const auto &control = blocks[c / n_cells].control;
    return OnePointBlock::warps(m, i) ? control[dim][c % n_cells]
                                      : OnePointBlock::part(m) * control[i][c % n_cells];
  }



  Tensor<2, dim>
  OnePointCells::displacement_gradient(const unsigned int c, const NodeField &u) const
  {
    const OnePointBlock &block = blocks[c / n_cells];
    const unsigned int   lane  = c % n_cells;
    Tensor<2, dim>       result;
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result[i][j] += u[block.nodes[lane][a]][i] * block.gradients[dim * a + j][lane];
    return result;
  }



  double
  OnePointCells::hourglass_energy(const unsigned int    c,
                                  const NodeField      &u,
                                  const Tensor<2, dim> &H) const
  {
    const OnePointBlock &block = blocks[c / n_cells];
    const unsigned int   lane  = c % n_cells;
    double               sum   = 0.;
    for (unsigned int m = 0; m < n_modes; ++m)
      {
        Tensor<1, dim> q, warp;
        for (unsigned int a = 0; a < n_nodes; ++a)
          q += hourglass_sign(m, a) * u[block.nodes[lane][a]];
        for (unsigned int j = 0; j < dim; ++j)
          warp[j] = block.warp[dim * m + j][lane];
        q -= H * warp;
        if (finite)
          q += transpose(H) * q;
        for (unsigned int i = 0; i < dim; ++i)
          {
            Tensor<1, dim> edge;
            for (unsigned int j = 0; j < dim; ++j)
              edge[j] = block.edges[dim * i + j][lane];
            sum += 0.5 * stiffness(c, m, i) * (edge * q) * (edge * q);
          }
      }
    return sum;
  }



  void
  OnePointCells::add_energies(const NodeField &u, CellEnergies &energies)
  {
    const double mu     = body.material.shear_modulus(),
                 lambda = body.material.bulk_modulus() - 2. / 3. * mu;
    MaterialResponse    response;
    std::vector<double> begin(states.size()), end(states.size());
    for (unsigned int c = 0; c < cells.size(); ++c)
      if (cell(c).owned)
        {
          const OnePointBlock &block = blocks[c / n_cells];
          const unsigned int   lane  = c % n_cells;
          Tensor<2, dim>       H     = displacement_gradient(c, u);
          energies.hourglass.add(hourglass_energy(c, u, H));
          if (law.law() == nullptr)
            {
              const SymmetricTensor<2, dim> strain = symmetrize(H);
              energies.strain.add(
                block.volume[lane] *
                (0.5 * lambda * trace(strain) * trace(strain) + mu * (strain * strain)));
              continue;
            }
          if (finite)
            H += Tensor<2, dim>(unit_symmetric_tensor<dim>());
          states.get(c, begin.data());
          if (!finite || determinant(H) > 0.)
            law.law()->respond({H, begin.data(), 0.}, Demand::energy, response, end.data());
          energies.strain.add(block.volume[lane] * response.elastic_energy);
          if (states.size() > 0)
            energies.plastic.add(block.volume[lane] * law.law()->dissipation(begin.data()));
        }
  }



  std::vector<double>
  OnePointCells::state(const unsigned int c) const
  {
    // The bodies have the history of eight points, which are all alike here.
    const std::vector<double> one = states.committed_state(c);
    std::vector<double>       result;
    for (unsigned int q = 0; q < n_nodes; ++q)
      result.insert(result.end(), one.begin(), one.end());
    return result;
  }



  void
  OnePointCells::set_state(const unsigned int c, const std::vector<double> &values)
  {
    AssertThrow(values.size() == n_nodes * states.size(),
                ExcDimensionMismatch(values.size(), n_nodes * states.size()));
    states.set(c, {values.begin(), values.begin() + states.size()});
  }
} // namespace Touchstone
