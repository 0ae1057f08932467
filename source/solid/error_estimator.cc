// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/error_estimator.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/la_parallel_vector.h>
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
    constexpr unsigned int n_components = SymmetricTensor<2, dim>::n_independent_components;

    /** Stresses and volumes of quadrature points, cell by cell. Loops over the owned cells visit
     * points in the same order as for_each_stress(), so that a running index suffices. */
    struct PointStresses
    {
      std::vector<SymmetricTensor<2, dim>> stress;
      std::vector<double>                  volume;
    };

    using StressField = std::array<LinearAlgebra::distributed::Vector<double>, n_components>;

    /** Averages of the stresses at the nodes, weighted with the volumes: int N sigma over int N, a
     * projection with lumped mass. What belongs to hanging nodes goes to those that they follow.
     * Collective. */
    StressField
    recover(const PointStresses &points, const DoFHandler<dim> &nodes, FEValues<dim> &values)
    {
      IndexSet relevant;
      DoFTools::extract_locally_relevant_dofs(nodes, relevant);
      AffineConstraints<double> hanging(relevant);
      DoFTools::make_hanging_node_constraints(nodes, hanging);
      hanging.close();

      LinearAlgebra::distributed::Vector<double> volume(nodes.locally_owned_dofs(),
                                                        relevant,
                                                        nodes.get_communicator());
      StressField                                stress;
      for (auto &field : stress)
        field.reinit(volume);
      std::vector<Index>     dofs(nodes.get_fe().n_dofs_per_cell());
      dealii::Vector<double> local(dofs.size());
      std::size_t            at = 0;
      for (const auto &cell : nodes.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            values.reinit(cell);
            cell->get_dof_indices(dofs);
            for (unsigned int c = 0; c <= n_components; ++c)
              {
                local = 0.;
                for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
                  for (unsigned int i = 0; i < dofs.size(); ++i)
                    local(i) += values.shape_value(i, q) * points.volume[at + q] *
                                (c < n_components ? points.stress[at + q].access_raw_entry(c) : 1.);
                hanging.distribute_local_to_global(local,
                                                   dofs,
                                                   c < n_components ? stress[c] : volume);
              }
            at += values.n_quadrature_points;
          }
      volume.compress(VectorOperation::add);
      for (auto &field : stress)
        {
          field.compress(VectorOperation::add);
          for (unsigned int i = 0; i < field.locally_owned_size(); ++i)
            if (volume.local_element(i) != 0.)
              field.local_element(i) /= volume.local_element(i);
          hanging.distribute(field);
          field.update_ghost_values();
        }
      return stress;
    }

    /** Recovered stress less that of the elements at all quadrature points, in the order of the
     * points. The averages at the nodes of a boundary are one-sided; each correction by the
     * averages of what is left brings them closer to the projection with full mass. Collective. */
    PointStresses
    stress_errors(const Solid           &solid,
                  const Vector          &u,
                  const DoFHandler<dim> &nodes,
                  FEValues<dim>         &values,
                  const unsigned int     corrections)
    {
      PointStresses points;
      solid.for_each_stress(u,
                            [&](const unsigned int,
                                const Point<dim> &,
                                const SymmetricTensor<2, dim> &sigma,
                                const double                   v) {
                              points.stress.push_back(sigma);
                              points.volume.push_back(v);
                            });
      std::vector<double> recovered(values.n_quadrature_points);
      for (unsigned int k = 0; k <= corrections; ++k)
        {
          const StressField stress = recover(points, nodes, values);
          std::size_t       at     = 0;
          for (const auto &cell : nodes.active_cell_iterators())
            if (cell->is_locally_owned())
              {
                values.reinit(cell);
                for (unsigned int c = 0; c < n_components; ++c)
                  {
                    values.get_function_values(stress[c], recovered);
                    for (unsigned int q = 0; q < recovered.size(); ++q)
                      points.stress[at + q].access_raw_entry(c) -= recovered[q];
                  }
                at += recovered.size();
              }
        }
      for (SymmetricTensor<2, dim> &left : points.stress)
        left *= -1.;
      return points;
    }
  } // namespace



  namespace
  {
    /** The products of two differences between a continuous stress field sigma* that is recovered
     * from the discontinuous one of the elements [31] and the latter. Bodies share no nodes, so
     * sigma* is continuous within each body only. Null for z is u itself. Collective. */
    dealii::Vector<double>
    products(const Solid &solid, const Vector &u, const Vector *z, const unsigned int corrections)
    {
      const FE_Q<dim> node_fe(solid.fe.degree);
      DoFHandler<dim> nodes(solid.dof_handler.get_triangulation());
      nodes.distribute_dofs(node_fe);
      FEValues<dim>       values(solid.mapping,
                           node_fe,
                           QGauss<dim>(solid.fe.degree + 1),
                           update_values | update_JxW_values);
      const PointStresses first = stress_errors(solid, u, nodes, values, corrections);
      PointStresses       other;
      if (z != nullptr)
        other = stress_errors(solid, *z, nodes, values, corrections);
      const PointStresses &second = z != nullptr ? other : first;

      // (sigma* - sigma) : C^-1 : (sigma* - sigma) with the isotropic compliance, e : C^-1 : f =
      // ((1 + nu) e : f - nu tr e tr f) / E. It is that of the elastic law at small strain for all
      // materials, as an indicator needs no more.
      dealii::Vector<double> result(solid.dof_handler.get_triangulation().n_active_cells());
      std::size_t            at = 0;
      for (const auto &cell : nodes.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const MaterialParameters &material = solid.bodies[cell->material_id()].material;
            const double              E = material.young_modulus, nu = material.poisson_ratio;
            for (unsigned int q = 0; q < values.n_quadrature_points; ++q, ++at)
              {
                const SymmetricTensor<2, dim> &e = first.stress[at], &f = second.stress[at];
                result(cell->active_cell_index()) +=
                  ((1. + nu) * (e * f) - nu * trace(e) * trace(f)) / E * first.volume[at];
              }
          }
      return result;
    }
  } // namespace



  dealii::Vector<double>
  recovery_errors(const Solid &solid, const Vector &u)
  {
    return products(solid, u, nullptr, 0);
  }



  dealii::Vector<double>
  recovery_products(const Solid &solid, const Vector &u, const Vector &z)
  {
    // With plain averages the estimated errors of thin bodies were three times the true ones.
    constexpr unsigned int corrections = 3;
    return products(solid, u, &z, corrections);
  }
} // namespace Touchstone
