// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/stress_recovery.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>

// Recovered stress for error estimates (doc/theory.md 11); its fits are in patch_recovery.cc.
namespace Touchstone
{
  using namespace dealii;

  StressRecovery::StressRecovery(const Solid &solid)
    : solid(solid)
    , fe(solid.fe.degree)
    , numbers(solid.dof_handler.get_triangulation())
    , vertices(solid.dof_handler.get_triangulation())
    , values(solid.mapping,
             fe,
             QGauss<dim>(solid.fe.degree + 1),
             update_values | update_quadrature_points | update_JxW_values)
  {
    numbers.distribute_dofs(fe);
    vertices.distribute_dofs(FE_Q<dim>(1));
    DoFTools::extract_locally_relevant_dofs(numbers, relevant);
    DoFTools::extract_locally_relevant_dofs(vertices, relevant_vertices);
    hanging.reinit(relevant);
    DoFTools::make_hanging_node_constraints(numbers, hanging);
    hanging.close();
  }



  PointStresses
  StressRecovery::of_cells(const Vector &u) const
  {
    PointStresses points;
    solid.for_each_stress(u,
                          [&](const unsigned int,
                              const Point<dim>              &x,
                              const SymmetricTensor<2, dim> &sigma,
                              const double                   v) {
                            points.stress.push_back(sigma);
                            points.x.push_back(x);
                            points.volume.push_back(v);
                          });
    return points;
  }



  // What belongs to hanging nodes goes to those that they follow.
  StressField
  StressRecovery::averages(const PointStresses &points)
  {
    LinearAlgebra::distributed::Vector<double> volume(numbers.locally_owned_dofs(),
                                                      relevant,
                                                      numbers.get_communicator());
    StressField                                stress;
    for (auto &field : stress)
      field.reinit(volume);
    std::vector<Index>     dofs(fe.n_dofs_per_cell());
    dealii::Vector<double> local(dofs.size());
    std::size_t            at = 0;
    for (const auto &cell : numbers.active_cell_iterators())
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



  void
  StressRecovery::subtract(const StressField &field, PointStresses &points)
  {
    std::vector<double> recovered(values.n_quadrature_points);
    std::size_t         at = 0;
    for (const auto &cell : numbers.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          for (unsigned int c = 0; c < n_components; ++c)
            {
              values.get_function_values(field[c], recovered);
              for (unsigned int q = 0; q < recovered.size(); ++q)
                points.stress[at + q].access_raw_entry(c) -= recovered[q];
            }
          at += recovered.size();
        }
  }



  // Averages are one-sided at boundaries, and linear fits miss curvature: each correction by what
  // is recovered of the rest brings them closer. With plain averages the estimated errors of thin
  // bodies were three times the true ones.
  StressField
  StressRecovery::corrected(PointStresses points)
  {
    constexpr unsigned int corrections = 3;
    StressField            result;
    for (unsigned int k = 0; k <= corrections; ++k)
      {
        StressField found = patches(points);
        subtract(found, points);
        if (k == 0)
          result = std::move(found);
        else
          for (unsigned int c = 0; c < n_components; ++c)
            {
              result[c] += found[c];
              result[c].update_ghost_values();
            }
      }
    return result;
  }
} // namespace Touchstone
