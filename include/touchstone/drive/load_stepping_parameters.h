// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_load_stepping_parameters_h
#define touchstone_drive_load_stepping_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Touchstone
{
  /** @brief Section "Load stepping". */
  struct LoadSteppingParameters
  {
    double end_time = 1.;
    /** Number of steps when none is cut. */
    unsigned int steps = 1;
    /** A step that does not converge is halved at most this many times. */
    unsigned int maximum_cuts = 8;

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif
