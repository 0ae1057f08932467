// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/error_estimator.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/numerics/error_estimator.h>

// Error indicators per cell for adaptive meshes (doc/theory.md, section 11, "Estimators"), as
// squares (energy); drive/refinement marks cells by them.
namespace Touchstone
{
  using namespace dealii;

  /** Kelly's estimator from the jumps of the displacement gradient across faces. deal.II's class
   * returns the root of h/24 int |[du/dn]|^2; Young's modulus of the body makes bodies of
   * different stiffness comparable. */
  dealii::Vector<double>
  jump_errors(const Solid &solid, const Vector &u)
  {
    const auto            &triangulation = solid.dof_handler.get_triangulation();
    dealii::Vector<double> result(triangulation.n_active_cells());
    // Bodies share no faces, so that they need not be told apart.
    dealii::Vector<float> errors(triangulation.n_active_cells());
    KellyErrorEstimator<dim>::estimate(
      solid.mapping, solid.dof_handler, QGauss<dim - 1>(solid.fe.degree + 1), {}, u, errors);
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const double error = errors(cell->active_cell_index());
          result(cell->active_cell_index()) =
            solid.bodies[cell->material_id()].material.young_modulus * error * error;
        }
    return result;
  }



  namespace
  {
    /** sigma : C^-1 : tau with the isotropic compliance, ((1 + nu) sigma : tau - nu tr sigma tr
     * tau) / E. It is that of the elastic law at small strain for all materials, as an indicator
     * needs no more. */
    double
    complementary_work(const MaterialParameters      &material,
                       const SymmetricTensor<2, dim> &sigma,
                       const SymmetricTensor<2, dim> &tau)
    {
      const double nu = material.poisson_ratio;
      return ((1. + nu) * (sigma * tau) - nu * trace(sigma) * trace(tau)) / material.young_modulus;
    }
  } // namespace



  // (sigma* - sigma) : C^-1 : (sigma* - sigma) with averages sigma* [31].
  dealii::Vector<double>
  recovery_errors(const Solid &solid, const Vector &u)
  {
    StressRecovery recovery(solid);
    PointStresses  points = recovery.of_cells(u);
    recovery.subtract(recovery.averages(points), points);
    dealii::Vector<double> result(solid.dof_handler.get_triangulation().n_active_cells());
    const std::size_t      n_points = Utilities::pow(solid.fe.degree + 1, dim);
    std::size_t            at       = 0;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (std::size_t q = 0; q < n_points; ++q, ++at)
          result(cell->active_cell_index()) +=
            complementary_work(solid.bodies[cell->material_id()].material,
                               points.stress[at],
                               points.stress[at]) *
            points.volume[at];
    return result;
  }



  RecoveredStress::RecoveredStress(StressRecovery &recovery, const Vector &u)
    : u(u)
    , points(recovery.of_cells(u))
    , field(recovery.corrected(points))
  {
  }



  dealii::Vector<double>
  form_errors(const Solid           &solid,
              const StressRecovery  &recovery,
              const RecoveredStress &u,
              const RecoveredStress &z)
  {
    // With the shapes that manifolds give the cells, to two orders more than those of the elements.
    const MappingQ<dim> exact(2 * solid.fe.degree);
    const QGauss<dim>   quadrature(solid.fe.degree + 2);
    FEValues<dim>       values(exact, solid.fe, quadrature, update_gradients | update_JxW_values);
    FEValues<dim>       nodes(exact, recovery.nodes().get_fe(), quadrature, update_values);
    const std::size_t   n_of_cells = Utilities::pow(solid.fe.degree + 1, dim);
    const unsigned int  n          = quadrature.size();
    std::vector<SymmetricTensor<2, dim>> strain_u(n), strain_z(n), stress_u(n), stress_z(n);
    std::vector<double>                  component(n);
    const FEValuesExtractors::Vector     displacement(0);
    const auto evaluate = [&](const StressField &field, std::vector<SymmetricTensor<2, dim>> &at) {
      for (unsigned int c = 0; c < field.size(); ++c)
        {
          nodes.get_function_values(field[c], component);
          for (unsigned int q = 0; q < n; ++q)
            at[q].access_raw_entry(c) = component[q];
        }
    };
    dealii::Vector<double> result(solid.dof_handler.get_triangulation().n_active_cells());
    std::size_t            at   = 0;
    auto                   node = recovery.nodes().begin_active();
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      {
        if (cell->is_locally_owned())
          {
            const MaterialParameters &material = solid.bodies[cell->material_id()].material;
            double                   &sum      = result(cell->active_cell_index());
            for (std::size_t q = 0; q < n_of_cells; ++q, ++at)
              sum += complementary_work(material, u.points.stress[at], z.points.stress[at]) *
                     u.points.volume[at];
            values.reinit(cell);
            nodes.reinit(node);
            values[displacement].get_function_symmetric_gradients(u.u, strain_u);
            values[displacement].get_function_symmetric_gradients(z.u, strain_z);
            evaluate(u.field, stress_u);
            evaluate(z.field, stress_z);
            for (unsigned int q = 0; q < n; ++q)
              sum -= (stress_u[q] * strain_z[q] + strain_u[q] * stress_z[q] -
                      complementary_work(material, stress_u[q], stress_z[q])) *
                     values.JxW(q);
          }
        ++node;
      }
    return result;
  }
} // namespace Touchstone
