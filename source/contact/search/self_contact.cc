// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/search/far_side.h>
#include <touchstone/contact/search/self_contact.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

// What tells contact of a body with itself from what is close because it is one body
// (doc/theory.md 4.4).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A direction that decides who is the slave. It is 10 degrees or more away from right angles
     * to the axes and to the diagonals of planes and boxes, along which models are likely to fold.
     */
    Tensor<1, dim>
    odd_direction()
    {
      Tensor<1, dim> result({0.417, 0.173, 0.892});
      return result / result.norm();
    }

    /** Position and unit normal of a point of a face in the reference state. */
    std::pair<Point<dim>, Tensor<1, dim>>
    in_reference(const Face &face, const FaceShapes &shapes)
    {
      Point<dim>                    x;
      std::array<Tensor<1, dim>, 2> tangents;
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        {
          x += shapes.value[m] * face.reference[m];
          for (unsigned int a = 0; a < 2; ++a)
            tangents[a] += shapes.gradient[m][a] * face.reference[m];
        }
      const Tensor<1, dim> normal = cross_product_3d(tangents[0], tangents[1]);
      return {x, normal / normal.norm()};
    }

    /** Cosine between the line from a point within a body to the closest point of its surface and
     * the normal there (37 degrees): more than facets that meet without a sharp edge stray. */
    constexpr double normal_within = 0.8;

    /** Whether a point is in front of a face in the reference state. @param foot On the face. */
    bool
    in_front(const Point<dim> &x, const Point<dim> &foot, const Tensor<1, dim> &normal)
    {
      return (x - foot) * normal > Tolerances::behind_face * x.distance(foot);
    }

    /** Whether a node was as deep behind a face when the step began: what it has entered since it
     * has not been behind. @param depth At present; length. */
    bool
    was_behind(const SlavePoint      &point,
               const Face            &face,
               const AnalyticSurface *exact,
               const double           depth)
    {
      const FacePoint      foot = foot_at_start(point.start, face, exact);
      const Tensor<1, dim> gap  = point.start - foot.x;
      // Where the node was beside the face it has come from another one, over which it was.
      const double behind = -(gap * foot.normal());
      return behind > Tolerances::about_normal * gap.norm() && behind > 0.5 * depth &&
             behind > Tolerances::deep_edge * reference_diagonal(face);
    }
  } // namespace



  bool
  SelfContact::comes_first(const Point<dim> &one, const Point<dim> &other)
  {
    static const Tensor<1, dim> direction = odd_direction();
    return direction * (one - other) > 0.;
  }



  bool
  SelfContact::share_node(const Face &one, const Face &other)
  {
    const auto end = one.nodes.begin() + one.n_nodes();
    return std::find_first_of(one.nodes.begin(),
                              end,
                              other.nodes.begin(),
                              other.nodes.begin() + other.n_nodes()) != end;
  }



  bool
  SelfContact::is_master(const Surface &slave_surface, const Index node) const
  {
    const auto around = slave_surface.faces_around(node);
    return std::any_of(around.begin(), around.end(), [&](const auto &entry) {
      return master.count(entry.first->boundary) > 0;
    });
  }



  bool
  SelfContact::may_meet(const SlavePoint &point, const Face &face) const
  {
    const auto end = face.nodes.begin() + face.n_nodes();
    return std::find(face.nodes.begin(), end, point.node) == end;
  }



  bool
  SelfContact::is_slave(const SlavePoint            &point,
                        const Face                  &face,
                        const std::array<double, 2> &xi) const
  {
    // Where only one of the two can be the slave nothing is to be decided.
    if (!point.also_master || slave.count(face.boundary) == 0)
      return true;
    const auto [foot, normal] = in_reference(face, FaceShapes(face.degree, xi));
    if (point.reference.distance(foot) >= Tolerances::made_to_touch * reference_diagonal(face))
      return comes_first(point.reference, foot);
    // Where surfaces have been made to touch, the line between the two has no direction but that of
    // their slip. As where there is a gap, what lies in front of the other one comes first; and a
    // node at the end of such a surface does not meet those that end there as well.
    Tensor<1, dim> of_node;
    bool           facing = false;
    for (const Tensor<1, dim> &own : point.made_normals)
      {
        of_node += own;
        facing = facing || own * normal < -Tolerances::about_normal;
      }
    return facing && comes_first(Point<dim>(normal), Point<dim>(of_node / of_node.norm()));
  }



  bool
  SelfContact::can_have_entered(const SlavePoint &point,
                                const Face       &face,
                                const Projection &projection) const
  {
    // Twice, as the node may have entered through a neighbour that has moved farther.
    double moved = 0.;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      moved = std::max(moved,
                       (point.x - point.start - (face.displacement[m] - face.committed[m])).norm());
    return projection.distance_squared < 4. * moved * moved && is_slave(point, face, projection.xi);
  }



  bool
  SelfContact::through_body(const Point<dim>     &x,
                            const Point<dim>     &foot,
                            const Tensor<1, dim> &normal,
                            const double          depth)
  {
    const double distance = x.distance(foot);
    // On the same plane are the two sides of a crack, which are closer in the reference state, and
    // the outer side of a sheet that is folded, which is farther apart there.
    return !in_front(x, foot, normal) && depth > Tolerances::come_closer * distance &&
           depth < Tolerances::through_material * distance;
  }



  bool
  SelfContact::made_to_overlap(const Point<dim>     &x,
                               const Point<dim>     &foot,
                               const Tensor<1, dim> &normal,
                               const Face           &face,
                               const double          cosine)
  {
    return cosine < Tolerances::opposed && !in_front(x, foot, normal) &&
           x.distance(foot) < Tolerances::made_to_overlap * face.depth_of_cell;
  }



  bool
  SelfContact::meets(const SlavePoint   &point,
                     const FaceGeometry &geometry,
                     const Projection   &projection) const
  {
    const Face &face = geometry.face();
    if (!is_slave(point, face, projection.xi))
      return false;
    const FacePoint      foot     = geometry.evaluate(projection.xi);
    const Tensor<1, dim> gap      = point.x - foot.x;
    const double         distance = gap.norm();
    // Where both are at the same place there is no line between them.
    if (distance < Tolerances::touching * reference_diagonal(face))
      return true;
    const double   along_normal = foot.normal() * gap;
    Tensor<1, dim> edge;
    const bool     over_edge =
      projection.beyond_inner > Tolerances::in_wedge && geometry.sharp(projection.xi, edge);
    // The closest point of what is within a body is no edge that stands out.
    if (over_edge && edge * gap < 0. && distance > Tolerances::near_edge * reference_diagonal(face))
      return false;
    // Within a body the line to the closest point is normal to its face but for the angle between
    // facets.
    if (along_normal < 0. ? -along_normal < normal_within * distance
                          : along_normal < Tolerances::about_normal * distance && !over_edge)
      return false;

    const auto [at_foot, normal] = in_reference(face, FaceShapes(face.degree, projection.xi));
    return along_normal >= 0. || in_front(point.reference, at_foot, normal) ||
           made_to_overlap(point.reference, at_foot, normal, face, point.normal * foot.normal()) ||
           !(through_body(point.reference, at_foot, normal, distance) ||
             was_behind(point, face, geometry.exact_surface(), distance));
  }
} // namespace Touchstone
