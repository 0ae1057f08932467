// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/search/face_tree.h>
#include <touchstone/contact/search/far_side.h>

#include <algorithm>
#include <array>
#include <boost/iterator/function_output_iterator.hpp>
#include <tuple>

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
    std::vector<std::pair<Box, std::size_t>> boxes;
    boxes.reserve(exchange.faces().size());
    outlines.reserve(exchange.faces().size());
    for (const Face &face : exchange.faces())
      {
        boxes.emplace_back(exchange.box(face), boxes.size());
        outlines.push_back(outline(face, boxes.back().first));
        largest = std::max(largest, 2. * outlines.back().radius);
      }
    tree = pack_rtree(boxes);
  }



  FaceTree::Outline
  FaceTree::outline(const Face &face, const Box &box) const
  {
    Outline result;
    result.centre = box.center();
    result.radius = half_diagonal(box);
    if (!exchange.is_plane(face))
      {
        // The normal of the surface without patches: it only tells on which side the face is.
        result.normal = evaluate(face, exchange.exact_surface(face), {{0., 0.}}).normal();
        std::tie(result.lower, result.upper) = box.get_boundary_points();
        return result;
      }
    const std::array<Point<dim>, 4> x = {
      {face.position(0), face.position(1), face.position(2), face.position(3)}};
    result.normal = cross_product_3d((x[1] - x[0]) + (x[3] - x[2]), (x[2] - x[0]) + (x[3] - x[1]));
    result.normal /= result.normal.norm();
    for (unsigned int d = 0; d < dim; ++d)
      std::tie(result.lower[d], result.upper[d]) =
        std::minmax({x[0][d], x[1][d], x[2][d], x[3][d]});
    return result;
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



  void
  FaceTree::within(const Point<dim>                            &x,
                   const double                                 radius,
                   std::vector<std::pair<double, std::size_t>> &result) const
  {
    result.clear();
    Box around({x, x});
    around.extend(radius);
    tree.query(bgi::intersects(around),
               boost::make_function_output_iterator([&](const std::pair<Box, std::size_t> &entry) {
                 result.emplace_back(bg::comparable_distance(x, entry.first), entry.second);
               }));
    std::sort(result.begin(), result.end());
  }



  bool
  FaceTree::meets(const SlavePoint &point, const FaceProjection &candidate) const
  {
    const FaceGeometry geometry = exchange.geometry(*candidate.face);
    if (point.self != nullptr)
      return point.self->meets(point, geometry, candidate.projection);
    const FacePoint foot = geometry.evaluate(candidate.projection.xi);
    return !on_far_side(
      *this, point.start, point.normal, *candidate.face, (foot.x - point.x) * foot.normal());
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
    if (!exchange.swept())
      return {};
    // Faces that have moved by little are found with a larger box where they are now.
    if (const double moved = exchange.largest_motion(); moved < 0.1 * largest)
      {
        Box wider = box;
        wider.extend(moved);
        return meeting(wider);
      }
    if (!swept_tree)
      {
        std::vector<std::pair<Box, std::size_t>> boxes;
        for (const Face &face : exchange.faces())
          boxes.emplace_back(exchange.swept_box(face), boxes.size());
        swept_tree = pack_rtree(boxes);
      }
    std::vector<std::size_t> result;
    for (auto it = swept_tree->qbegin(bgi::intersects(box)); it != swept_tree->qend(); ++it)
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
