// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/progress.h>

#include <cmath>
#include <cstdio>

namespace Touchstone
{
  namespace
  {
    /** Formatted text with C's printf, whose fixed columns keep the table of iterations aligned. */
    template <class... Arguments>
    std::string
    format(const char *pattern, const Arguments... arguments)
    {
      char buffer[256];
      std::snprintf(buffer, sizeof(buffer), pattern, arguments...);
      return buffer;
    }
  } // namespace



  std::string
  readable_duration(const double seconds)
  {
    // 59.95 is the smallest number that "%.1f" would print as 60.0 s.
    if (seconds < 59.95)
      return format("%.1f s", seconds);
    const long whole = std::lround(seconds);
    if (whole < 3600)
      return format("%ld min %02ld s", whole / 60, whole % 60);
    return format("%ld h %02ld min", whole / 3600, (whole % 3600) / 60);
  }



  Progress::Progress(Log &log, const double end_time)
    : log(log)
    , end_time(end_time)
    , time(0.)
    , header_due(false)
  {
  }



  void
  Progress::begin_step(const unsigned int step,
                       const unsigned int steps,
                       const double       time,
                       const std::string &phase)
  {
    this->time = time;
    header_due = true;
    log.line();
    log.line(format("Step %u/%u   t = %g", step, steps, time) +
             (phase.empty() ? "" : "   " + phase));
  }



  void
  Progress::iteration(const IterationRecord &record)
  {
    // The header is repeated for each attempt of a step.
    if (header_due)
      log.line("  iteration   residual        gap   active  changes   linear");
    header_due = false;
    log.line(format("  %9u   %8.2e   %8.2e %8u %8u %8s",
                    record.iteration,
                    record.residual,
                    record.gap,
                    record.active,
                    record.changes,
                    // Direct solvers have no iterations.
                    record.linear_iterations < 0
                      ? "direct"
                      : std::to_string(record.linear_iterations).c_str()));
  }



  void
  Progress::end_step(const unsigned int newton_iterations)
  {
    const double elapsed = timer.wall_time();
    log.line(format("  converged in %u iterations, ", newton_iterations) +
             readable_duration(elapsed) + time_left(elapsed));
  }



  std::string
  Progress::time_left(const double elapsed) const
  {
    // Linear extrapolation of the time so far over the time t of the scene, without what a resumed
    // run did before.
    if (time < end_time && time > start_time)
      return ", about " + readable_duration(elapsed * (end_time - time) / (time - start_time)) +
             " left";
    return "";
  }



  void
  Progress::end_step(const unsigned int cycles,
                     const double       step,
                     const std::string &cell,
                     const double       nanoseconds,
                     const double       contact)
  {
    const double elapsed = timer.wall_time();
    std::string  cost    = format(", %.3g ns a cell and cycle", nanoseconds);
    if (contact > 0.)
      cost += format(", %.0f %% of it contact", 100. * contact);
    log.line(format("  %u cycles of %.4g or longer, as ", cycles, step) + cell + " needs" + cost +
             ", " + readable_duration(elapsed) + time_left(elapsed));
  }



  void
  Progress::cut_step(const std::string &reason, const double step_size)
  {
    log.line("  not converged: " + reason);
    log.line(format("  trying again with a step of %g", step_size));
    header_due = true;
  }



  void
  Progress::repeat_step(const std::string &reason, const std::string &how)
  {
    log.line("  not converged: " + reason);
    log.line("  trying again, " + how);
    header_due = true;
  }



  void
  Progress::shorten_step(const double step_size)
  {
    log.line(format("  bodies meet: made again with a step of %g, up to there", step_size));
    header_due = true;
  }
} // namespace Touchstone
