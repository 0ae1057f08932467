// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/verification/uniform_stress.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <limits>

/**
 * @file
 * The patch test: bodies stacked along an axis under uniform stress, small strain. Stress,
 * displacement and contact pressure must be exact to round-off; so largest deviations are compared
 * instead of norms, since a single wrong node is a failure.
 */

namespace Touchstone
{
  namespace
  {
    const ReferenceRegistry::Entry<UniformStress> uniform_stress_entry(
      "uniform stress",
      "The patch test. Values, all optional but not all zero: 'sxx', 'syy', 'szz', 'sxy', 'syz', "
      "'sxz'; 'origin x', 'origin y', 'origin z' (the point that does not move); 'pressure' of "
      "the contact, which is compared if it is given. The displacement is compared if there is no "
      "shear and no plastic body; bodies are stacked along the axis of the largest stress and "
      "free to widen.");
  } // namespace



  UniformStress::UniformStress(const Scene &scene)
    : pair(reference_pair(scene))
    , axis(0)
  {
    ReferenceValues   values(scene.reference.values);
    const char *const normal_names[dim] = {"sxx", "syy", "szz"};
    const char *const origin_names[dim] = {"origin x", "origin y", "origin z"};
    for (unsigned int d = 0; d < dim; ++d)
      {
        stress[d][d] = values.number(normal_names[d], 0.);
        origin[d]    = values.number(origin_names[d], 0.);
        if (std::abs(stress[d][d]) > std::abs(stress[axis][axis]))
          axis = d;
      }
    stress[0][1] = values.number("sxy", 0.);
    stress[1][2] = values.number("syz", 0.);
    stress[0][2] = values.number("sxz", 0.);
    pressure     = values.number("pressure", 0.);
    values.finish();
    if (stress.norm() == 0.)
      values.fail("All stresses are zero.", "Give at least one, e.g. \"szz: -1\".");

    for (const BodyParameters &body : scene.bodies)
      {
        // Hooke's law, solved for the strain: each body has its own.
        const double E = body.material.young_modulus, nu = body.material.poisson_ratio;
        strain.push_back(
          ((1. + nu) * stress - nu * dealii::trace(stress) * dealii::unit_symmetric_tensor<dim>()) /
          E);
      }
  }



  std::vector<double>
  UniformStress::body_shifts(const ReferenceInput &input) const
  {
    // Lowest coordinate of each body along the axis, over all ranks.
    std::vector<double> begin(strain.size(), std::numeric_limits<double>::max());
    for (const auto &cell : input.solid->dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          begin[cell->material_id()] = std::min(begin[cell->material_id()], cell->vertex(v)[axis]);
    // A rank may own no cell of a body: its entry is the largest number.
    dealii::Utilities::MPI::min(begin, input.communicator, begin);

    std::vector<unsigned int> order(strain.size());
    for (unsigned int b = 0; b < order.size(); ++b)
      order[b] = b;
    std::stable_sort(order.begin(), order.end(), [&begin](unsigned int a, unsigned int b) {
      return begin[a] < begin[b];
    });

    // Displacements are continuous at the interfaces: u = eps_b (x - x_0) + shift_b along the axis.
    // With eps of two bodies differing, the shift of the upper one is that of the lower one plus
    // the difference of the strains times the distance of their interface from the origin.
    std::vector<double> shift(strain.size(), 0.);
    for (unsigned int i = 1; i < order.size(); ++i)
      {
        const unsigned int below = order[i - 1], above = order[i];
        shift[above] = shift[below] + (strain[below][axis][axis] - strain[above][axis][axis]) *
                                        (begin[above] - origin[axis]);
      }
    return shift;
  }



  double
  UniformStress::displacement_error(const ReferenceInput &input) const
  {
    const std::vector<double> shift = body_shifts(input);
    const Solid              &solid = *input.solid;

    // The nodes of the cell serve as quadrature points: displacements are compared at nodes.
    const dealii::Quadrature<dim> nodes(
      dealii::FE_Q<dim>(solid.fe.degree).get_unit_support_points());
    dealii::FEValues<dim>                    fe_values(solid.mapping,
                                    solid.fe,
                                    nodes,
                                    dealii::update_values | dealii::update_quadrature_points);
    const dealii::FEValuesExtractors::Vector components(0);
    std::vector<dealii::Tensor<1, dim>>      computed(nodes.size());

    double largest_error = 0., largest = 0.;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          fe_values.reinit(cell);
          fe_values[components].get_function_values(*input.displacement, computed);
          const unsigned int body = cell->material_id();
          for (const unsigned int q : fe_values.quadrature_point_indices())
            {
              dealii::Tensor<1, dim> exact =
                strain[body] * (dealii::Tensor<1, dim>(fe_values.quadrature_point(q)) - origin);
              exact[axis] += shift[body];
              largest_error = std::max(largest_error, (computed[q] - exact).norm());
              largest       = std::max(largest, exact.norm());
            }
        }
    return dealii::Utilities::MPI::max(largest_error, input.communicator) /
           dealii::Utilities::MPI::max(largest, input.communicator);
  }



  ReferenceComparison
  UniformStress::compare(const ReferenceInput &input) const
  {
    ReferenceComparison result;

    double deviation = 0.;
    input.solid->for_each_stress(*input.displacement,
                                 [&](unsigned int,
                                     const dealii::Point<dim> &,
                                     const dealii::SymmetricTensor<2, dim> &computed,
                                     double) {
                                   // At every quadrature point, not averaged.
                                   deviation = std::max(deviation, (computed - stress).norm());
                                 });
    result.add("stress_max_deviation",
               "stress, largest deviation",
               dealii::Utilities::MPI::max(deviation, input.communicator) / stress.norm());

    // With shear the stress alone does not determine the rotation of the body, and with plastic
    // material Hooke's law does not determine the strain: the displacement is then not compared.
    if (!input.solid->has_history() && stress[0][1] == 0. && stress[1][2] == 0. &&
        stress[0][2] == 0.)
      result.add("displacement_max",
                 "displacement, largest deviation of a node",
                 displacement_error(input));

    if (pressure != 0.)
      {
        double pressure_deviation = 0.;
        for (const ContactPoint &point : points_of_pair(input.points, pair))
          pressure_deviation = std::max(pressure_deviation, std::abs(point.pressure - pressure));
        result.add("contact_pressure_max_deviation",
                   "contact pressure, largest deviation of a node",
                   dealii::Utilities::MPI::max(pressure_deviation, input.communicator) /
                     std::abs(pressure));
      }
    return result;
  }
} // namespace Touchstone
