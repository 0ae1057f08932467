// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/verification/formula_solution.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

/**
 * @file
 * Comparison with formulas of the scene, e.g. manufactured solutions (doc/theory.md 10, equation
 * (26)): relative L2 errors of displacement and contact pressure, from which the tests compute
 * rates of convergence.
 */

namespace Touchstone
{
  namespace
  {
    const ReferenceRegistry::Entry<FormulaSolution> formula_solution_entry(
      "formula",
      "An exact or manufactured solution, given by formulas: 'Reference displacement x', 'y', 'z' "
      "of the bodies and 'Pressure' of the contact pair, as far as they are known. No values.");
  } // namespace



  FormulaSolution::FormulaSolution(const Scene &scene)
    : end_time(scene.load_stepping.end_time)
  {
    ReferenceValues(scene.reference.values).finish();

    bool any = false;
    for (const BodyParameters &body : scene.bodies)
      {
        displacement.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          {
            displacement.back()[d] = formulas.add(body.section(),
                                                  std::string("Reference displacement ") + "xyz"[d],
                                                  body.reference_displacement[d]);
            any                    = any || displacement.back()[d];
          }
      }
    pressure = formulas.add("Reference solution", "Pressure", scene.reference.pressure);
    if (pressure && scene.pairs.empty())
      throw InputError("Reference solution",
                       "Pressure",
                       scene.reference.pressure,
                       "there is no contact pair",
                       "remove the key, or add a pair");
    if (pressure)
      pair = reference_pair(scene);
    if (!any && !pressure)
      throw InputError("Reference solution",
                       "Type",
                       scene.reference.type.name,
                       "there is no formula to compare with",
                       "set 'Pressure' here, or 'Reference displacement x', 'y' or 'z' in the "
                       "section of a body");
  }



  std::array<double, 2>
  FormulaSolution::displacement_integrals(const ReferenceInput &input) const
  {
    const Solid &solid = *input.solid;
    // Two points per direction more than the stiffness has, degree + 1: at those of the stiffness
    // the error can be superconvergent and look smaller than it is.
    const dealii::QGauss<dim>                quadrature(solid.fe.degree + 3);
    dealii::FEValues<dim>                    fe_values(solid.mapping,
                                    solid.fe,
                                    quadrature,
                                    dealii::update_values | dealii::update_quadrature_points |
                                      dealii::update_JxW_values);
    const dealii::FEValuesExtractors::Vector components(0);
    std::vector<dealii::Tensor<1, dim>>      computed(quadrature.size());

    std::array<double, 2> sums{};
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          fe_values.reinit(cell);
          fe_values[components].get_function_values(*input.displacement, computed);
          for (const unsigned int q : fe_values.quadrature_point_indices())
            for (unsigned int d = 0; d < dim; ++d)
              if (const auto &formula = displacement[cell->material_id()][d])
                {
                  const double exact = formula->value(fe_values.quadrature_point(q), end_time);
                  const double error = computed[q][d] - exact;
                  sums[0] += fe_values.JxW(q) * error * error;
                  sums[1] += fe_values.JxW(q) * exact * exact;
                }
        }
    return sums;
  }



  std::array<double, 2>
  FormulaSolution::pressure_integrals(const ReferenceInput &input) const
  {
    std::array<double, 2> sums{};
    for (const ContactPoint &point : points_of_pair(input.points, pair))
      {
        // Pressures are nodal values with tributary areas as weights.
        const double exact = pressure->value(point.reference_position, end_time);
        const double error = point.pressure - exact;
        sums[0] += point.area * error * error;
        sums[1] += point.area * exact * exact;
      }
    return sums;
  }



  void
  FormulaSolution::add_relative(ReferenceComparison         &result,
                                const std::string           &name,
                                const std::string           &what,
                                const std::array<double, 2> &integrals,
                                const MPI_Comm               communicator) const
  {
    // Collective: a formula that is not finite on one rank would otherwise stop that rank alone.
    formulas.check(communicator);
    const double error = dealii::Utilities::MPI::sum(integrals[0], communicator),
                 exact = dealii::Utilities::MPI::sum(integrals[1], communicator);
    result.add(name, what, exact > 0. ? std::sqrt(error / exact) : std::nan(""));
  }



  ReferenceComparison
  FormulaSolution::compare(const ReferenceInput &input) const
  {
    ReferenceComparison result;
    if (std::any_of(displacement.begin(), displacement.end(), [](const auto &body) {
          return body[0] || body[1] || body[2];
        }))
      add_relative(result,
                   "displacement_l2",
                   "displacement",
                   displacement_integrals(input),
                   input.communicator);
    if (pressure)
      add_relative(
        result, "pressure_l2", "contact pressure", pressure_integrals(input), input.communicator);
    return result;
  }
} // namespace Touchstone
