// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_progress_h
#define touchstone_output_progress_h

#include <touchstone/output/log.h>

#include <deal.II/base/timer.h>

namespace Touchstone
{
  /** @brief The state of one Newton iteration. */
  struct IterationRecord
  {
    unsigned int iteration = 0;
    /** Out-of-balance force relative to the forces that act; no unit. */
    double residual = 0.;
    /** Largest violation of the gap, relative to the slave faces; no unit. */
    double       gap    = 0.;
    unsigned int active = 0;
    /** Contact rows whose status changed. */
    unsigned int changes = 0;
    /** Of the linear solve; negative for a direct solver. */
    int linear_iterations = -1;
  };

  /** @brief Shows how far a run has come. */
  class Progress
  {
  public:
    /**
     * @param log      Must outlive this object.
     * @param end_time Time at which the run ends.
     */
    Progress(Log &log, double end_time);

    /** @brief The run resumes at this time, from which the remaining time is estimated. */
    void
    start_at(const double time)
    {
      start_time = time;
    }

    /** @brief "Step 2/4   t = 0.5": a step to the time @p time begins.
     * @param steps Number of steps expected in all. @param phase Its name, empty if it has none. */
    void
    begin_step(unsigned int step, unsigned int steps, double time, const std::string &phase = "");

    void
    iteration(const IterationRecord &record);

    /** @brief The step converged at the time given in begin_step(). */
    void
    end_step(unsigned int newton_iterations);

    /** @brief Of explicit dynamics: the output interval ended after this many cycles, of which the
     * shortest was @p step, which @p cell decides. @param nanoseconds Of a processor, for each cell
     * and cycle. @param contact Part of the time that contact took. */
    void
    end_step(unsigned int       cycles,
             double             step,
             const std::string &cell,
             double             nanoseconds,
             double             contact);

    /** @brief The step did not converge, for @p reason, and is tried again with
     * the step size @p step_size. */
    void
    cut_step(const std::string &reason, double step_size);

    /** @brief The step did not converge for @p reason, and is made again linearised consistently
     * from its first iteration on. */
    void
    repeat_step(const std::string &reason, const std::string &how);

    /** @brief The step converged, but is made again with the step size @p step_size, so
     * that it ends where bodies meet. */
    void
    shorten_step(double step_size);

  private:
    Log         &log;
    const double end_time;
    double       start_time = 0.;
    double       time;
    bool         header_due;
    /** "about 7 s left", with a comma before, or empty. */
    std::string
                  time_left(double elapsed) const;
    dealii::Timer timer;
  };

  /** @brief A duration as text, e.g. "7.3 s", "2 min 05 s", "1 h 30 min". */
  std::string
  readable_duration(double seconds);
} // namespace Touchstone

#endif
