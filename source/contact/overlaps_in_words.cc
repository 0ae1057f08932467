// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/overlapping_bodies.h>
#include <touchstone/contact/tolerances.h>
#include <touchstone/contact/unnamed_nodes.h>

#include <algorithm>

// What a run says of bodies that overlap where it ends (doc/theory.md 4.1).
namespace Touchstone
{
  namespace
  {
    NamedBoundaries
    named_boundaries(const Contact &contact)
    {
      NamedBoundaries result;
      for (unsigned int p = 0; p < contact.n_pairs(); ++p)
        {
          const ContactPair &pair = contact.pair(p);
          for (const auto id : pair.slave().boundaries())
            result.emplace(pair.slave_body(), id);
          if (pair.master())
            for (const auto id : pair.master()->boundaries())
              result.emplace(pair.master_body(), id);
        }
      return result;
    }



    /** Of each two bodies the deepest node in the other one that lies on no boundary which a pair
     * names, unless it was half as deep at the start. Collective. */
    std::vector<BodyOverlap>
    unnamed_overlaps(const Contact &contact, const Vector &u, const std::set<unsigned int> &bodies)
    {
      std::vector<PointOfBody> now, start;
      for (const UnnamedNode &node : unnamed_nodes(contact, named_boundaries(contact), u))
        {
          now.push_back({node.body, node.node, node.now});
          start.push_back({node.body, node.node, node.start});
        }
      constexpr double         half = 0.5;
      std::vector<BodyOverlap> result =
        points_in_bodies(contact, u, bodies, now, Tolerances::unnamed_in_body);
      if (result.empty())
        return result;
      const std::vector<BodyOverlap> before =
        points_in_bodies(contact,
                         contact.with_ghosts(contact.solid_model().zero_vector()),
                         bodies,
                         start,
                         half * Tolerances::unnamed_in_body);
      const auto was_there = [&](const BodyOverlap &overlap) {
        return std::any_of(before.begin(), before.end(), [&](const BodyOverlap &other) {
          return other.body == overlap.body && other.other == overlap.other &&
                 other.depth >= half * overlap.depth;
        });
      };
      result.erase(std::remove_if(result.begin(),
                                  result.end(),
                                  [&](const BodyOverlap &overlap) {
                                    return overlap.body == overlap.other || was_there(overlap);
                                  }),
                   result.end());
      return result;
    }
  } // namespace



  std::vector<std::string>
  overlapping_bodies(const Contact &contact, const Vector &u)
  {
    const Solid           &solid = contact.solid_model();
    std::set<unsigned int> bodies;
    for (unsigned int b = 0; b < solid.bodies.size(); ++b)
      bodies.insert(b);
    const std::vector<BodyOverlap> deep = overlapping_bodies(contact, u, bodies);
    std::vector<std::string>       result;
    for (const BodyOverlap &overlap : deep)
      result.push_back(overlap.text(solid));
    for (const BodyOverlap &overlap : unnamed_overlaps(contact, u, bodies))
      if (std::none_of(deep.begin(), deep.end(), [&](const BodyOverlap &other) {
            return std::minmax(other.body, other.other) == std::minmax(overlap.body, overlap.other);
          }))
        result.push_back(overlap.place(solid) +
                         ", with a face that no contact pair names. Name all that may touch in "
                         "'Slave boundaries' and 'Master boundaries'");
    return result;
  }
} // namespace Touchstone
