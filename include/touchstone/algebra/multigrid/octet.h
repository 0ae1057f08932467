#ifndef touchstone_algebra_multigrid_octet_h
#define touchstone_algebra_multigrid_octet_h

#include <touchstone/base/types.h>

#include <array>

namespace Touchstone
{
  /** @brief Six numbers, one for each rigid motion of an aggregate, and two that nobody
   * asks for: what fits into registers, at any address. (VectorizedArray of a deal.II that
   * was built for all processors has but one number.) */
  using Octet __attribute__((vector_size(64), aligned(8))) = double;

  /** @brief An Octet for each of some rows. */
  template <unsigned int n_rows>
  struct Octets
  {
    Octet row[n_rows];

    Octet &
    operator[](const unsigned int r)
    {
      return row[r];
    }

    const Octet &
    operator[](const unsigned int r) const
    {
      return row[r];
    }
  };

  /** @brief Rows of a node. */
  using OctetsOfNode = Octets<dim>;

  /** @brief to += a p, of a block of a matrix over nodes, row by row, and one of six
   * columns, behind which two more numbers are read. To be called from functions with
   * versions for several processors. */
  inline void
  add_product(const std::array<double, dim * dim> &a, const float *const p, OctetsOfNode &to)
  {
    using Floats __attribute__((vector_size(32), aligned(4), may_alias)) = float;
    static_assert(dim == 3, "three rows of P are kept in registers");
    const Octet p0 = __builtin_convertvector(*reinterpret_cast<const Floats *>(p), Octet),
                p1 = __builtin_convertvector(*reinterpret_cast<const Floats *>(p + 6), Octet),
                p2 = __builtin_convertvector(*reinterpret_cast<const Floats *>(p + 12), Octet);
    for (unsigned int r = 0; r < dim; ++r)
      to[r] += a[dim * r] * p0 + a[dim * r + 1] * p1 + a[dim * r + 2] * p2;
  }
} // namespace Touchstone

#endif
