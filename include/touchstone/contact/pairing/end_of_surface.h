// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_end_of_surface_h
#define touchstone_contact_pairing_end_of_surface_h

#include <touchstone/contact/row.h>

#include <limits>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Which slave nodes stay on the master surface a little beyond its end
   * (Tolerances::edge_hysteresis): a decision about the step, not about its iterates.
   *
   * A node that some iterate has closed must not stay where it would not have come on, or the
   * result would be that of this iterate. So nodes stay that have left the surface in contact and
   * have come back on without it: on neither side of the end there is a balance then. In the first
   * search of a step those in contact stay, and in explicit dynamics it is the only one.
   */
  class EndOfSurface
  {
  public:
    /** @brief Call before the search. The first call of a step is the one with another time. */
    void
    begin(const double time, const std::vector<ContactRow> &rows)
    {
      first   = time != of_step || has_left.size() != rows.size();
      of_step = time;
      if (first)
        has_left.assign(rows.size(), false);
    }

    /** @brief The step begins again. */
    void
    rollback()
    {
      of_step = std::numeric_limits<double>::quiet_NaN();
    }

    /** @brief Whether node @p k stays. */
    bool
    stays(const std::size_t k, const ContactRow &row) const
    {
      return row.was_active && (first || has_left[k]);
    }

    /** @brief The search for node @p k has found nothing. */
    void
    left(const std::size_t k, const ContactRow &row)
    {
      has_left[k] = has_left[k] || row.was_active;
    }

  private:
    double            of_step = std::numeric_limits<double>::quiet_NaN();
    bool              first   = true;
    std::vector<bool> has_left;
  };
} // namespace Touchstone

#endif
