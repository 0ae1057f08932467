// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_load_stepping_parameters_h
#define touchstone_drive_load_stepping_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief A part of the run with equal steps of its own: clamp, pull, release. */
  struct LoadPhase
  {
    std::string name;
    /** It begins where the phase before ends, or at 0. */
    double end_time = 0.;
    /** Number of steps when none is cut. */
    unsigned int steps = 1;
  };

  /** @brief Section "Load stepping". */
  struct LoadSteppingParameters
  {
    double end_time = 1.;
    /** Number of steps when none is cut. */
    unsigned int steps = 1;
    /** A step that does not converge is halved at most this many times. */
    unsigned int maximum_cuts = 8;
    /** In the order of the list "Phases"; empty if the whole run is one without a name. */
    std::vector<LoadPhase> phases;

    /** Call once #phases have their names. */
    void
    declare(dealii::ParameterHandler &prm);
    /** @throws InputError */
    void
    check(const std::string &section) const;

    /** @name Steps when none is cut */
    /** @{ */
    /** @brief The phases, or one without a name. */
    std::vector<LoadPhase>
    all_phases() const;
    /** @brief Number among all_phases() of that in which a step from @p time begins. */
    unsigned int
    phase_at(double time) const;
    /** @brief When it ends. */
    double
    phase_end(double time) const;
    /** @brief Length of a step that begins at @p time. */
    double
    nominal_step(double time) const;
    /** @brief Number of steps of the phases after that of @p time. */
    unsigned int
    steps_after_phase(double time) const;
    /** @brief Ends of all steps, from the first. */
    std::vector<double>
    step_ends() const;
    /** @} */

  private:
    /** @throws InputError for more steps than can be numbered, or steps of no length. */
    void
    check_steps(const std::string &section) const;
  };
} // namespace Touchstone

#endif
