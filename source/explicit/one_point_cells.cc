// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/cell_stiffness.h>
#include <touchstone/explicit/one_point_cells.h>
#include <touchstone/explicit/one_point_kernels.h>
#include <touchstone/explicit/one_point_plasticity.h>
#include <touchstone/explicit/stable_step.h>
#include <touchstone/solid/finite_strain_kernel.h>
#include <touchstone/solid/hardening_law.h>
#include <touchstone/solid/small_strain_kernel.h>

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

    /** Tensors of a field stand one after the other. */
    const double *
    numbers_of(const NodeField &field)
    {
      return reinterpret_cast<const double *>(field.data());
    }
  } // namespace



  OnePointCells::OnePointCells(const NodeMap                   &map,
                               const std::vector<unsigned int> &cells,
                               const BodyParameters            &body)
    : CellForces(map, cells, body)
    , finite(body.material.finite_strain())
  {
    const std::string &name = body.material.law.name;
    formulas                = body.material.linear()  ? Formulas::linear_elastic
                              : name == "neo-Hookean" ? Formulas::neo_hookean
                                                      : Formulas::any_law;
    // The law that the elements of implicit runs have.
    if (finite)
      law = FiniteStrainKernel(1, ElementType::full, body.material).material();
    else if (!body.material.linear())
      law = SmallStrainKernel(1, ElementType::full, body.material).material();
    n_state = law ? law->n_state() : 0;
    blocks.resize((cells.size() + n_cells - 1) / n_cells);
    // The formulas for eight cells are those of constant and of linear isotropic hardening.
    const std::string &hardening = body.material.hardening_type.name;
    if (finite && n_state > 0 && law->plastic() && body.material.kinematic_modulus == 0. &&
        (hardening == "none" || hardening == "linear"))
      formulas = Formulas::von_mises;
    present.resize(blocks.size() * n_cells * n_state);
    state_before.resize(n_state);
    state_after.resize(n_state);
    std::vector<double> virgin(n_state);
    if (n_state > 0)
      law->start(virgin.data());
    for (unsigned int c = 0; c < blocks.size() * n_cells; ++c)
      for (unsigned int k = 0; k < n_state; ++k)
        variable(c, k) = virgin[k];
    kept = present;
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
        const bool viscous = body.hourglass == BodyParameters::Hourglass::viscous;
        const bool stiff   = body.hourglass == BodyParameters::Hourglass::stiffness;
        // Exact for bending of a box: the normal strains of the modes with the modulus of bars.
        // What is left, warping, has the stiffness of the twist of a plate.
        const double shear    = body.material.shear_modulus();
        const double shortest = std::min({square[0], square[1], square[2]}),
                     longest  = std::max({square[0], square[1], square[2]});
        const double warping  = shear * V * shortest / (12. * longest * longest);
        for (unsigned int m = 0; m < n_modes; ++m)
          {
            double softest = std::numeric_limits<double>::max();
            for (unsigned int i = 0; i < dim; ++i)
              {
                const bool   across = m < dim && i == (m + 2) % dim;
                const double k =
                  across ? warping : young * V / ((m < dim ? 48. : 144.) * square[i]);
                softest                            = std::min(softest, k);
                block.stiffness[dim * m + i][lane] = stiff ? factor * k : 0.;
              }
            // The part of critical damping of the softest direction, 8 c / mass = 2 xi omega.
            block.viscosity[m][lane] =
              viscous ? factor * 0.25 * mass * std::sqrt(n_nodes * softest / mass) : 0.;
          }
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            block.edges[dim * i + j][lane] = edges[i][j] / std::sqrt(square[i]);
      }
  }



  unsigned int
  OnePointCells::respond(const unsigned int b, const double step, const double *marked)
  {
    unsigned int       failed = numbers::invalid_unsigned_int;
    const unsigned int first  = b * n_cells;
    MaterialResponse   response;
    for (unsigned int lane = 0; lane < n_cells && first + lane < cells.size(); ++lane)
      {
        if (marked != nullptr && marked[lane] == 0.)
          continue;
        Tensor<2, dim> F;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            F[i][j] = gradient[dim * i + j][lane] + (finite && i == j ? 1. : 0.);
        get_state(present, first + lane, state_before.data());
        response.solved = !finite || determinant(F) > 0.;
        if (response.solved)
          law->respond({F, state_before.data(), step},
                       Demand::stress,
                       response,
                       state_after.data());
        if (response.solved)
          for (unsigned int k = 0; k < n_state; ++k)
            variable(first + lane, k) = state_after[k];
        else
          failed = std::min(failed, first + lane);
        for (unsigned int k = 0; k < dim * dim; ++k)
          stress[k][lane] = response.solved ? response.stress[k / dim][k % dim] : 0.;
      }
    return failed;
  }



  unsigned int
  OnePointCells::subtract_forces(const NodeField &u,
                                 const NodeField &v,
                                 const double     step,
                                 NodeField       &force,
                                 NodeField       &viscous)
  {
    unsigned int      failed = numbers::invalid_unsigned_int;
    const double      mu = body.material.shear_modulus(), kappa = body.material.bulk_modulus();
    const bool        damped = body.hourglass == BodyParameters::Hourglass::viscous;
    double            forces[dim * n_nodes][n_cells], J[n_cells];
    VonMisesConstants constants{mu, kappa, 0., 0.};
    if (formulas == Formulas::von_mises)
      {
        const YieldStress yield = body.material.hardening->at(0.);
        constants.yield_stress  = yield.value;
        constants.hardening     = yield.slope;
      }
    const double *const displacement = numbers_of(u), *const velocity = numbers_of(v);
    for (unsigned int b = 0; b < blocks.size(); ++b)
      {
        const OnePointBlock &block = blocks[b];
        const unsigned int   first = b * n_cells;
        OnePointKernels::set_gradients(block, displacement, gradient);
        if (formulas == Formulas::linear_elastic)
          OnePointKernels::linear_elastic(kappa - 2. / 3. * mu, mu, gradient, stress);
        else if (formulas == Formulas::neo_hookean)
          {
            OnePointKernels::neo_hookean(kappa, mu, gradient, stress, J);
            for (unsigned int lane = 0; lane < n_cells && first + lane < cells.size(); ++lane)
              if (!(J[lane] > 0.))
                failed = std::min(failed, first + lane);
          }
        else if (formulas == Formulas::von_mises)
          {
            // Cells beyond the series of the formulas are few; failures show there.
            von_mises_cycle(constants,
                            gradient,
                            reinterpret_cast<double(*)[n_cells]>(&present[b * n_state * n_cells]),
                            stress,
                            J);
            if (std::any_of(J, J + n_cells, [](const double beyond) { return beyond != 0.; }))
              failed = std::min(failed, respond(b, step, J));
          }
        else
          failed = std::min(failed, respond(b, step));
        OnePointKernels::set_forces(block,
                                    displacement,
                                    gradient,
                                    stress,
                                    finite ? OnePointKernels::Hourglass::convected
                                           : OnePointKernels::Hourglass::fixed,
                                    forces);
        scatter(b, forces, force);
        if (damped)
          {
            const double none[dim * dim][n_cells] = {};
            OnePointKernels::set_gradients(block, velocity, gradient);
            OnePointKernels::set_forces(
              block, velocity, gradient, none, OnePointKernels::Hourglass::damped, forces);
            scatter(b, forces, viscous);
          }
      }
    return failed;
  }



  void
  OnePointCells::scatter(const unsigned int b,
                         const double (*forces)[n_cells],
                         NodeField &sum) const
  {
    for (unsigned int lane = 0; lane < n_cells && b * n_cells + lane < cells.size(); ++lane)
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int i = 0; i < dim; ++i)
          sum[blocks[b].nodes[lane][a]][i] -= forces[dim * a + i][lane];
  }



  void
  OnePointCells::add_viscosity(const NodeField           &u,
                               const NodeField           &v,
                               const Viscosity           &coefficients,
                               const std::vector<double> &squares,
                               NodeField                 &viscous)
  {
    double forces[dim * n_nodes][n_cells], rates[dim * dim][n_cells];
    double linear[n_cells], quadratic[n_cells], largest[n_cells];
    for (unsigned int b = 0; b < blocks.size(); ++b)
      {
        for (unsigned int lane = 0; lane < n_cells; ++lane)
          {
            const double square =
              squares[std::min<unsigned int>(b * n_cells + lane, cells.size() - 1)];
            linear[lane]    = coefficients.linear / std::sqrt(square);
            quadratic[lane] = coefficients.quadratic / square;
            largest[lane]   = coefficients.largest(square);
          }
        OnePointKernels::set_gradients(blocks[b], numbers_of(v), rates);
        if (finite)
          OnePointKernels::set_gradients(blocks[b], numbers_of(u), gradient);
        OnePointKernels::viscous(
          finite ? gradient : nullptr, rates, linear, quadratic, largest, stress);
        OnePointKernels::set_forces(
          blocks[b], numbers_of(v), rates, stress, OnePointKernels::Hourglass::none, forces);
        scatter(b, forces, viscous);
      }
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
            sum += 0.5 * block.stiffness[dim * m + i][lane] * (edge * q) * (edge * q);
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
    std::vector<double> begin(n_state), end(n_state);
    for (unsigned int c = 0; c < cells.size(); ++c)
      if (cell(c).owned)
        {
          const OnePointBlock &block = blocks[c / n_cells];
          const unsigned int   lane  = c % n_cells;
          Tensor<2, dim>       H     = displacement_gradient(c, u);
          energies.hourglass.add(hourglass_energy(c, u, H));
          if (!law)
            {
              const SymmetricTensor<2, dim> strain = symmetrize(H);
              energies.strain.add(
                block.volume[lane] *
                (0.5 * lambda * trace(strain) * trace(strain) + mu * (strain * strain)));
              continue;
            }
          if (finite)
            H += Tensor<2, dim>(unit_symmetric_tensor<dim>());
          get_state(present, c, begin.data());
          if (!finite || determinant(H) > 0.)
            law->respond({H, begin.data(), 0.}, Demand::energy, response, end.data());
          energies.strain.add(block.volume[lane] * response.elastic_energy);
          if (n_state > 0)
            energies.plastic.add(block.volume[lane] * law->dissipation(begin.data()));
        }
  }



  std::vector<double>
  OnePointCells::state(const unsigned int c) const
  {
    // The bodies have the history of eight points, which are all alike here.
    std::vector<double> result(n_nodes * n_state);
    for (unsigned int q = 0; q < n_nodes; ++q)
      get_state(kept, c, result.data() + q * n_state);
    return result;
  }



  void
  OnePointCells::get_state(const std::vector<double> &states,
                           const unsigned int         c,
                           double                    *values) const
  {
    for (unsigned int k = 0; k < n_state; ++k)
      values[k] = states[(c / n_cells * n_state + k) * n_cells + c % n_cells];
  }



  void
  OnePointCells::set_state(const unsigned int c, const std::vector<double> &values)
  {
    AssertThrow(values.size() == n_nodes * n_state,
                ExcDimensionMismatch(values.size(), n_nodes * n_state));
    // The rest of the last block repeats the last cell.
    const unsigned int end = c + 1 == cells.size() ? blocks.size() * n_cells : c + 1;
    for (unsigned int other = c; other < end; ++other)
      for (unsigned int k = 0; k < n_state; ++k)
        kept[&variable(other, k) - present.data()] = variable(other, k) = values[k];
  }
} // namespace Touchstone
