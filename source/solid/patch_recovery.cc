// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/patch_fits.h>
#include <touchstone/solid/stress_recovery.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>

// Stresses of degree p are most accurate, of order p + 1, at the p Gauss points a direction, and so
// are polynomials of degree p that fit them (doc/theory.md 11, "Contact forces").
namespace Touchstone
{
  using namespace dealii;

  StressField
  StressRecovery::patches(const PointStresses &points) const
  {
    PatchFits fits(fe.degree, vertices, relevant_vertices);
    // From the points of the stresses to those where they are most accurate.
    const FE_DGQArbitraryNodes<dim>      interpolation(QGauss<1>(fe.degree + 1));
    const QGauss<dim>                    best(fe.degree);
    std::vector<Point<dim>>              x(best.size());
    std::vector<SymmetricTensor<2, dim>> stress(best.size());
    std::size_t                          at = 0;
    for (const auto &cell : vertices.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          for (unsigned int b = 0; b < best.size(); ++b)
            {
              x[b]      = Point<dim>();
              stress[b] = 0.;
              for (unsigned int q = 0; q < interpolation.n_dofs_per_cell(); ++q)
                {
                  const double share = interpolation.shape_value(q, best.point(b));
                  x[b] += share * points.x[at + q];
                  stress[b] += share * points.stress[at + q];
                }
            }
          at += interpolation.n_dofs_per_cell();
          fits.add_cell(cell, x, stress);
        }
    fits.fit();

    // A node takes the polynomials of the vertices of its edge, face or cell in equal parts.
    const Quadrature<dim> places(fe.get_unit_support_points());
    FEValues<dim>         at_nodes(values.get_mapping(), fe, places, update_quadrature_points);
    const IndexSet       &owned = numbers.locally_owned_dofs();
    StressField           result;
    for (auto &component : result)
      component.reinit(owned, relevant, numbers.get_communicator());
    std::vector<Index> dofs(fe.n_dofs_per_cell());
    auto               vertex = vertices.begin_active();
    for (const auto &cell : numbers.active_cell_iterators())
      {
        if (cell->is_locally_owned())
          {
            at_nodes.reinit(cell);
            cell->get_dof_indices(dofs);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              if (owned.is_element(dofs[i]))
                for (unsigned int c = 0; c < n_components; ++c)
                  {
                    double value = 0.;
                    for (const unsigned int v : cell->vertex_indices())
                      if (const double part =
                            GeometryInfo<dim>::d_linear_shape_function(places.point(i), v);
                          part > 1e-9)
                        value += part * fits.value(vertex->vertex_dof_index(v, 0),
                                                   c,
                                                   at_nodes.quadrature_point(i) - cell->vertex(v));
                    result[c](dofs[i]) = value;
                  }
          }
        ++vertex;
      }
    for (auto &component : result)
      {
        hanging.distribute(component);
        component.update_ghost_values();
      }
    return result;
  }
} // namespace Touchstone
