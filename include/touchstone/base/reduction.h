// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_reduction_h
#define touchstone_base_reduction_h

#include <cstdint>
#include <mpi.h>
#include <numeric>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Several sums and maxima over all ranks by one message instead of one after the other: on
   * many ranks a reduction of few numbers takes as long as its messages need to arrive, whatever
   * the numbers (doc/scaling.md).
   */
  class Reduction
  {
  public:
    /** @brief Ask for the sum or maximum of a number; it is replaced by over(), until which it must
     * live. All ranks ask for the same in the same order. Whole numbers wrap around. */
    void
    sum(double &value);
    void
    sum(std::uint64_t &value);
    void
    max(double &value);

    /** @brief Replace the numbers. Collective. */
    void
    over(MPI_Comm communicator);

    /** @brief A number on its way, bit by bit, and what is to be made of it. */
    struct Entry
    {
      enum Kind : std::uint64_t
      {
        sum_of_reals,
        sum_of_integers,
        largest_real
      };
      Kind          kind;
      std::uint64_t bits;
    };

  private:
    std::vector<Entry>  entries;
    std::vector<void *> values;
  };



  /** @brief Square of the norm of what this rank has of a vector. */
  template <class Vector>
  double
  squared_on_rank(const Vector &vector)
  {
    return std::inner_product(vector.begin(), vector.end(), vector.begin(), 0.);
  }
} // namespace Touchstone

#endif
