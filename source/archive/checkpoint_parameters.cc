// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/checkpoint_parameters.h>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  void
  CheckpointParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Steps between",
                      steps_between,
                      "Write a checkpoint, from which --resume goes on, every so many steps and at "
                      "the end; 0: not by steps.",
                      Patterns::Integer(0));
    prm.add_parameter("Minutes between",
                      minutes_between,
                      "Write a checkpoint after a step if the last one is this long ago, and at "
                      "the end; 0: not by time. [minutes]",
                      Patterns::Double(0.));
  }
} // namespace Touchstone
