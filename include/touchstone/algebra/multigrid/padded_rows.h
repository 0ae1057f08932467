// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_multigrid_padded_rows_h
#define touchstone_algebra_multigrid_padded_rows_h

#include <touchstone/base/types.h>
#include <touchstone/base/vectorised.h>

#include <array>

namespace Touchstone
{
  /** @brief Six numbers, one for each rigid motion of an aggregate, padded to eight that are loaded
   * at once; the last two mean nothing. */
  using Vector8 = Simd<double, 8>::type;

  /** @brief A Vector8 for each of some rows. */
  template <unsigned int n_rows>
  struct PaddedRows
  {
    Vector8 row[n_rows];

    Vector8 &
    operator[](const unsigned int r)
    {
      return row[r];
    }

    const Vector8 &
    operator[](const unsigned int r) const
    {
      return row[r];
    }
  };

  /** @brief Rows of a node. */
  using NodeRows = PaddedRows<dim>;

  /** @brief to += a p for a 3 x 3 block a, by rows, and a 3 x 6 block p, by rows, behind which two
   * more numbers are read. Called from functions that are TOUCHSTONE_VECTORISED. */
  inline void
  add_product(const std::array<double, dim * dim> &a, const float *const p, NodeRows &to)
  {
    using Floats = Simd<float, 8>::type;
    static_assert(dim == 3, "three rows of P are kept in registers");
    const Vector8 p0 = TOUCHSTONE_CONVERT(*reinterpret_cast<const Floats *>(p), Vector8),
                  p1 = TOUCHSTONE_CONVERT(*reinterpret_cast<const Floats *>(p + 6), Vector8),
                  p2 = TOUCHSTONE_CONVERT(*reinterpret_cast<const Floats *>(p + 12), Vector8);
    for (unsigned int r = 0; r < dim; ++r)
      to[r] += a[dim * r] * p0 + a[dim * r + 1] * p1 + a[dim * r + 2] * p2;
  }
} // namespace Touchstone

#endif
