// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/search/far_side.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <limits>
#include <vector>

// Both sides of a thin body are near what touches one of them (doc/theory.md 4, "Far sides").
namespace Touchstone
{
  using namespace dealii;

  FacePoint
  foot_at_start(const Point<dim> &start, const Face &face, const AnalyticSurface *exact)
  {
    const Face         before = at_start_of_step(face);
    const FaceGeometry geometry(before, exact, MasterNormal::face);
    return geometry.evaluate(closest_point_projection(start, geometry).xi);
  }



  bool
  is_deep(const FaceTree &tree, const Face &face, const double depth)
  {
    return tree.exchange.swept() && depth > Tolerances::deep_edge * reference_diagonal(face);
  }



  bool
  on_far_side(const FaceTree             &tree,
              const Point<dim>           &start,
              const Tensor<1, dim>       &slave_normal,
              const Face                 &face,
              const double                depth,
              const std::optional<double> depth_at_start)
  {
    if (!is_deep(tree, face, depth))
      return false;
    const FacePoint foot = foot_at_start(start, face, tree.exchange.exact_surface(face));
    // What it has entered since the step began it has not been behind.
    if (depth_at_start.value_or((foot.x - start) * foot.normal()) < 0.5 * depth)
      return false;
    const double  radius = start.distance(foot.x);
    FaceTree::Box near({start, start});
    near.extend(radius);
    std::vector<FacePoint> feet;
    double                 closest = std::numeric_limits<double>::max();
    for (const std::size_t i : tree.meeting_in_step(near))
      {
        const Face &other = tree.exchange.faces()[i];
        feet.push_back(foot_at_start(start, other, tree.exchange.exact_surface(other)));
        closest = std::min(closest, start.distance(feet.back().x));
      }
    // Over an edge or a corner several faces are equally close, and their mean decides.
    Tensor<1, dim> from_foot, normal;
    for (const FacePoint &other : feet)
      if (start.distance(other.x) <= closest + Tolerances::touching * radius)
        {
          from_foot = start - other.x;
          normal += other.normal();
        }
    const double cosine = Tolerances::about_normal;
    return from_foot * normal > cosine * from_foot.norm() * normal.norm() &&
           std::max(-1. * (normal * foot.normal()), normal * slave_normal) > cosine * normal.norm();
  }
} // namespace Touchstone
