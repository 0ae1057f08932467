// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_impulse_work_h
#define touchstone_explicit_impulse_work_h

#include <algorithm>
#include <cstdint>

namespace Touchstone
{
  /** @brief What contact of explicit dynamics had to do since ImpulseContact::begin_interval(), or
   * in all of a run; the same on any number of ranks. */
  struct ImpulseWork
  {
    /** Cycles with contact pairs; sweeps in all of them, and in the one with most; rounds, after
     * which rows were added; renewals of the rows; cycles whose sweeps ended before the tolerance.
     */
    std::uint64_t cycles = 0, sweeps = 0, most_sweeps = 0, rounds = 0, renewals = 0,
                  unconverged = 0;
    /** Largest energy that contact has given in a cycle, without what overlaps and obstacles supply
     * and what springs give back. */
    double most_given = 0.;

    /** @brief Add those of another time. */
    void
    add(const ImpulseWork &other)
    {
      cycles += other.cycles;
      sweeps += other.sweeps;
      most_sweeps = std::max(most_sweeps, other.most_sweeps);
      rounds += other.rounds;
      renewals += other.renewals;
      unconverged += other.unconverged;
      most_given = std::max(most_given, other.most_given);
    }

    double
    mean_sweeps() const
    {
      return cycles > 0 ? double(sweeps) / cycles : 0.;
    }

    /** @brief For checkpoints; names all members. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      auto &[n, all, most, of_rounds, made, ended, given] = *this;
      archive &n &all &most &of_rounds &made &ended &given;
    }
  };
} // namespace Touchstone

#endif
