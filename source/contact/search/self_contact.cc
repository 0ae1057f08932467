// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/search/self_contact.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <array>
#include <cmath>

// What tells contact of a body with itself from what is close because it is one body
// (doc/theory.md 4.3).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Three directions at right angles to each other, none of which is at a right angle to an axis
     * or a plane of symmetry that a model may well have. */
    std::array<Tensor<1, dim>, dim>
    odd_directions()
    {
      std::array<Tensor<1, dim>, dim> result;
      result[0] = Tensor<1, dim>({0.3137, 0.1931, 0.9293});
      result[1] = Tensor<1, dim>({0.2417, 0.9271, -0.1129});
      result[0] /= result[0].norm();
      result[1] -= (result[1] * result[0]) * result[0];
      result[1] /= result[1].norm();
      result[2] = cross_product_3d(result[0], result[1]);
      return result;
    }

    /** A direction decides if it is this close (cosine) to the line between two points. One of the
     * three always is: the largest cosine is 0.577 at least. */
    constexpr double along = 0.4;

    /** Corners of a face in the reference state, in lexicographic order. */
    std::array<Point<dim>, 4>
    reference_corners(const Face &face)
    {
      const unsigned int n = face.degree + 1;
      return {{face.reference[0],
               face.reference[n - 1],
               face.reference[n * (n - 1)],
               face.reference[n * n - 1]}};
    }

    double
    reference_diagonal(const Face &face)
    {
      const auto corners = reference_corners(face);
      return corners[0].distance(corners[3]);
    }

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
      Face before         = face;
      before.displacement = face.committed;
      const FaceGeometry   geometry(before, exact, MasterNormal::face);
      const Projection     projection = closest_point_projection(point.start, geometry);
      const Tensor<1, dim> gap        = point.start - geometry.evaluate(projection.xi).x;
      // Where the node was beside the face it has come from another one, over which it was.
      const double behind = -(gap * geometry.normal(projection.xi));
      return behind > Tolerances::about_normal * gap.norm() && behind > 0.5 * depth &&
             behind > Tolerances::deep_edge * reference_diagonal(face);
    }
  } // namespace



  bool
  SelfContact::comes_first(const Point<dim> &one, const Point<dim> &other)
  {
    static const Tensor<1, dim> direction = odd_directions()[0];
    return direction * (one - other) > 0.;
  }



  bool
  SelfContact::is_slave(const Point<dim> &node, const Point<dim> &face)
  {
    static const auto    directions = odd_directions();
    const Tensor<1, dim> between    = node - face;
    const double         least      = along * between.norm();
    for (const Tensor<1, dim> &direction : directions)
      if (const double part = direction * between; std::abs(part) >= least)
        return part > 0.;
    return false;
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
    if (std::find(face.nodes.begin(), end, point.node) != end)
      return false;
    // Where only one of the two can be the slave nothing is to be decided.
    if (!point.also_master || slave.count(face.boundary) == 0)
      return true;
    const auto corners = reference_corners(face);
    Point<dim> centre;
    for (const Point<dim> &corner : corners)
      centre += 0.25 * corner;
    return is_slave(point.reference, centre);
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
  SelfContact::meets(const SlavePoint   &point,
                     const FaceGeometry &geometry,
                     const Projection   &projection) const
  {
    const Face          &face = geometry.face();
    const FaceShapes     shapes(face.degree, projection.xi);
    const FacePoint      foot     = geometry.evaluate(projection.xi);
    const Tensor<1, dim> gap      = point.x - foot.x;
    const double         distance = gap.norm();
    // Where both are at the same place there is no line between them.
    if (distance < Tolerances::touching * reference_diagonal(face))
      return true;
    const double   along_normal = geometry.normal(shapes, foot) * gap;
    Tensor<1, dim> edge;
    if (std::abs(along_normal) < Tolerances::about_normal * distance &&
        !(projection.beyond_inner > Tolerances::in_wedge && geometry.sharp(projection.xi, edge) &&
          edge * gap > 0.))
      return false;

    Point<dim>                    at_foot;
    std::array<Tensor<1, dim>, 2> tangents;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        at_foot += shapes.value[m] * face.reference[m];
        for (unsigned int a = 0; a < 2; ++a)
          tangents[a] += shapes.gradient[m][a] * face.reference[m];
      }
    Tensor<1, dim> normal = cross_product_3d(tangents[0], tangents[1]);
    normal /= normal.norm();
    return along_normal >= 0. || in_front(point.reference, at_foot, normal) ||
           !(through_body(point.reference, at_foot, normal, distance) ||
             was_behind(point, face, geometry.exact_surface(), distance));
  }
} // namespace Touchstone
