// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/kernel_cells.h>
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
  } // namespace



  KernelCells::KernelCells(const NodeMap                   &map,
                           const std::vector<unsigned int> &cells,
                           const BodyParameters            &body)
    : CellForces(map, cells, body)
    , kernel(make_kernel(body))
    , states(cells.size(), kernel->material().get(), kernel->n_quadrature_points())
    , smallest_ratio(cells.size(), 1.)
    , elastic(counterpart(body.element()), body.material)
    , before(states.size())
  {
  }



  double
  KernelCells::go_to(const unsigned int c, const NodeField &u)
  {
    double                    positions[n_unknowns], displacement[n_unknowns];
    const NodeMap::CellNodes &of_cell = nodes(c);
    for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
      for (unsigned int d = 0; d < dim; ++d)
        {
          positions[dim * a + d]    = map.positions()[of_cell[a]][d];
          displacement[dim * a + d] = u[of_cell[a]][d];
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
        const double smallest = go_to(c, u);
        if (!(smallest > 0.))
          {
            failed = std::min(failed, c);
            continue;
          }
        if (body.material.finite_strain())
          smallest_ratio[c] = smallest;
        subtract(nodes(c), kernel->force(), force);
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
  KernelCells::square_frequencies(const NodeField &u, std::vector<double> &result)
  {
    // The tangent of a law without history; with history, where cells that flow or relax are softer
    // than when they unload, the elastic stiffness of the present shape. It is costly, and scaled
    // by an estimate from the shape alone until that has changed by this part, or the volume at a
    // point has, which mean gradients do not see.
    constexpr double change = 0.02;
    set_one_point_frequencies(u, result);
    if (exact.empty())
      {
        exact.resize(cells.size());
        estimate.assign(cells.size(), 0.);
        ratio_then.assign(cells.size(), 1.);
      }
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const bool   small = !body.material.finite_strain();
        const double now   = result[c];
        if (!(std::abs(now / estimate[c] - 1.) < change &&
              std::abs(smallest_ratio[c] / ratio_then[c] - 1.) < change))
          {
            if (kernel->material()->stiffest_at_rest())
              {
                if (body.element() == ElementType::f_bar)
                  elastic.reinit(corners(map, nodes(c), &u), corners(map, nodes(c)));
                else
                  elastic.reinit(corners(map, nodes(c), small ? nullptr : &u));
                exact[c] = largest_eigenvalue([&](const unsigned int i,
                                                  const unsigned int j) { return elastic(i, j); },
                                              masses(c));
              }
            else if (go_to(c, u) > 0.)
              {
                const std::vector<double> &K = kernel->stiffness();
                exact[c] =
                  largest_eigenvalue([&](const unsigned int i,
                                         const unsigned int j) { return K[n_unknowns * i + j]; },
                                     masses(c));
              }
            estimate[c] = now;
            // Of this state: smallest_ratio is unknown until the first forces of a resumed run.
            if (!small)
              ratio_then[c] = go_to(c, u);
          }
        result[c] = exact[c] * (now / estimate[c]);
      }
  }
} // namespace Touchstone
