// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_impulse_work_h
#define touchstone_explicit_impulse_work_h

#include <algorithm>
#include <cstdint>

namespace Touchstone
{
  /** @brief What general contact had to do for its candidates; sums over all ranks. */
  struct CandidateCounts
  {
    /** Candidates of the last search, of a run those of the search with most; faces that were sent
     * to other ranks, and messages with them, in all searches; searches. */
    std::uint64_t candidates = 0, faces_sent = 0, messages = 0, searches = 0;
    /** Faces in the largest region over the mean, the worst of all searches. */
    double imbalance = 1.;

    /** @brief Add those of another time. */
    void
    add(const CandidateCounts &other)
    {
      candidates = std::max(candidates, other.candidates);
      faces_sent += other.faces_sent;
      messages += other.messages;
      searches += other.searches;
      imbalance = std::max(imbalance, other.imbalance);
    }

    /** @brief For checkpoints. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &candidates &faces_sent &messages &searches &imbalance;
    }
  };

  /** @brief What contact of explicit dynamics had to do since ImpulseContact::begin_interval(), or
   * in all of a run; the same on any number of ranks. */
  struct ImpulseWork
  {
    /** Cycles with contact pairs; sweeps in all of them, and in the one with most; rounds, after
     * which rows were added; renewals of the rows; cycles whose sweeps ended before the tolerance.
     */
    std::uint64_t cycles = 0, sweeps = 0, most_sweeps = 0, rounds = 0, renewals = 0,
                  unconverged = 0;
    /** Of general contact: checks of crossings in all cycles, in the one with most, and cycles with
     * more than five; cycles that were halved. */
    std::uint64_t crossing_rounds = 0, most_crossing_rounds = 0, many_crossing_rounds = 0,
                  halvings = 0;
    CandidateCounts search;
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
      crossing_rounds += other.crossing_rounds;
      most_crossing_rounds = std::max(most_crossing_rounds, other.most_crossing_rounds);
      many_crossing_rounds += other.many_crossing_rounds;
      halvings += other.halvings;
      search.add(other.search);
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
      auto &[n,
             all,
             most,
             of_rounds,
             made,
             ended,
             checks,
             most_checks,
             many_checks,
             halved,
             of_search,
             given] = *this;
      archive &n &all &most &of_rounds &made &ended &checks &most_checks &many_checks &halved;
      archive &of_search                                                              &given;
    }
  };
} // namespace Touchstone

#endif
