// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/resultant_load.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

// Force and moment on a boundary (doc/theory.md 2.3).
namespace Touchstone
{
  using namespace dealii;

  ResultantLoad::ResultantLoad(const Solid       &solid,
                               const BoundaryIds &boundary,
                               const Functions   &functions,
                               const Point<dim>  *given)
    : values(functions)
  {
    // The rule with which tractions are integrated (BoundaryConditions::add_tractions()): so nodal
    // forces have this force and moment to round-off, whatever the shape of the faces.
    const FE_Q<dim>   scalar_fe(1);
    FEFaceValues<dim> face(solid.mapping,
                           scalar_fe,
                           QGauss<dim - 1>(solid.fe.degree + 2),
                           update_JxW_values | update_quadrature_points);
    Tensor<1, dim>    first;
    Tensor<2, dim>    second;
    for (const auto &cell : solid.dof_handler.get_triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f) && boundary.count(cell->face(f)->boundary_id()) > 0)
            {
              face.reinit(cell, f);
              for (unsigned int q = 0; q < face.n_quadrature_points; ++q)
                {
                  const Tensor<1, dim> x = face.quadrature_point(q);
                  area += face.JxW(q);
                  first += face.JxW(q) * x;
                  second += face.JxW(q) * outer_product(x, x);
                }
            }
    area     = Utilities::MPI::sum(area, solid.communicator);
    first    = Utilities::MPI::sum(first, solid.communicator);
    second   = Utilities::MPI::sum(second, solid.communicator);
    centroid = Point<dim>(first / area);
    second -= area * outer_product(centroid, centroid);
    inverse_inertia = invert(Tensor<2, dim>(trace(second) * unit_symmetric_tensor<dim>()) - second);
    point           = given != nullptr ? *given : centroid;
  }



  Tensor<1, dim>
  ResultantLoad::traction_of_unit(const unsigned int k, const Point<dim> &x) const
  {
    Tensor<1, dim> force, moment;
    (k < dim ? force : moment)[k % dim] = 1.;
    moment += cross_product_3d(point - centroid, force);
    return force / area + cross_product_3d(inverse_inertia * moment, x - centroid);
  }



  Tensor<1, dim>
  ResultantLoad::traction(const Point<dim> &x, const double t) const
  {
    Tensor<1, dim> sum;
    for (unsigned int k = 0; k < 2 * dim; ++k)
      if (values[k])
        sum += values[k]->value(Point<dim>(), t) * traction_of_unit(k, x);
    return sum;
  }
} // namespace Touchstone
