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
    const unsigned int one = pair.one, other = pair.other;
    // What is known of each of three kinds of 16 pairs, and of the middles.
    std::vector<Separation> &known = apart_inner[faces.pair];
    if (known.empty())
      known = separations_of_inner_edges(pair);
    const auto far_apart = [&](const Separation &of) { return of.until > travelled + travels; };
    if (std::all_of(known.begin(), known.end(), far_apart))
      return;
    const bool of_one = moving.is_warped(one), of_other = moving.is_warped(other);
    if (!of_one && !of_other)
      return;
    // Edges of both faces, and from their corners to the middles; their boxes only if nothing is
    // known of a pair.
    std::array<std::array<std::array<SurfacePoint, 2>, 8>, 2> edges;
    for (unsigned int side = 0; side < 2; ++side)
      for (unsigned int a = 0; a < 4; ++a)
        {
          const unsigned int face = side == 0 ? one : other;
          edges[side][a]          = moving.ends_of(moving.corner(face, a).slot);
          edges[side][4 + a]      = {{moving.corner(face, a), moving.middle(face)}};
        }
    std::array<std::array<MotionBox, 8>, 2> boxes;
    bool                                    boxed = false;
    const auto apart = [&](const unsigned int e, const unsigned int f) {
      for (unsigned int side = 0; side < 2 && !boxed; ++side)
        for (unsigned int a = 0; a < 8; ++a)
          boxes[side][a] = MotionBox(moving.inner_edge(edges[side][a], false),
                                     moving.inner_edge(edges[side][a], true));
      boxed = true;
      return boxes[0][e].distance(boxes[1][f]);
    };
    unsigned int n = 0;
    for (unsigned int e = 0; e < 8; ++e)
      for (unsigned int f = e < 4 ? 4 : 0; f < 8; ++f)
        {
          Separation &of = known[n++];
          if ((e >= 4 && !of_one) || (f >= 4 && !of_other) || far_apart(of))
            continue;
          if (const double distance = of.known ? 0. : apart(e, f); distance > 0.)
            of.until = travelled + distance - reserve * faces.size;
          else
            check_edges({{edges[0][e][0], edges[0][e][1], edges[1][f][0], edges[1][f][1]}},
                        faces,
                        of);
        }
    if (of_one && !far_apart(known[n]))
      check_node(moving.middle(one), other, faces, known[n]);
    if (of_other && !far_apart(known[n + 1]))
      check_node(moving.middle(other), one, faces, known[n + 1]);
  }
} // namespace Touchstone
