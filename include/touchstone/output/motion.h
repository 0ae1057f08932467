// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_motion_h
#define touchstone_output_motion_h

#include <touchstone/contact/results.h>
#include <touchstone/output/json.h>
#include <touchstone/solid/energies.h>

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Results of bodies with inertia: impacts by contact pair, mean velocities and energies.
   */
  struct Motion
  {
    /** @brief The contact of one pair over time. */
    struct Impact
    {
      /** When contact began first and ended last; time. */
      double begin = 0., end = 0.;
      /** How often contact opened. */
      unsigned int openings = 0;
      bool         touching = false, touched = false;
      /** Integral of the contact force over time; force times time. */
      dealii::Tensor<1, dim> impulse;
      /** Largest contact force. */
      double peak_force = 0.;

      /** @brief For checkpoints; names all members. */
      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        auto &[from, to, opened, touches, has_touched, integral, peak] = *this;
        archive &from &to &opened &touches &has_touched &integral &peak;
      }
    };
    /** By name of the pair. */
    std::map<std::string, Impact> impacts;
    /** Mean velocity of each body by its name, momentum over mass; length per time. */
    std::map<std::string, dealii::Tensor<1, dim>> velocities;
    Energies                                      energies;

    /** @brief For checkpoints. All members are named, so that this does not compile if one is
     * forgotten. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      auto &[of_pairs, of_bodies, sums] = *this;
      archive &of_pairs &of_bodies &sums;
    }

    /** @brief Take note of the contact @p result of a pair at the end of the step from
     * time @p begin to @p end: its force acts over the step. */
    void
    add_step(const std::string &pair, double begin, double end, const PairResult &result);

    Json
    to_json() const;

    /** @brief Six digits, and no more than is the same for any number of ranks. */
    void
    print(std::ostream &out) const;
  };
} // namespace Touchstone

#endif
