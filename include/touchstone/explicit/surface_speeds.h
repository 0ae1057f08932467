// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_surface_speeds_h
#define touchstone_explicit_surface_speeds_h

#include <touchstone/contact/contact.h>
#include <touchstone/explicit/node_map.h>

#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Bounds of the velocities of the nodes of contact surfaces, over all ranks: with them it
   * is known for how long nothing can have come of a row (doc/explicit.md, section 9.5). */
  struct Speeds
  {
    /** Of any node. */
    double highest = 0.;
    /** Of any two nodes of both sides of a pair, and of one side alone, relative to each other. */
    double apart = 0., within = 0.;
  };

  /** @brief Finds the Speeds of the surfaces of contact. */
  class SurfaceSpeeds
  {
  public:
    SurfaceSpeeds(const Contact &contact, const NodeMap &nodes);

    /** @brief Whether any pair is of two bodies: without, speeds are not needed. */
    bool
    needed() const
    {
      return !sides.empty();
    }

    /** @brief A field of velocities, with its ghosts, and where its result goes. */
    using Measured = std::pair<const NodeField *, Speeds *>;

    /** @brief Of several fields at once. Collective. */
    void
    measure(const std::vector<Measured> &fields) const;

  private:
    const NodeMap &nodes;
    /** Local nodes of both sides of each pair of bodies, one pair after the other, and of the slave
     * surfaces of all others. */
    std::vector<std::vector<unsigned int>> sides;
    std::vector<unsigned int>              others;
  };
} // namespace Touchstone

#endif
