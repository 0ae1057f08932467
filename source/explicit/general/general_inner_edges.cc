// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/general_contact.h>
#include <touchstone/explicit/general/moving_points.h>

#include <algorithm>
#include <cmath>

// The check of crossings of warped faces: edges from their corners to the middle, and the middle
// itself (doc/general_contact.md, section 2).
namespace Touchstone
{
  using namespace dealii;

  // What another pair of faces looks at is left alone.
  std::vector<GeneralContact::Separation>
  GeneralContact::separations_of_inner_edges(const ContactCandidates::FacePair &pair) const
  {
    Separation never;
    never.until = std::numeric_limits<double>::max();
    std::vector<Separation> result;
    for (unsigned int e = 0; e < 8; ++e)
      for (unsigned int f = e < 4 ? 4 : 0; f < 8; ++f)
        {
          const unsigned int bit = e < 4 ? e : f < 4 ? 4 + f : ContactCandidates::of_both;
          result.push_back(pair.inner[bit] ? Separation() : never);
        }
    result.resize(result.size() + 2, pair.inner[ContactCandidates::of_both] ? Separation() : never);
    return result;
  }



  // The middle of a warped face can reach further than its edges, and so can the edges from there
  // to the corners. Of a plane face nothing meets them before it meets the face or its edges.
  void
  GeneralContact::check_inner_edges(const ContactCandidates::FacePair &pair, const OpenFaces &faces)
  {
    InnerSeparations &apart     = apart_inner[faces.pair];
    const auto        far_apart = [&](const double until) { return until > travelled + travels; };
    if (far_apart(apart.until))
      return;
    const unsigned int one = pair.one, other = pair.other;
    const bool         of_one = moving.is_warped(one), of_other = moving.is_warped(other);
    if (!of_one && !of_other)
      return;
    // Each two of three kinds of 16 pairs, and the middles.
    if (apart.each.empty())
      apart.each = separations_of_inner_edges(pair);
    // Edges of both faces, and from their corners to the middles.
    const auto edge = [&](const unsigned int face, const unsigned int a) -> MovingSurface::Edge {
      return a < 4 ? moving.ends_of(moving.corner(face, a).slot)
                   : MovingSurface::Edge{{moving.corner(face, a), moving.middle(face)}};
    };
    // Their boxes only if nothing is known of a pair.
    std::array<std::array<MotionBox, 8>, 2> boxes;
    bool                                    boxed = false;
    const auto distance_of_boxes = [&](const unsigned int e, const unsigned int f) {
      for (unsigned int side = 0; side < 2 && !boxed; ++side)
        for (unsigned int a = 0; a < 8; ++a)
          {
            const MovingSurface::Edge of = edge(side == 0 ? one : other, a);
            boxes[side][a] = MotionBox(moving.inner_edge(of, false), moving.inner_edge(of, true));
          }
      boxed = true;
      return boxes[0][e].distance(boxes[1][f]);
    };
    unsigned int n = 0;
    for (unsigned int e = 0; e < 8; ++e)
      for (unsigned int f = e < 4 ? 4 : 0; f < 8; ++f)
        {
          Separation &of = apart.each[n++];
          if ((e >= 4 && !of_one) || (f >= 4 && !of_other) || far_apart(of.until))
            continue;
          const double distance = of.known ? 0. : distance_of_boxes(e, f);
          if (distance > 0.)
            of.until = travelled + distance - reserve * faces.size;
          else
            {
              const MovingSurface::Edge first = edge(one, e), second = edge(other, f);
              check_edges({{first[0], first[1], second[0], second[1]}}, faces, of);
            }
        }
    if (of_one && !far_apart(apart.each[n].until))
      check_node(moving.middle(one), other, faces, apart.each[n]);
    if (of_other && !far_apart(apart.each[n + 1].until))
      check_node(moving.middle(other), one, faces, apart.each[n + 1]);
    apart.until = std::numeric_limits<double>::max();
    for (const Separation &of : apart.each)
      apart.until = std::min(apart.until, of.until);
  }
} // namespace Touchstone
