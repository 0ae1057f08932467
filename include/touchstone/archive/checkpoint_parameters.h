// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_archive_checkpoint_parameters_h
#define touchstone_archive_checkpoint_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Touchstone
{
  /** @brief Section "Checkpoints": when to write checkpoints, from which a run can resume. */
  struct CheckpointParameters
  {
    /** Write one every so many steps; 0: not by steps. */
    unsigned int steps_between = 0;
    /** Write one after a step if the last is as long ago, minutes; 0: not by time. */
    double minutes_between = 0.;

    bool
    active() const
    {
      return steps_between > 0 || minutes_between > 0.;
    }

    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Touchstone

#endif
