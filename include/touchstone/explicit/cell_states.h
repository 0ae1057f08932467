// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_cell_states_h
#define touchstone_explicit_cell_states_h

#include <touchstone/explicit/n_lanes.h>
#include <touchstone/solid/material_law.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief History of the cells of a body: of eight cells at a time, as vector instructions take
   * it.
   *
   * The present state goes on from cycle to cycle; the committed one is that of the last output.
   */
  class CellStates
  {
  public:
    /** @brief Virgin material. @param law Null: no history. @param n_points Of a cell. */
    CellStates(unsigned int n_cells, const MaterialLaw *law, unsigned int n_points);

    /** @brief Numbers of a cell. */
    unsigned int
    size() const
    {
      return n;
    }

    /** @brief Present state of a block of cells, [variable][cell of the block]. */
    double (*block(const unsigned int b))[n_lanes]
    {
      return reinterpret_cast<double(*)[n_lanes]>(present.data() + std::size_t(b) * n * n_lanes);
    }

    /** @brief Write the present state of a cell to @p values. */
    void
    get(const unsigned int c, double *values) const
    {
      read(present, c, values);
    }

    /** @brief Set the present state of a cell. */
    void
    put(unsigned int c, const double *values);

    /** @brief Committed state of a cell. */
    std::vector<double>
    committed_state(unsigned int c) const;

    /** @brief Set the present and the committed state of a cell. */
    void
    set(unsigned int c, const std::vector<double> &values);

    void
    commit()
    {
      committed = present;
    }
    void
    rollback()
    {
      present = committed;
    }

  private:
    const unsigned int  n, n_cells;
    std::vector<double> present, committed;

    static std::size_t
    place(const unsigned int c, const unsigned int k, const unsigned int n)
    {
      return (std::size_t(c / n_lanes) * n + k) * n_lanes + c % n_lanes;
    }
    void
    read(const std::vector<double> &states, unsigned int c, double *values) const;
  };
} // namespace Touchstone

#endif
