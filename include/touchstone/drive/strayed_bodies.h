// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_strayed_bodies_h
#define touchstone_drive_strayed_bodies_h

#include <touchstone/solid/solid.h>

#include <limits>
#include <map>
#include <set>
#include <string>

namespace Touchstone
{
  /** @brief The largest motion of a node of each of these bodies in one direction, from @p start to
   * @p u; length. Collective. */
  std::map<unsigned int, double>
  largest_motions(const std::set<unsigned int> &bodies,
                  const Solid                  &solid,
                  const Vector                 &start,
                  const Vector                 &u);

  /**
   * @brief How far the iterates of a step take bodies that nothing but contact holds.
   *
   * A ball that rolls between plates has many places of balance. Iterates that go much farther than
   * anything pushes it may end in another one than that next to the start of the step, which
   * shorter steps find (doc/theory.md 9).
   */
  class StrayedBodies
  {
  public:
    /** @brief An attempt at a step from the committed state of the time @p from. */
    void
    begin_step(double from);

    /** @brief The attempt begins again from its first guess. */
    void
    begin_round()
    {
      moved.clear();
    }

    /** @brief Whether it is the first attempt at the step: later ones, made in another way, are as
     * good as can be. On meshes that change within a step the first is that on the first mesh. */
    bool
    first_attempt() const
    {
      return first;
    }

    /** @brief An iterate @p u, from which the next increment starts; @p start is the committed
     * state. Collective. @param bodies Those that contact alone holds. */
    void
    note(const std::set<unsigned int> &bodies,
         const Solid                  &solid,
         const Vector                 &u,
         const Vector                 &start);

    /** @brief The largest motion of a node in one direction by any iterate so far; length. */
    double
    farthest(unsigned int body) const;

    /** @brief The same in words. @param pushed By how much anything has pushed it; length. */
    std::string
    in_words(unsigned int body, double pushed) const;

  private:
    double                         last_from = std::numeric_limits<double>::lowest();
    bool                           first     = true;
    std::map<unsigned int, double> moved;
  };
} // namespace Touchstone

#endif
