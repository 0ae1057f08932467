// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/vectorised.h>
#include <touchstone/explicit/gauss_cells.h>
#include <touchstone/explicit/kernel_cells.h>
#include <touchstone/explicit/one_point_cells.h>
#include <touchstone/explicit/stable_step.h>
#include <touchstone/solid/finite_strain_kernel.h>
#include <touchstone/solid/small_strain_kernel.h>

#include <algorithm>
#include <cmath>

// Cells of explicit dynamics with the elements of implicit runs (doc/explicit.md, section 5).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_unknowns = CellStiffness::n;

    /** Elements of finite strain have a counterpart of small strain with the same stiffness at
     * rest. */
    ElementType
    counterpart(const ElementType type)
    {
      return type == ElementType::f_bar ? ElementType::b_bar : type;
    }

    std::unique_ptr<CellKernel>
    make_kernel(const BodyParameters &body)
    {
      if (body.material.finite_strain())
        return std::make_unique<FiniteStrainKernel>(1, body.element(), body.material);
      return std::make_unique<SmallStrainKernel>(1, body.element(), body.material);
    }

    /** y = K x */
    TOUCHSTONE_VECTORISED
    void
    multiply(const double *K, const double *x, double *y)
    {
      for (unsigned int i = 0; i < n_unknowns; ++i)
        y[i] = 0.;
      // K is symmetric: by columns, which are vectors.
      for (unsigned int k = 0; k < n_unknowns; ++k)
        for (unsigned int i = 0; i < n_unknowns; ++i)
          y[i] += K[n_unknowns * k + i] * x[k];
    }
  } // namespace



  KernelCells::KernelCells(const NodeMap                   &map,
                           const std::vector<unsigned int> &cells,
                           const BodyParameters            &body)
    : CellForces(map, cells, body)
    , kernel(make_kernel(body))
    , states(cells.size(), kernel->material().get(), kernel->n_quadrature_points())
    , elastic(counterpart(body.element()), body.material)
    , before(states.size())
  {
  }



  double
  KernelCells::go_to(const unsigned int c, const NodeField &u)
  {
    double               positions[n_unknowns], displacement[n_unknowns];
    const NodeMap::Cell &one = cell(c);
    for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
      for (unsigned int d = 0; d < dim; ++d)
        {
          positions[dim * a + d]    = map.positions()[one.nodes[a]][d];
          displacement[dim * a + d] = u[one.nodes[a]][d];
        }
    states.get(c, before.data());
    return kernel->reinit(positions, displacement, before.data());
  }



  unsigned int
  KernelCells::subtract_forces(const NodeField           &u,
                               const NodeField           &v,
                               const double               step,
                               const BulkViscosity *const bulk,
                               NodeField                 &force,
                               NodeField                 &viscous)
  {
    unsigned int failed = numbers::invalid_unsigned_int;
    kernel->set_step_length(step);
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        if (!(go_to(c, u) > 0.))
          {
            failed = std::min(failed, c);
            continue;
          }
        subtract(cell(c), kernel->force(), force);
        if (!kernel->solved())
          failed = std::min(failed, c);
        states.put(c, kernel->present().data());
      }
    kernel->set_step_length(0.);
    subtract_viscosity(u, v, bulk, viscous);
    return failed;
  }



  void
  KernelCells::add_energies(const NodeField &u, CellEnergies &energies)
  {
    const unsigned int n_state = states.size() / kernel->n_quadrature_points();
    for (unsigned int c = 0; c < cells.size(); ++c)
      if (cell(c).owned)
        {
          go_to(c, u);
          energies.strain.add(kernel->elastic_energy());
          if (n_state > 0)
            for (unsigned int q = 0; q < kernel->n_quadrature_points(); ++q)
              energies.plastic.add(kernel->weight(q) *
                                   kernel->material()->dissipation(&before[q * n_state]));
        }
  }



  void
  KernelCells::square_frequencies(const NodeField                &u,
                                  const std::vector<NodalMasses> &masses,
                                  std::vector<double>            &result)
  {
    // The tangent of a law without history; with history, where cells that flow are softer than
    // when they unload, the elastic stiffness of the present shape. It is costly, and scaled by an
    // estimate from the shape alone until that has changed by this part.
    constexpr double change = 0.02;
    result.resize(cells.size());
    if (exact.empty())
      {
        exact.resize(cells.size());
        estimate.assign(cells.size(), 0.);
      }
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const bool   small = !body.material.finite_strain();
        const auto   x     = corners(map, cell(c), small ? nullptr : &u);
        const double now   = one_point_frequency(x, body.material, masses[c]);
        if (!(std::abs(now / estimate[c] - 1.) < change))
          {
            if (states.size() > 0 || small)
              {
                elastic.reinit(x);
                exact[c] = largest_eigenvalue([&](const unsigned int i,
                                                  const unsigned int j) { return elastic(i, j); },
                                              masses[c]);
              }
            else if (go_to(c, u) > 0.)
              {
                const std::vector<double> &K = kernel->stiffness();
                exact[c] =
                  largest_eigenvalue([&](const unsigned int i,
                                         const unsigned int j) { return K[n_unknowns * i + j]; },
                                     masses[c]);
              }
            estimate[c] = now;
          }
        result[c] = exact[c] * (now / estimate[c]);
      }
  }



  ElasticCells::ElasticCells(const NodeMap                   &map,
                             const std::vector<unsigned int> &cells,
                             const BodyParameters            &body)
    : CellForces(map, cells, body)
    , stiffness(cells.size() * n * n)
  {
    CellStiffness one(body.element(), body.material);
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        one.reinit(corners(map, cell(c)));
        // The symmetric part: the condensation of modes leaves round-off.
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            stiffness[(c * n + i) * n + j] = 0.5 * (one(i, j) + one(j, i));
      }
  }



  unsigned int
  ElasticCells::subtract_forces(const NodeField &u,
                                const NodeField &v,
                                const double /*step*/,
                                const BulkViscosity *const bulk,
                                NodeField                 &force,
                                NodeField                 &viscous)
  {
    double x[n], y[n];
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const NodeMap::Cell &one = cell(c);
        for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            x[dim * a + d] = u[one.nodes[a]][d];
        multiply(&stiffness[c * n * n], x, y);
        subtract(one, y, force);
      }
    subtract_viscosity(u, v, bulk, viscous);
    return numbers::invalid_unsigned_int;
  }



  void
  ElasticCells::add_energies(const NodeField &u, CellEnergies &energies)
  {
    double x[n], y[n];
    for (unsigned int c = 0; c < cells.size(); ++c)
      if (const NodeMap::Cell &one = cell(c); one.owned)
        {
          for (unsigned int i = 0; i < n; ++i)
            x[i] = u[one.nodes[i / dim]][i % dim];
          multiply(&stiffness[c * n * n], x, y);
          double sum = 0.;
          for (unsigned int i = 0; i < n; ++i)
            sum += 0.5 * x[i] * y[i];
          energies.strain.add(sum);
        }
  }



  void
  ElasticCells::square_frequencies(const NodeField & /*u*/,
                                   const std::vector<NodalMasses> &masses,
                                   std::vector<double>            &result)
  {
    if (exact.size() != cells.size())
      for (unsigned int c = 0; c < cells.size(); ++c)
        exact.push_back(
          largest_eigenvalue([&](const unsigned int i,
                                 const unsigned int j) { return stiffness[(c * n + i) * n + j]; },
                             masses[c]));
    result = exact;
  }



  double
  CellForces::volume_rate(const unsigned int             c,
                          const NodeField               &u,
                          const NodeField               &v,
                          std::array<Tensor<1, dim>, 8> &derivative) const
  {
    const auto x  = corners(map, cell(c), body.material.finite_strain() ? &u : nullptr);
    derivative    = volume_derivative(x);
    double volume = 0., rate = 0.;
    for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
      {
        volume += derivative[a] * x[a] / dim;
        rate += derivative[a] * v[cell(c).nodes[a]];
      }
    return volume > 0. ? rate / volume : 0.;
  }



  void
  CellForces::subtract_viscosity(const NodeField           &u,
                                 const NodeField           &v,
                                 const BulkViscosity *const bulk,
                                 NodeField                 &viscous) const
  {
    std::array<Tensor<1, dim>, 8> derivative;
    for (unsigned int c = 0; bulk != nullptr && c < cells.size(); ++c)
      {
        const double rate     = volume_rate(c, u, v, derivative);
        const double pressure = bulk->viscosity(rate, bulk->periods[c]) * rate;
        for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
          viscous[cell(c).nodes[a]] -= pressure * derivative[a];
      }
  }



  std::unique_ptr<CellForces>
  CellForces::make(const NodeMap                   &map,
                   const std::vector<unsigned int> &cells,
                   const BodyParameters            &body)
  {
    if (body.element() == ElementType::one_point)
      return std::make_unique<OnePointCells>(map, cells, body);
    if (body.material.linear())
      return std::make_unique<ElasticCells>(map, cells, body);
    if (GaussCells::suits(body))
      return std::make_unique<GaussCells>(map, cells, body);
    return std::make_unique<KernelCells>(map, cells, body);
  }
} // namespace Touchstone
