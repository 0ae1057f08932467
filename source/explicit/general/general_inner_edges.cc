// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/general_contact.h>
#include <touchstone/explicit/general/moving_points.h>

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
  GeneralContact::check_inner_edges(const unsigned int one, const unsigned int other)
  {
    if (!face_boxes[one].meets(face_boxes[other]))
      return;
    const bool of_one = warped[one], of_other = warped[other];
    if (!of_one && !of_other)
      return;
    const auto edge = [&](const unsigned int face, const unsigned int a, const bool inner) {
      const SurfacePoint begin = corner(face, a);
      return inner ? std::array<SurfacePoint, 2>{{begin, middle(face)}} : ends_of(begin.slot);
    };
    for (const bool inner_one : {false, true})
      for (const bool inner_other : {false, true})
        if ((inner_one || inner_other) && (!inner_one || of_one) && (!inner_other || of_other))
          for (unsigned int a = 0; a < 4; ++a)
            for (unsigned int b = 0; b < 4; ++b)
              {
                const std::size_t p = 4 * std::size_t(one) + a, q = 4 * std::size_t(other) + b;
                if (!(inner_one ? inner_boxes : edge_boxes)[p].meets(
                      (inner_other ? inner_boxes : edge_boxes)[q]))
                  continue;
                const auto e = edge(one, a, inner_one), f = edge(other, b, inner_other);
                check_edges({{e[0], e[1], f[0], f[1]}}, Kind::inner);
              }
    if (of_one)
      check_node(middle(one), other, Kind::inner);
    if (of_other)
      check_node(middle(other), one, Kind::inner);
  }
} // namespace Touchstone
