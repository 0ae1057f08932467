// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_missed_pairs_h
#define touchstone_drive_missed_pairs_h

#include <touchstone/contact/contact_checks.h>
#include <touchstone/output/summary.h>
#include <touchstone/output/warnings.h>

#include <map>
#include <string>

namespace Touchstone
{
  /**
   * @brief What rows have missed in the steps of a run, and whether a run may end with it.
   *
   * A coarse slave surface misses a curved master by the height of an arc before its nodes touch;
   * that alone is a warning. But a pair that carries nothing though its surfaces have passed into
   * each other has no result. See doc/theory.md 4.1.
   */
  class MissedPairs
  {
  public:
    /** By the names of pairs: what was missed, where, and the remedy. */
    using Texts = std::map<std::string, std::string>;

    /** @throws UnresolvedContactFailure if something that was missed is deep. */
    static Texts
    shallow(const std::map<std::string, MissedByRows> &missed);

    /** @brief A step is kept: warn of pairs when they have missed something first. */
    void
    end_step(const Texts &missed, Warnings &warnings);

    /** @brief Why a run that has come to its end has no result; empty if it has.
     * @param results     Of the last step, by the names of pairs.
     * @param had_contact Pairs that have carried something in the run. */
    std::string
    failure(const std::map<std::string, PairResult> &results,
            const std::map<std::string, double>     &had_contact) const;

    /** @brief For checkpoints. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &first &last;
    }

  private:
    /** When it first happened, and in the last step. */
    Texts first, last;
  };
} // namespace Touchstone

#endif
