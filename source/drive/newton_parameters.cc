// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/parameter_checks.h>
#include <touchstone/drive/newton_parameters.h>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  void
  NewtonParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Residual tolerance",
                      residual_tolerance,
                      "Largest out-of-balance force, relative to the forces that "
                      "act. [no unit]",
                      Patterns::Double(0., 1.));
    prm.add_parameter("Gap tolerance",
                      gap_tolerance,
                      "Largest gap or penetration of an active node, relative to "
                      "the size of the slave faces. [no unit]",
                      Patterns::Double(0., 1.));
    prm.add_parameter(
      "Maximum iterations",
      maximum_iterations,
      "A step that needs more Newton iterations is cut. Those that change the active set do not "
      "count, up to as many again.",
      Patterns::Integer(1));
    line_search.declare(
      prm,
      "Line search",
      "'automatic' halves an increment that leaves the forces much further out of "
      "balance than they were while no contact row changes; 'none' takes "
      "every increment in full.");
  }



  void
  NewtonParameters::check(const std::string &section) const
  {
    const std::string remedy = "round-off ends at about 1e-12, 1e-9 is usual";
    // Upper limit of both tolerances: with a relative error of 1 per cent in the balance of forces
    // or in the gaps Newton's method could stop at a state that is no solution.
    constexpr double coarsest = 1e-2;
    for (const auto &[key, tolerance] : {std::make_pair("Residual tolerance", residual_tolerance),
                                         std::make_pair("Gap tolerance", gap_tolerance)})
      {
        check_positive(section, key, tolerance, remedy);
        // Written such that NaN is refused, too.
        if (!(tolerance < coarsest))
          throw InputError(section,
                           key,
                           Patterns::Tools::to_string(tolerance),
                           "is so large that what is no solution would count as one",
                           "give less than " + Patterns::Tools::to_string(coarsest) + "; " +
                             remedy);
      }
  }
} // namespace Touchstone
