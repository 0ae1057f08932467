// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/verification/point_displacement.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <limits>

namespace Touchstone
{
  namespace
  {
    const ReferenceRegistry::Entry<PointDisplacement> point_displacement_entry(
      "point displacement",
      "The displacement of the node next to a point. Values: 'point x', 'point y', 'point z'; and "
      "those that are known of 'displacement x', 'displacement y', 'displacement z'.");
  } // namespace



  PointDisplacement::PointDisplacement(const Scene &scene)
    : values(scene.reference.values)
  {
    ReferenceValues   numbers(values);
    const char *const components[dim] = {"x", "y", "z"};
    for (unsigned int d = 0; d < dim; ++d)
      {
        const std::string name = std::string("displacement ") + components[d];
        point[d]               = numbers.number(std::string("point ") + components[d]);
        given[d]               = numbers.has(name);
        exact[d]               = numbers.number(name, 0.);
      }
    numbers.finish();
    // The error is relative to the magnitude of the given displacement.
    if (exact.norm() == 0.)
      numbers.fail("No displacement is given, or it is zero.",
                   "Give at least one component, e.g. \"displacement z: -0.1\".");
  }



  void
  PointDisplacement::check_mesh(const Solid &solid) const
  {
    // Beside the body, which has no node there, by more than the size of a cell.
    double beside = std::numeric_limits<double>::max();
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          beside = std::min(beside, point.distance(cell->vertex(v)) - cell->diameter());
    if (dealii::Utilities::MPI::min(beside, solid.communicator) > 0.)
      throw InputError("Reference solution",
                       "Values",
                       values,
                       "the point lies beside all bodies",
                       "give a point of a body before deformation");
  }



  ReferenceComparison
  PointDisplacement::compare(const ReferenceInput &input) const
  {
    // The nodes of the cell serve as quadrature points, so that the displacement is evaluated at
    // nodes without a search for the point: it is compared where the mesh has a node.
    const Solid                  &solid = *input.solid;
    const dealii::Quadrature<dim> nodes(
      dealii::FE_Q<dim>(solid.fe.degree).get_unit_support_points());
    dealii::FEValues<dim>                    fe_values(solid.mapping,
                                    solid.fe,
                                    nodes,
                                    dealii::update_values | dealii::update_quadrature_points);
    const dealii::FEValuesExtractors::Vector components(0);
    std::vector<dealii::Tensor<1, dim>>      displacement(nodes.size());

    double                 nearest = std::numeric_limits<double>::max();
    dealii::Tensor<1, dim> found;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          fe_values.reinit(cell);
          fe_values[components].get_function_values(*input.displacement, displacement);
          for (const unsigned int q : fe_values.quadrature_point_indices())
            {
              const double distance = point.distance(fe_values.quadrature_point(q));
              if (distance < nearest)
                {
                  nearest = distance;
                  found   = displacement[q];
                }
            }
        }

    // A node on the border of partitions is found by several ranks: the lowest of those with the
    // smallest distance broadcasts its value, so that all have the same.
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(input.communicator);
    const double       best = dealii::Utilities::MPI::min(nearest, input.communicator);
    const unsigned int root =
      dealii::Utilities::MPI::min(nearest == best ? rank : std::numeric_limits<unsigned int>::max(),
                                  input.communicator);
    found = dealii::Utilities::MPI::broadcast(input.communicator, found, root);

    for (unsigned int d = 0; d < dim; ++d)
      // Components that are not given do not count.
      if (!given[d])
        found[d] = 0.;

    unsigned int main = 0;
    for (unsigned int d = 1; d < dim; ++d)
      if (std::abs(exact[d]) > std::abs(exact[main]))
        main = d;
    ReferenceComparison result;
    result.add("point_displacement", "displacement of the point", found[main], exact[main]);
    // The line shows the main component; the error is that of all given ones.
    result.errors["point_displacement"] = (found - exact).norm() / exact.norm();
    return result;
  }
} // namespace Touchstone
