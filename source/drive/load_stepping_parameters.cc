// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/parameter_checks.h>
#include <touchstone/drive/load_stepping_parameters.h>

#include <cmath>

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
    prm.declare_entry(
      "Phases",
      "",
      Patterns::List(Patterns::Anything()),
      "Names of parts of the run that follow upon each other, each with equal steps "
      "of its own and a subsection 'Phase NAME'; 'End time' and 'Steps' then follow "
      "from them. Empty: all steps are equal.");
    for (LoadPhase &phase : phases)
      {
        prm.enter_subsection("Phase " + phase.name);
        prm.add_parameter("End time",
                          phase.end_time,
                          "When the phase ends, later than the one before. Required. [time]",
                          Patterns::Double(),
                          /*has_to_be_set=*/true);
        prm.add_parameter("Steps",
                          phase.steps,
                          "Number of its equal steps when none has to be cut.",
                          Patterns::Integer(1));
        prm.leave_subsection();
      }
    prm.add_parameter("Maximum cuts",
                      maximum_cuts,
                      "A step that does not converge is halved at most this many "
                      "times in a row.",
                      Patterns::Integer(0, 30));
  }



  void
  LoadSteppingParameters::check(const std::string &section) const
  {
    double before = 0.;
    for (const LoadPhase &phase : phases)
      {
        if (!(phase.end_time > before))
          throw InputError(section + "/Phase " + phase.name,
                           "End time",
                           Patterns::Tools::to_string(phase.end_time),
                           before == 0. ? "must be positive"
                                        : "must be later than the end of the phase before, " +
                                            Patterns::Tools::to_string(before),
                           "give the time t at which the phase ends, not its length");
        before = phase.end_time;
      }
    check_positive(section, "End time", end_time, "1 is as good as any other");
    check_steps(section);
  }



  void
  LoadSteppingParameters::check_steps(const std::string &section) const
  {
    // Their ends are numbers that are kept, and differ: by more than round-off, so that a step can
    // be cut as well.
    constexpr unsigned int most     = 10000000;
    constexpr double       smallest = 1e-12;
    double                 before   = 0.;
    for (const LoadPhase &phase : all_phases())
      {
        const std::string where = phases.empty() ? section : section + "/Phase " + phase.name;
        if (phase.steps > most)
          throw InputError(where,
                           "Steps",
                           std::to_string(phase.steps),
                           "are more steps than a run can have",
                           "ask for " + std::to_string(most) + " at most");
        if (!std::isnormal(1e-3 * (phase.end_time - before) / phase.steps) ||
            (phase.end_time - before) / phase.steps < smallest * phase.end_time)
          throw InputError(where,
                           "End time",
                           Patterns::Tools::to_string(phase.end_time),
                           "leaves steps that cannot be told from nothing",
                           "take other units of time, or fewer steps");
        before = phase.end_time;
      }
  }



  std::vector<LoadPhase>
  LoadSteppingParameters::all_phases() const
  {
    return phases.empty() ? std::vector<LoadPhase>{{"", end_time, steps}} : phases;
  }



  unsigned int
  LoadSteppingParameters::phase_at(const double time) const
  {
    // The tolerance is that of summing up step sizes; steps end exactly at ends of phases.
    unsigned int p = 0;
    while (p + 1 < phases.size() && time >= phases[p].end_time * (1. - 1e-12))
      ++p;
    return p;
  }



  double
  LoadSteppingParameters::phase_end(const double time) const
  {
    return phases.empty() ? end_time : phases[phase_at(time)].end_time;
  }



  double
  LoadSteppingParameters::nominal_step(const double time) const
  {
    if (phases.empty())
      return end_time / steps;
    const unsigned int p = phase_at(time);
    return (phases[p].end_time - (p == 0 ? 0. : phases[p - 1].end_time)) / phases[p].steps;
  }



  unsigned int
  LoadSteppingParameters::steps_after_phase(const double time) const
  {
    unsigned int sum = 0;
    for (unsigned int p = phase_at(time) + 1; p < phases.size(); ++p)
      sum += phases[p].steps;
    return sum;
  }



  std::vector<double>
  LoadSteppingParameters::step_ends() const
  {
    std::vector<double> result;
    double              begin = 0.;
    for (const LoadPhase &phase : all_phases())
      {
        for (unsigned int step = 1; step <= phase.steps; ++step)
          // The end itself, without the round-off of the division.
          result.push_back(step == phase.steps
                             ? phase.end_time
                             : begin + (phase.end_time - begin) * step / phase.steps);
        begin = phase.end_time;
      }
    return result;
  }
} // namespace Touchstone
