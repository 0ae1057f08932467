// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/cell_stiffness.h>
#include <touchstone/explicit/one_point_cells.h>
#include <touchstone/explicit/stable_step.h>
#include <touchstone/solid/finite_strain_kernel.h>
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
    using Lanes                    = OnePointBlock::Lanes;

    /** Sign of hourglass mode @p m, xi eta, eta zeta, zeta xi, xi eta zeta, at node @p a. */
    constexpr int
    sign(const unsigned int m, const unsigned int a)
    {
      const int x = a & 1 ? 1 : -1, y = a & 2 ? 1 : -1, z = a & 4 ? 1 : -1;
      return m == 0 ? x * y : m == 1 ? y * z : m == 2 ? z * x : x * y * z;
    }

    __attribute__((always_inline)) inline Lanes
    load(const double *values)
    {
      return *reinterpret_cast<const Lanes *>(values);
    }

    __attribute__((always_inline)) inline void
    store(const Lanes &lanes, double *values)
    {
      *reinterpret_cast<Lanes *>(values) = lanes;
    }

    /** Component @p i of the nodes of all cells. */
    __attribute__((always_inline)) inline void
    gather(const OnePointBlock &block,
           const double        *field,
           const unsigned int   i,
           Lanes (&x)[n_nodes])
    {
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          double values[n_cells];
          for (unsigned int c = 0; c < n_cells; ++c)
            values[c] = field[dim * block.nodes[c][a] + i];
          x[a] = load(values);
        }
    }

    /** The sums of the hourglass modes over the nodes. */
    __attribute__((always_inline)) inline void
    hourglass_sums(const Lanes (&x)[n_nodes], Lanes (&q)[n_modes])
    {
      // Sums and differences along xi, then of those along eta and zeta.
      const Lanes d0 = x[1] - x[0], d1 = x[3] - x[2], d2 = x[5] - x[4], d3 = x[7] - x[6],
                  s0 = x[1] + x[0], s1 = x[3] + x[2], s2 = x[5] + x[4], s3 = x[7] + x[6];
      q[0] = (d1 - d0) + (d3 - d2);
      q[1] = (s3 - s2) - (s1 - s0);
      q[2] = (d2 + d3) - (d0 + d1);
      q[3] = (d3 - d2) - (d1 - d0);
    }

    /** Displacement gradients, [3i+j], of eight cells. */
    TOUCHSTONE_VECTORISED
    void
    set_gradients(const OnePointBlock &block, const double *u, double (*gradient)[n_cells])
    {
      for (unsigned int i = 0; i < dim; ++i)
        {
          Lanes x[n_nodes];
          gather(block, u, i, x);
          for (unsigned int j = 0; j < dim; ++j)
            {
              Lanes sum = x[0] * load(block.gradients[j]);
              for (unsigned int a = 1; a < n_nodes; ++a)
                sum += x[a] * load(block.gradients[dim * a + j]);
              store(sum, gradient[dim * i + j]);
            }
        }
    }

    /** Forces of stress and hourglass control on the nodes, [3a+i], of eight cells, and those of
     * viscous control. */
    TOUCHSTONE_VECTORISED
    void
    set_forces(const OnePointBlock &block,
               const double        *u,
               const double (*gradient)[n_cells],
               const double (*stress)[n_cells],
               const double (*coefficient)[n_cells],
               double (*force)[n_cells])
    {
      const Lanes volume = load(block.volume);
      for (unsigned int i = 0; i < dim; ++i)
        {
          Lanes x[n_nodes], q[n_modes], P[dim];
          gather(block, u, i, x);
          hourglass_sums(x, q);
          for (unsigned int j = 0; j < dim; ++j)
            P[j] = volume * load(stress[dim * i + j]);
          for (unsigned int m = 0; m < n_modes; ++m)
            {
              // What constant strain and rotation contribute is taken out.
              for (unsigned int j = 0; j < dim; ++j)
                q[m] -= load(block.warp[dim * m + j]) * load(gradient[dim * i + j]);
              q[m] *= load(coefficient[m]);
              for (unsigned int j = 0; j < dim; ++j)
                P[j] -= load(block.warp[dim * m + j]) * q[m];
            }
          for (unsigned int a = 0; a < n_nodes; ++a)
            {
              Lanes f = P[0] * load(block.gradients[dim * a]) +
                        P[1] * load(block.gradients[dim * a + 1]) +
                        P[2] * load(block.gradients[dim * a + 2]);
              for (unsigned int m = 0; m < n_modes; ++m)
                f = sign(m, a) > 0 ? f + q[m] : f - q[m];
              store(f, force[dim * a + i]);
            }
        }
    }

    TOUCHSTONE_VECTORISED
    void
    linear_elastic(const double lambda,
                   const double mu,
                   const double (*gradient)[n_cells],
                   double (*stress)[n_cells])
    {
      const Lanes volumetric = lambda * (load(gradient[0]) + load(gradient[4]) + load(gradient[8]));
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            Lanes s = mu * (load(gradient[dim * i + j]) + load(gradient[dim * j + i]));
            if (i == j)
              s += volumetric;
            store(s, stress[dim * i + j]);
          }
    }

    /** First Piola-Kirchhoff stress, see neo_hookean.cc; @p J gets the determinants. */
    TOUCHSTONE_VECTORISED
    void
    neo_hookean(const double kappa,
                const double mu,
                const double (*gradient)[n_cells],
                double (*stress)[n_cells],
                double *J)
    {
      Lanes F[dim * dim], norm = {};
      for (unsigned int k = 0; k < dim * dim; ++k)
        {
          F[k] = load(gradient[k]);
          if (k % (dim + 1) == 0)
            F[k] += 1.;
          norm += F[k] * F[k];
        }
      // Cofactors: J F^{-T}.
      Lanes H[dim * dim];
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            const unsigned int p = (i + 1) % dim, q = (i + 2) % dim, r = (j + 1) % dim,
                               s = (j + 2) % dim;
            H[dim * i + j] = F[dim * p + r] * F[dim * q + s] - F[dim * p + s] * F[dim * q + r];
          }
      const Lanes det = F[0] * H[0] + F[1] * H[1] + F[2] * H[2];
      store(det, J);
      double root[n_cells];
      for (unsigned int c = 0; c < n_cells; ++c)
        root[c] = std::cbrt(J[c]);
      const Lanes power = load(root), m = mu / (power * power),
                  p = (0.5 * kappa * (det * det - 1.) - m * (1. / 3.) * norm) / det;
      for (unsigned int k = 0; k < dim * dim; ++k)
        store(m * F[k] + p * H[k], stress[k]);
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
    present.resize(cells.size() * n_state);
    for (unsigned int c = 0; c < cells.size() && n_state > 0; ++c)
      law->start(&present[c * n_state]);
    kept = present;
    blocks.resize((cells.size() + n_cells - 1) / n_cells);
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
                  block.warp[dim * m + i][lane] += sign(m, a) * x[a][i];
              }
            // Exact for bending of a box along the longer of the mode's two directions.
            const double longest     = m < dim ? std::max(square[m], square[(m + 1) % dim])
                                               : 3. * std::max({square[0], square[1], square[2]});
            const double k           = young * V / (48. * longest);
            const bool   viscous     = body.hourglass == BodyParameters::Hourglass::viscous;
            const bool   stiff       = body.hourglass == BodyParameters::Hourglass::stiffness;
            block.stiffness[m][lane] = stiff ? factor * k : 0.;
            // The part of critical damping of that stiffness, 8 c / mass = 2 xi omega.
            block.viscosity[m][lane] =
              viscous ? factor * 0.25 * mass * std::sqrt(n_nodes * k / mass) : 0.;
          }
      }
  }



  unsigned int
  OnePointCells::respond(const unsigned int first, const double step)
  {
    unsigned int     failed = numbers::invalid_unsigned_int;
    MaterialResponse response;
    double           end[64];
    AssertThrow(n_state <= 64, ExcNotImplemented());
    for (unsigned int lane = 0; lane < n_cells && first + lane < cells.size(); ++lane)
      {
        Tensor<2, dim> F;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            F[i][j] = gradient[dim * i + j][lane] + (finite && i == j ? 1. : 0.);
        double *const state = present.data() + (first + lane) * n_state;
        response.solved     = !finite || determinant(F) > 0.;
        if (response.solved)
          law->respond({F, state, step}, Demand::stress, response, end);
        if (response.solved)
          std::copy(end, end + n_state, state);
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
    unsigned int failed = numbers::invalid_unsigned_int;
    const double mu = body.material.shear_modulus(), kappa = body.material.bulk_modulus();
    const bool   damped = body.hourglass == BodyParameters::Hourglass::viscous;
    double       forces[dim * n_nodes][n_cells], J[n_cells];
    // Tensors of a field stand one after the other.
    const double *const displacement = &u[0][0], *const velocity = &v[0][0];
    const auto scatter = [&](const OnePointBlock &block, const unsigned int first, NodeField &sum) {
      for (unsigned int lane = 0; lane < n_cells && first + lane < cells.size(); ++lane)
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            sum[block.nodes[lane][a]][i] -= forces[dim * a + i][lane];
    };
    for (unsigned int b = 0; b < blocks.size(); ++b)
      {
        const OnePointBlock &block = blocks[b];
        const unsigned int   first = b * n_cells;
        set_gradients(block, displacement, gradient);
        if (formulas == Formulas::linear_elastic)
          linear_elastic(kappa - 2. / 3. * mu, mu, gradient, stress);
        else if (formulas == Formulas::neo_hookean)
          {
            neo_hookean(kappa, mu, gradient, stress, J);
            for (unsigned int lane = 0; lane < n_cells && first + lane < cells.size(); ++lane)
              if (!(J[lane] > 0.))
                failed = std::min(failed, first + lane);
          }
        else
          failed = std::min(failed, respond(first, step));
        set_forces(block, displacement, gradient, stress, block.stiffness, forces);
        scatter(block, first, force);
        if (damped)
          {
            const double none[dim * dim][n_cells] = {};
            set_gradients(block, velocity, gradient);
            set_forces(block, velocity, gradient, none, block.viscosity, forces);
            scatter(block, first, viscous);
          }
      }
    return failed;
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



  void
  OnePointCells::add_energies(const NodeField &u, CellEnergies &energies)
  {
    const double mu     = body.material.shear_modulus(),
                 lambda = body.material.bulk_modulus() - 2. / 3. * mu;
    MaterialResponse    response;
    std::vector<double> end(n_state);
    for (unsigned int c = 0; c < cells.size(); ++c)
      if (cell(c).owned)
        {
          const OnePointBlock &block = blocks[c / n_cells];
          const unsigned int   lane  = c % n_cells;
          Tensor<2, dim>       H     = displacement_gradient(c, u);
          for (unsigned int m = 0; m < n_modes; ++m)
            for (unsigned int i = 0; i < dim; ++i)
              {
                double q = 0.;
                for (unsigned int a = 0; a < n_nodes; ++a)
                  q += sign(m, a) * u[block.nodes[lane][a]][i];
                for (unsigned int j = 0; j < dim; ++j)
                  q -= block.warp[dim * m + j][lane] * H[i][j];
                energies.hourglass.add(0.5 * block.stiffness[m][lane] * q * q);
              }
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
          const double *state = present.data() + c * n_state;
          if (!finite || determinant(H) > 0.)
            law->respond({H, state, 0.}, Demand::energy, response, end.data());
          energies.strain.add(block.volume[lane] * response.elastic_energy);
          if (n_state > 0)
            energies.plastic.add(block.volume[lane] * law->dissipation(state));
        }
  }



  std::vector<double>
  OnePointCells::state(const unsigned int c) const
  {
    // The bodies have the history of eight points, which are all alike here.
    std::vector<double> result;
    for (unsigned int q = 0; q < n_nodes; ++q)
      result.insert(result.end(),
                    present.begin() + c * n_state,
                    present.begin() + (c + 1) * n_state);
    return result;
  }



  void
  OnePointCells::set_state(const unsigned int c, const std::vector<double> &values)
  {
    AssertThrow(values.size() == n_nodes * n_state,
                ExcDimensionMismatch(values.size(), n_nodes * n_state));
    std::copy(values.begin(), values.begin() + n_state, present.begin() + c * n_state);
    std::copy(values.begin(), values.begin() + n_state, kept.begin() + c * n_state);
  }
} // namespace Touchstone
