// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/search/face_tree.h>

#include <algorithm>

// R-trees of the boxes around the master faces that this rank knows. They reduce the candidates of
// each search from all faces to a few; outlines (normal, sphere) exclude most of those before a
// projection.
namespace Touchstone
{
  using namespace dealii;
  namespace bg  = boost::geometry;
  namespace bgi = boost::geometry::index;

  namespace
  {
    double
    half_diagonal(const BoundingBox<dim> &box)
    {
      const auto &[low, high] = box.get_boundary_points();
      return 0.5 * low.distance(high);
    }
  } // namespace



  FaceTree::FaceTree(const FaceExchange &exchange)
    : exchange(exchange)
  {
    std::vector<std::pair<Box, std::size_t>> boxes, swept_boxes;
    for (const Face &face : exchange.faces())
      {
        boxes.emplace_back(exchange.box(face), boxes.size());
        // Boxes over the whole step are larger, so they have a tree of their own and do not slow
        // down the search for the closest face.
        if (exchange.swept())
          swept_boxes.emplace_back(exchange.swept_box(face), swept_boxes.size());
        // The normal of the surface without patches: it only tells on which side the face is.
        const FacePoint middle = evaluate(face, exchange.exact_surface(face), {{0., 0.}});
        const Box      &box    = boxes.back().first;
        outlines.push_back({middle.normal(), box.center(), half_diagonal(box)});
      }
    tree       = pack_rtree(boxes);
    swept_tree = pack_rtree(swept_boxes);
  }



  std::vector<std::pair<double, std::size_t>>
  FaceTree::nearest(const Point<dim> &x, const unsigned int n) const
  {
    std::vector<std::pair<double, std::size_t>> result;
    // Sorted by distance, and by index where distances are equal, so that runs repeat themselves.
    for (auto it = tree.qbegin(bgi::nearest(x, n)); it != tree.qend(); ++it)
      result.emplace_back(bg::comparable_distance(x, it->first), it->second);
    std::sort(result.begin(), result.end());
    return result;
  }



  std::vector<std::size_t>
  FaceTree::meeting(const Box &box) const
  {
    std::vector<std::size_t> result;
    for (auto it = tree.qbegin(bgi::intersects(box)); it != tree.qend(); ++it)
      result.push_back(it->second);
    return result;
  }



  std::vector<std::size_t>
  FaceTree::meeting_in_step(const Box &box) const
  {
    std::vector<std::size_t> result;
    for (auto it = swept_tree.qbegin(bgi::intersects(box)); it != swept_tree.qend(); ++it)
      result.push_back(it->second);
    return result;
  }



  std::vector<const Face *>
  FaceTree::facing(const Box &box, const Tensor<1, dim> &slave_normal, const double reach) const
  {
    // The reach in all directions: the gap may be as large as that.
    Box capture = box;
    capture.extend(reach);
    // Spheres around the box and around each face.
    const double              radius = half_diagonal(box);
    std::vector<const Face *> result;
    for (const std::size_t i : meeting(capture))
      {
        count_candidate();
        // Only those over the box or under it, seen along the normal, cover any of it.
        const Tensor<1, dim> offset = outlines[i].centre - box.center();
        const bool           beside =
          (offset - (offset * slave_normal) * slave_normal).norm() > outlines[i].radius + radius;
        if (outlines[i].normal * slave_normal < -Tolerances::perpendicular_cosine && !beside)
          result.push_back(&exchange.faces()[i]);
      }
    // In the order of their keys, so that sums do not depend on the partition.
    std::sort(result.begin(), result.end(), [](const Face *a, const Face *b) {
      return a->key < b->key;
    });
    return result;
  }
} // namespace Touchstone
