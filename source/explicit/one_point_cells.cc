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
  {
    const double factor = body.hourglass_factor();
    if (body.hourglass != BodyParameters::Hourglass::none)
      {
        control.young = body.material.young_modulus;
        control.shear = body.material.shear_modulus();
      }
    if (body.hourglass == BodyParameters::Hourglass::stiffness)
      {
        control.young *= factor;
        control.shear *= factor;
      }
    else if (body.hourglass == BodyParameters::Hourglass::viscous)
      {
        control.damping = factor;
        control.density = body.material.density;
      }
  }



  const OnePointBlock &
  OnePointCells::block_of(const unsigned int c) const
  {
    BlockNodes space;
    if (present != c / n_cells)
      block.reinit(block_nodes(c / n_cells * n_cells, space), numbers_of(map.positions()), control);
    present = c / n_cells;
    return block;
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
    const auto   springs = body.hourglass != BodyParameters::Hourglass::stiffness ? Hourglass::none
                           : finite ? Hourglass::convected
                                    : Hourglass::fixed;
    double       sums[dim * OnePointBlock::n_sums][n_cells], forces[dim * n_nodes][n_cells],
      gradient[dim * dim][n_cells], stress[dim * dim][n_cells], rates[dim * dim][n_cells],
      rate[n_cells], periods[n_cells];
    BlockNodes space;
    for (unsigned int first = 0; first < cells.size(); first += n_cells)
      {
        const BlockNodes    &nodes  = block_nodes(first, space);
        const unsigned int   n_used = std::min<unsigned int>(n_cells, cells.size() - first);
        const OnePointBlock &shapes = block_of(first);
        OnePointKernels::set_gradients(nodes, shapes, numbers_of(u), sums, gradient);
        const unsigned int lane =
          law.respond(gradient, step, n_used, states.block(first / n_cells), stress);
        if (lane < n_used)
          failed = std::min(failed, first + lane);
        OnePointKernels::set_forces(shapes, sums, gradient, stress, springs, forces);
        scatter(nodes.of_cells, n_used, forces, force);
        if (!damped && bulk == nullptr)
          continue;
        OnePointKernels::set_gradients(nodes, shapes, numbers_of(v), sums, rates);
        if (bulk != nullptr)
          {
            for (unsigned int l = 0; l < n_cells; ++l)
              periods[l] = bulk->periods[first + std::min(l, n_used - 1)];
            OnePointKernels::set_volume_rates(rates, finite ? gradient : nullptr, rate, stress);
            OnePointKernels::set_viscous_stress(bulk->viscosity, periods, rate, stress);
          }
        else
          std::fill_n(&stress[0][0], dim * dim * n_cells, 0.);
        OnePointKernels::set_forces(
          shapes, sums, rates, stress, damped ? Hourglass::damped : Hourglass::none, forces);
        scatter(nodes.of_cells, n_used, forces, viscous);
      }
    return failed;
  }



  void
  OnePointCells::set_volume_rates(const NodeField     &u,
                                  const NodeField     &v,
                                  std::vector<double> &result)
  {
    double sums[dim * OnePointBlock::n_sums][n_cells], gradient[dim * dim][n_cells],
      rates[dim * dim][n_cells], derivatives[dim * dim][n_cells], rate[n_cells];
    BlockNodes space;
    result.resize(cells.size());
    for (unsigned int first = 0; first < cells.size(); first += n_cells)
      {
        const BlockNodes    &nodes  = block_nodes(first, space);
        const OnePointBlock &shapes = block_of(first);
        if (finite)
          OnePointKernels::set_gradients(nodes, shapes, numbers_of(u), sums, gradient);
        OnePointKernels::set_gradients(nodes, shapes, numbers_of(v), sums, rates);
        OnePointKernels::set_volume_rates(rates, finite ? gradient : nullptr, rate, derivatives);
        std::copy_n(rate, std::min<std::size_t>(n_cells, cells.size() - first), &result[first]);
      }
  }



  double
  OnePointCells::stiffness(const unsigned int c, const unsigned int m, const unsigned int i) const
  {
    if (body.hourglass != BodyParameters::Hourglass::stiffness)
      return 0.;
    const OnePointBlock &of = block_of(c);
    return OnePointBlock::warps(m, i) ? of.warping[i][c % n_cells]
                                      : OnePointBlock::part(m) * of.bending[i][c % n_cells];
  }



  Tensor<2, dim>
  OnePointCells::displacement_gradient(const unsigned int c, const NodeField &u) const
  {
    const OnePointBlock &of   = block_of(c);
    const unsigned int   lane = c % n_cells;
    Tensor<2, dim>       result;
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result[i][j] += u[nodes(c)[a]][i] * of.gradient(a, j, lane);
    return result;
  }



  double
  OnePointCells::hourglass_energy(const unsigned int    c,
                                  const NodeField      &u,
                                  const Tensor<2, dim> &H) const
  {
    const OnePointBlock &of   = block_of(c);
    const unsigned int   lane = c % n_cells;
    double               sum  = 0.;
    for (unsigned int m = 0; m < n_modes; ++m)
      {
        Tensor<1, dim> q, warp;
        for (unsigned int a = 0; a < n_nodes; ++a)
          q += OnePointBlock::sign(dim + m, a) * u[nodes(c)[a]];
        for (unsigned int j = 0; j < dim; ++j)
          warp[j] = of.positions[dim * (dim + m) + j][lane];
        q -= H * warp;
        if (finite)
          q += transpose(H) * q;
        for (unsigned int i = 0; i < dim; ++i)
          {
            Tensor<1, dim> edge;
            for (unsigned int j = 0; j < dim; ++j)
              edge[j] = of.positions[dim * i + j][lane];
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
          Tensor<2, dim> H      = displacement_gradient(c, u);
          const double   volume = block_of(c).volume[c % n_cells];
          energies.hourglass.add(hourglass_energy(c, u, H));
          if (law.law() == nullptr)
            {
              const SymmetricTensor<2, dim> strain = symmetrize(H);
              energies.strain.add(
                volume * (0.5 * lambda * trace(strain) * trace(strain) + mu * (strain * strain)));
              continue;
            }
          if (finite)
            H += Tensor<2, dim>(unit_symmetric_tensor<dim>());
          states.get(c, begin.data());
          if (!finite || determinant(H) > 0.)
            law.law()->respond({H, begin.data(), 0.}, Demand::energy, response, end.data());
          energies.strain.add(volume * response.elastic_energy);
          if (states.size() > 0)
            energies.plastic.add(volume * law.law()->dissipation(begin.data()));
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
