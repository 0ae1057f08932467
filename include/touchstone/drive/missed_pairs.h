// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_missed_pairs_h
#define touchstone_drive_missed_pairs_h

#include <touchstone/contact/contact_checks.h>
#include <touchstone/output/warnings.h>

#include <map>
#include <string>

namespace Touchstone
{
  /**
   * @brief What rows have missed in the steps of a run, and whether a run may end with it.
   *
   * A coarse slave surface misses a curved master by the height of an arc before its nodes touch;
   * that alone is a warning, and so is a small part that is missed. But a pair that carries
   * nothing, or little of what it should, though its surfaces have passed into each other has no
   * result. See doc/theory.md 4.1.
   */
  class MissedPairs
  {
  public:
    /** By the names of pairs. */
    using Missed = std::map<std::string, MissedByRows>;

    /** @throws UnresolvedContactFailure if something that was missed is deep. */
    static Missed
    shallow(const Missed &missed);

    /** @brief A step is kept: warn of pairs when they have missed something first. */
    void
    end_step(const Missed &missed, Warnings &warnings);

    /** @brief Why a run that has come to its end has no result; empty if it has.
     * @param had_contact Pairs that have carried something in the run.
     * @param dynamic     The end is a moment of a motion: what pairs miss there is a warning if
     * they have carried something before. */
    std::string
    failure(const std::map<std::string, double> &had_contact, bool dynamic) const;

    /** @brief For checkpoints. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &first &last;
    }

  private:
    /** When it first happened, and in the last step. */
    Missed first, last;
  };
} // namespace Touchstone

#endif
