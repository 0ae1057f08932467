// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/resultant_load.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>

// Force and moment on a boundary (doc/theory.md 2.3).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The rotation that takes the points of a boundary closest to where they are, from
     * B = int (x - c) (X - C)^T dA: the orthogonal factor of B. Of a plane boundary, for which B
     * has rank two, the cofactor adds the third direction. */
    Tensor<2, dim>
    mean_rotation(const Tensor<2, dim> &b)
    {
      Tensor<2, dim> cofactor;
      for (unsigned int i = 0; i < dim; ++i)
        cofactor[i] = cross_product_3d(b[(i + 1) % dim], b[(i + 2) % dim]);
      return project_onto_orthogonal_tensors(b + cofactor / b.norm());
    }
  } // namespace



  void
  ResultantLoad::Integrals::add(const double          weight,
                                const Tensor<1, dim> &x,
                                const Tensor<1, dim> &reference)
  {
    unsigned int k = 0;
    values[k++] += weight;
    for (unsigned int i = 0; i < dim; ++i)
      {
        values[k++] += weight * x[i];
        values[k++] += weight * reference[i];
        for (unsigned int j = 0; j < dim; ++j)
          {
            values[k++] += weight * x[i] * x[j];
            values[k++] += weight * x[i] * reference[j];
          }
      }
  }



  ResultantLoad::ResultantLoad(const Solid       &solid,
                               const BoundaryIds &boundary,
                               const Functions   &functions,
                               const Point<dim>  *given,
                               const bool         finite)
    : solid(solid)
    , boundary(boundary)
    , values(functions)
    , moves(finite &&
            (given != nullptr || std::any_of(functions.begin() + dim,
                                             functions.end(),
                                             [](const auto &moment) { return moment != nullptr; })))
  {
    start = place(integrals(nullptr));
    if (given != nullptr)
      start.point = *given;
    if (moves)
      choose_outermost();
  }



  ResultantLoad::Integrals
  ResultantLoad::integrals(const Vector *const u) const
  {
    // The rule with which tractions are integrated (BoundaryConditions::add_tractions()): so nodal
    // forces have this force and moment to round-off, whatever the shape of the faces.
    const FEValuesExtractors::Vector displacement(0);
    FEFaceValues<dim>                face(solid.mapping,
                           solid.fe,
                           QGauss<dim - 1>(solid.fe.degree + 2),
                           update_values | update_JxW_values | update_quadrature_points);
    std::vector<Tensor<1, dim>>      moved(face.n_quadrature_points);
    Integrals                        result;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f) && boundary.count(cell->face(f)->boundary_id()) > 0)
            {
              face.reinit(cell, f);
              if (u != nullptr)
                face[displacement].get_function_values(*u, moved);
              for (unsigned int q = 0; q < face.n_quadrature_points; ++q)
                {
                  const Tensor<1, dim> x = face.quadrature_point(q);
                  result.add(face.JxW(q), x + moved[q], x);
                }
            }
    Utilities::MPI::sum(ArrayView<const double>(result.values.data(), Integrals::n_values),
                        solid.communicator,
                        ArrayView<double>(result.values.data(), Integrals::n_values));
    return result;
  }



  ResultantLoad::Place
  ResultantLoad::place(const Vector &u) const
  {
    return place(integrals(&u));
  }



  ResultantLoad::Place
  ResultantLoad::place(const Integrals &integrals) const
  {
    Place          result;
    Tensor<1, dim> reference;
    Tensor<2, dim> second, mixed;
    auto           value = integrals.values.begin();
    result.area          = *value++;
    for (unsigned int i = 0; i < dim; ++i)
      {
        result.mean[i] = *value++ / result.area;
        reference[i]   = *value++ / result.area;
        for (unsigned int j = 0; j < dim; ++j)
          {
            second[i][j] = *value++;
            mixed[i][j]  = *value++;
          }
      }
    second -= result.area * outer_product(result.mean, result.mean);
    mixed -= result.area * outer_product(Tensor<1, dim>(result.mean), reference);
    result.inverse_inertia =
      invert(Tensor<2, dim>(trace(second) * unit_symmetric_tensor<dim>()) - second);
    result.point = result.mean;
    if (start.area > 0. && start.point.distance(start.mean) > 0.)
      {
        const Tensor<2, dim> rotation = mean_rotation(mixed);
        result.point += rotation * (start.point - start.mean);
        result.stretch = mixed * transpose(rotation);
      }
    result.second = second;
    return result;
  }



  Tensor<1, dim>
  ResultantLoad::traction_of_unit(const unsigned int k, const Place &place, const Tensor<1, dim> &x)
  {
    Tensor<1, dim> force, moment;
    (k < dim ? force : moment)[k % dim] = 1.;
    moment += cross_product_3d(place.point - place.mean, force);
    return force / place.area + cross_product_3d(place.inverse_inertia * moment, x - place.mean);
  }



  Tensor<1, dim>
  ResultantLoad::traction(const Place &place, const Tensor<1, dim> &x, const double t) const
  {
    Tensor<1, dim> sum;
    for (unsigned int k = 0; k < 2 * dim; ++k)
      if (values[k])
        sum += values[k]->value(Point<dim>(), t) * traction_of_unit(k, place, x);
    return sum;
  }
} // namespace Touchstone
