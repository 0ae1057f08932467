// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/verification/contact_field.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/fe_values_extractors.h>

#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Visit the slave faces of this rank's cells. */
    template <class Visitor>
    void
    for_each_face(const Solid &solid, const PairBoundaries &boundaries, const Visitor &visit)
    {
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && cell->material_id() == boundaries.slave_body)
          for (const unsigned int f : cell->face_indices())
            if (cell->at_boundary(f) && boundaries.slave.count(cell->face(f)->boundary_id()) > 0)
              visit(cell, f);
    }



    /**
     * Nodal forces over areas are means of the traction around the nodes, int N t / int N. On
     * graded meshes these are not its values at the nodes, since the cells on one side weigh more.
     * One step towards the field whose means they are, t + (t - D^-1 M t), takes the difference
     * away to first order. Nodes without traction stay without.
     */
    void
    recover(const Solid &solid, const PairBoundaries &boundaries, Vector &nodal)
    {
      const Vector                before = solid.ghosted(nodal);
      Vector                      means(solid.zero_vector()), areas(means);
      FEFaceValues<dim>           values(solid.mapping,
                               solid.fe,
                               QGauss<dim - 1>(solid.fe.degree + 1),
                               update_values | update_JxW_values);
      std::vector<Tensor<1, dim>> tractions(values.n_quadrature_points);
      std::vector<Index>          dofs(solid.fe.n_dofs_per_cell());
      dealii::Vector<double>      mean(dofs.size()), area(dofs.size());
      for_each_face(solid, boundaries, [&](const auto &cell, const unsigned int f) {
        values.reinit(cell, f);
        values[FEValuesExtractors::Vector(0)].get_function_values(before, tractions);
        mean = 0.;
        area = 0.;
        for (const unsigned int q : values.quadrature_point_indices())
          for (unsigned int i = 0; i < dofs.size(); ++i)
            {
              const double weight = values.shape_value(i, q) * values.JxW(q);
              area(i) += weight;
              mean(i) += weight * tractions[q][solid.fe.system_to_component_index(i).first];
            }
        cell->get_dof_indices(dofs);
        solid.hanging.distribute_local_to_global(mean, dofs, means);
        solid.hanging.distribute_local_to_global(area, dofs, areas);
      });
      means.compress(VectorOperation::add);
      areas.compress(VectorOperation::add);
      for (const Index i : solid.owned)
        if (nodal(i) != 0. && areas(i) > 0.)
          nodal(i) = 2. * nodal(i) - means(i) / areas(i);
      nodal.compress(VectorOperation::insert);
    }



    Vector
    nodal_tractions(const ReferenceInput &input, const unsigned int pair)
    {
      const Solid &solid = *input.solid;
      Vector       result(solid.owned, input.communicator);
      for (const ContactPoint &point : points_of_pair(input.points, pair))
        for (unsigned int d = 0; d < dim; ++d)
          result(dim * point.node + d) = point.traction[d];
      result.compress(VectorOperation::insert);
      // Hanging nodes have no traction of their own.
      solid.hanging.distribute(result);
      // Functions of degree 2 have no such means: those of vertices may vanish.
      if (solid.fe.degree == 1)
        {
          recover(solid, input.boundaries.at(pair), result);
          solid.hanging.distribute(result);
        }
      return solid.ghosted(result);
    }
  } // namespace



  bool
  ContactField::available(const ReferenceInput &input)
  {
    return input.solid != nullptr && !input.boundaries.empty();
  }



  ContactField::ContactField(const ReferenceInput &input, const unsigned int pair)
    : solid(*input.solid)
    , boundaries(input.boundaries.at(pair))
    , traction(nodal_tractions(input, pair))
  {
  }



  double
  ContactField::relative_error(
    const std::function<double(const Point<dim> &, const Tensor<1, dim> &)> &component,
    const std::function<double(const Point<dim> &)>                         &exact) const
  {
    // Where the edge of the contact crosses a face, both have kinks there: points in 16 parts of a
    // face are off by 1e-3 of the error of such a face.
    FEFaceValues<dim>           values(solid.mapping,
                             solid.fe,
                             QIterated<dim - 1>(QGauss<1>(3), 4),
                             update_values | update_quadrature_points | update_JxW_values);
    std::vector<Tensor<1, dim>> tractions(values.n_quadrature_points);
    double                      error = 0., size = 0.;
    for_each_face(solid, boundaries, [&](const auto &cell, const unsigned int f) {
      values.reinit(cell, f);
      values[FEValuesExtractors::Vector(0)].get_function_values(traction, tractions);
      for (const unsigned int q : values.quadrature_point_indices())
        {
          const Point<dim> &x = values.quadrature_point(q);
          const double      e = exact(x), difference = component(x, tractions[q]) - e;
          error += difference * difference * values.JxW(q);
          size += e * e * values.JxW(q);
        }
    });
    error = Utilities::MPI::sum(error, solid.communicator);
    size  = Utilities::MPI::sum(size, solid.communicator);
    return size > 0. ? std::sqrt(error / size) : std::nan("");
  }
} // namespace Touchstone
