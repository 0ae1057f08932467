// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/output_parameters.h>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  void
  OutputParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Directory",
                      directory,
                      "Folder for all output; empty: output/STEM for a scene file "
                      "STEM.prm.",
                      Patterns::Anything());
    prm.add_parameter("VTU interval",
                      vtu_interval,
                      "Pictures (solution.pvd, contact.pvd) every so many steps and "
                      "at the end; 0: never.",
                      Patterns::Integer(0));
  }



  void
  OutputParameters::check(const std::string &) const
  {
  }
} // namespace Touchstone
