// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_spring_stiffness_h
#define touchstone_contact_enforcement_spring_stiffness_h

#include <algorithm>

namespace Touchstone
{
  /**
   * @brief How stiff the springs of a row are in the linear systems of a step: those that meet its
   * refused conditions, and those that stand for friction across a slip that is next to nothing
   * (doc/theory.md 6, "How stiff these springs are").
   *
   * The forces of springs of stiffness k are found by iteration, in which gaps fall by 1/(1 + k s),
   * s the compliance of what the springs pull at. Where supports hold the slave node and its
   * neighbours pull at the master in other directions, s is small, and with it what a gap tells of
   * the force: gap/s is left. So springs that have closed their gaps by less than a factor of four
   * become stiffer within the step, and gaps are judged by the force that they leave.
   */
  class SpringStiffness
  {
  public:
    /** @brief Force per length. @param row_stiffness ContactRow::stiffness. */
    double
    of(const double row_stiffness) const
    {
      return of_row * growth * row_stiffness;
    }

    /** @brief A linear solve has left this gap, or slip, of a spring of the row; length. */
    void
    found(const double length)
    {
      after = std::max(after, length);
    }

    /** @brief All springs of the row have told what is left. @param round_off Length of gaps that
     * nothing can be said of. */
    void
    judge(const double round_off)
    {
      constexpr double closes = 0.25, by = 10., stiffest = 1e3, slowest = 0.9, unknown = 0.5,
                       strictest = 1e3;
      severity                   = 1.;
      if (after > round_off)
        {
          const double rate = before > 0. ? std::min(after / before, slowest) : unknown;
          severity          = std::clamp(of_row * growth * rate / (1. - rate), 1., strictest);
          if (before > 0. && after > closes * before)
            growth = std::min(by * growth, stiffest);
        }
      before = after;
      after  = 0.;
    }

    /** @brief How many times as strictly as others the gaps of the row are judged: by the force
     * k g r/(1 - r) that springs have yet to find, with the rate r of the last iteration. */
    double
    strictness() const
    {
      return severity;
    }

  private:
    /** Of the stiffness of the row. */
    static constexpr double of_row = 100.;

    double growth = 1., before = 0., after = 0., severity = 1.;
  };
} // namespace Touchstone

#endif
