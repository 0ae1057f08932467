// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/cell_states.h>

#include <deal.II/base/exceptions.h>

// History of the cells of a body in blocks of eight (doc/explicit.md, section 5).
namespace Touchstone
{
  CellStates::CellStates(const unsigned int n_cells,
                         const MaterialLaw *law,
                         const unsigned int n_points)
    : n(law != nullptr ? n_points * law->n_state() : 0)
    , n_cells(n_cells)
  {
    if (n == 0)
      return;
    const unsigned int n_blocks = (n_cells + n_lanes - 1) / n_lanes;
    present.resize(std::size_t(n_blocks) * n * n_lanes);
    std::vector<double> virgin(n);
    for (unsigned int q = 0; q < n_points; ++q)
      law->start(virgin.data() + q * law->n_state());
    for (unsigned int c = 0; c < n_blocks * n_lanes; ++c)
      for (unsigned int k = 0; k < n; ++k)
        present[place(c, k, n)] = virgin[k];
    committed = present;
  }



  void
  CellStates::read(const std::vector<double> &states, const unsigned int c, double *values) const
  {
    for (unsigned int k = 0; k < n; ++k)
      values[k] = states[place(c, k, n)];
  }



  void
  CellStates::put(const unsigned int c, const double *values)
  {
    for (unsigned int k = 0; k < n; ++k)
      present[place(c, k, n)] = values[k];
  }



  std::vector<double>
  CellStates::committed_state(const unsigned int c) const
  {
    std::vector<double> result(n);
    read(committed, c, result.data());
    return result;
  }



  void
  CellStates::set(const unsigned int c, const std::vector<double> &values)
  {
    AssertThrow(values.size() == n, dealii::ExcDimensionMismatch(values.size(), n));
    if (n == 0)
      return;
    // The rest of the last block repeats the last cell.
    const unsigned int end = c + 1 == n_cells ? (n_cells + n_lanes - 1) / n_lanes * n_lanes : c + 1;
    for (unsigned int other = c; other < end; ++other)
      for (unsigned int k = 0; k < n; ++k)
        committed[place(other, k, n)] = present[place(other, k, n)] = values[k];
  }
} // namespace Touchstone
