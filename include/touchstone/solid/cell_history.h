// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_cell_history_h
#define touchstone_solid_cell_history_h

#include <vector>

namespace Touchstone
{
  /** @brief Keeps the history of material by cell, see Solid::keep_history_in(). */
  class CellHistory
  {
  public:
    virtual ~CellHistory() = default;

    /** @brief Committed state of an active cell of the triangulation in the form of
     * Solid::cell_state(). */
    virtual std::vector<double>
    committed_state(unsigned int cell) const = 0;

    /** @brief Set the committed and the present state. Cells that are not kept are ignored. */
    virtual void
    set_state(unsigned int cell, const std::vector<double> &values) = 0;
  };
} // namespace Touchstone

#endif
