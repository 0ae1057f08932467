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

  bool
  GeneralContact::is_warped(const unsigned int face) const
  {
    for (const bool at_end : {false, true})
      {
        std::array<Point<dim>, 4> x;
        for (unsigned int a = 0; a < 4; ++a)
          x[a] = inner_position(corner(face, a), at_end);
        const Tensor<1, dim> normal = cross_product_3d(x[2] - x[0], x[3] - x[1]);
        if (std::abs(normal * (x[0] - x[1] + x[2] - x[3])) >
            inset * size(corner(face, 0)) * normal.norm())
          return true;
      }
    return false;
  }



  // The middle of a warped face can reach further than its edges, and so can the edges from there
  // to the corners. Of a plane face nothing meets them before it meets the face or its edges.
  void
  GeneralContact::check_inner_edges(const unsigned int one,
                                    const unsigned int other,
                                    const OpenFaces   &faces)
  {
    // What is known of each of three kinds of 16 pairs, and of the middles.
    std::vector<Separation> &known = apart_inner[faces.pair];
    known.resize(3 * 16 + 2);
    const auto far_apart = [&](const Separation &of) { return of.until > travelled + travels; };
    if (std::all_of(known.begin(), known.end(), far_apart))
      return;
    const bool of_one = is_warped(one), of_other = is_warped(other);
    if (!of_one && !of_other)
      return;
    // Edges of the face, and from its corners to the middle, with their boxes.
    struct Edge
    {
      std::array<SurfacePoint, 2> ends;
      MotionBox                   box;
    };
    const auto edges_of = [&](const unsigned int face, const bool inner) {
      std::array<Edge, 4> edges;
      for (unsigned int a = 0; a < 4; ++a)
        {
          const SurfacePoint begin = corner(face, a);
          edges[a].ends =
            inner ? std::array<SurfacePoint, 2>{{begin, middle(face)}} : ends_of(begin.slot);
          edges[a].box =
            MotionBox(inner_edge(edges[a].ends, false), inner_edge(edges[a].ends, true));
        }
      return edges;
    };
    const std::array<std::array<Edge, 4>, 2> edges_of_one{
      {edges_of(one, false), edges_of(one, true)}},
      edges_of_other{{edges_of(other, false), edges_of(other, true)}};
    unsigned int n = 0;
    for (const bool inner_one : {false, true})
      for (const bool inner_other : {false, true})
        if (inner_one || inner_other)
          for (const Edge &e : edges_of_one[inner_one])
            for (const Edge &f : edges_of_other[inner_other])
              {
                Separation &of = known[n++];
                if ((inner_one && !of_one) || (inner_other && !of_other) || far_apart(of))
                  continue;
                if (const double distance = e.box.distance(f.box); distance > 0.)
                  of.until = travelled + distance - reserve * faces.size;
                else
                  check_edges({{e.ends[0], e.ends[1], f.ends[0], f.ends[1]}}, faces, of);
              }
    if (of_one && !far_apart(known[n]))
      check_node(middle(one), other, faces, known[n]);
    if (of_other && !far_apart(known[n + 1]))
      check_node(middle(other), one, faces, known[n + 1]);
  }
} // namespace Touchstone
