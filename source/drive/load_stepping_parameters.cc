// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/parameter_checks.h>
#include <touchstone/drive/load_stepping_parameters.h>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  void
  LoadSteppingParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("End time",
                      end_time,
                      "The time t in formulas runs from 0 to here. [time]",
                      Patterns::Double(0.));
    prm.add_parameter("Steps",
                      steps,
                      "Number of equal steps when none has to be cut.",
                      Patterns::Integer(1));
    prm.add_parameter("Maximum cuts",
                      maximum_cuts,
                      "A step that does not converge is halved at most this many "
                      "times in a row.",
                      Patterns::Integer(0, 30));
  }



  void
  LoadSteppingParameters::check(const std::string &section) const
  {
    check_positive(section, "End time", end_time, "1 is as good as any other");
  }
} // namespace Touchstone
