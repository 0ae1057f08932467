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



  namespace
  {
    /** The faces, whatever their normals, that were closest to a point when the step began. Over an
     * edge or a corner several are equally close, and their mean decides. */
    struct ClosestAtStart
    {
      Tensor<1, dim> from_foot, normal;
      /** In front of the planes of these faces, length. */
      double lowest = 0., highest = 0.;

      ClosestAtStart(const FaceTree &tree, const Point<dim> &start, const double radius)
      {
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
        unsigned int n = 0;
        for (const FacePoint &other : feet)
          if (start.distance(other.x) <= closest + Tolerances::touching * radius)
            {
              const double height = (start - other.x) * other.normal();
              lowest              = n == 0 ? height : std::min(lowest, height);
              highest             = n == 0 ? height : std::max(highest, height);
              from_foot += start - other.x;
              normal += other.normal();
              ++n;
            }
        if (n > 0)
          from_foot /= n;
        if (normal.norm() > 0.)
          normal /= normal.norm();
      }
    };
  } // namespace



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
    const double         radius = start.distance(foot.x);
    const ClosestAtStart closest(tree, start, radius);
    const double         cosine = Tolerances::about_normal, distance = closest.from_foot.norm(),
                 height  = closest.from_foot * closest.normal,
                 of_face = closest.normal * foot.normal(), of_slave = closest.normal * slave_normal;
    if (height > cosine * distance && std::max(-of_face, of_slave) > cosine)
      return true;
    // A facet may be behind while its arc is in front.
    if (of_face >= cosine)
      return false;
    // What was far outside of the body, beside an edge, where normals have any direction: in front
    // of some of the faces that meet in it and behind none. A point may lie in the plane of the
    // only one that the master has there.
    if (distance > Tolerances::strip * radius)
      return closest.lowest > -Tolerances::perpendicular_cosine * distance &&
             (!depth_at_start || closest.highest > Tolerances::perpendicular_cosine * distance);
    if (!depth_at_start)
      return false;
    // The end of a shaft within a bore: where the end of that has straight edges in place of arcs
    // the former covers a strip of it, and lies beside the bore or in line with its other end.
    return of_slave > -cosine &&
           (closest.from_foot - height * closest.normal).norm() <= Tolerances::touching * radius;
  }



  bool
  was_outside(const FaceTree &tree, const Point<dim> &start, const Face &face)
  {
    const FacePoint foot   = foot_at_start(start, face, tree.exchange.exact_surface(face));
    const double    radius = start.distance(foot.x);
    if (!is_deep(tree, face, radius))
      return false;
    const ClosestAtStart closest(tree, start, radius);
    const double         distance = closest.from_foot.norm();
    return distance > Tolerances::strip * radius &&
           (closest.from_foot * closest.normal > Tolerances::about_normal * distance ||
            closest.lowest > -Tolerances::perpendicular_cosine * distance);
  }
} // namespace Touchstone
