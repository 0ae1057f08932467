// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_exact_sum_h
#define touchstone_base_exact_sum_h

#include <deal.II/base/mpi.h>

#include <array>
#include <cstdint>

namespace Touchstone
{
  /**
   * @brief A sum of numbers without round-off, and so independent of their order and of the rank
   * that adds them.
   *
   * The sum is a fixed-point number that covers all exponents of double, in digits of 32 bits with
   * room for carries (Neal 2015, "Fast exact summation using small and large superaccumulators").
   * Adding costs a few integer operations; the result is rounded once. See doc/explicit.md, section
   * 2.
   */
  class ExactSum
  {
  public:
    /** @brief Add a number. One that is not finite makes the sum NaN. */
    void
    add(double value);

    /** @brief Add the numbers of another sum. */
    void
    add(const ExactSum &other);

    /** @brief The sum so far of this rank, rounded. */
    double
    value() const;

    /** @brief The sum over all ranks, the same bits on all of them. Collective. */
    double
    value(MPI_Comm communicator) const;

  private:
    /** Digits of 32 bits: from 2^-1152, below the smallest number, to 2^1152. */
    static constexpr unsigned int n_digits = 72;
    static constexpr int          lowest   = -1152;
    /** Carries are spread before they could overflow the digits. */
    static constexpr unsigned int      most_additions = 1U << 30;
    std::array<std::int64_t, n_digits> digits{};
    std::int64_t                       n_invalid = 0;
    unsigned int                       additions = 0;

    /** Make all digits but the highest lie in [0, 2^32). */
    void
    carry();
  };
} // namespace Touchstone

#endif
