// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/edge_crossing.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <cmath>
#include <map>

// Contact of two sharp edges (doc/theory.md 4.2): collects the convex edges of a surface and tests
// pairs of them for their common perpendicular. EdgePairing makes rows of them, UnresolvedContact
// reports those that have passed through each other.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** An edge of a face with centre and normal of that face. `outer`: the surface ends there.
     * `own`: the face is one of those whose edges are wanted. `plane`: of symmetry, on which the
     * edge lies; zero if there is none. */
    struct Side
    {
      Point<dim>           a, b, centre;
      std::array<Index, 2> nodes;
      const Face          *face;
      std::uint64_t        key;
      Tensor<1, dim>       normal, plane;
      bool                 outer, own;
    };

    Tensor<1, dim>
    reflected(const Tensor<1, dim> &x, const Tensor<1, dim> &plane)
    {
      return x - 2. * (x * plane) * plane;
    }

    /** The sides of edges by their two corner nodes. */
    using SidesOfEdges = std::map<std::pair<Index, Index>, std::vector<Side>>;

    /** Unit vector in the tangent plane of the face, perpendicular to the edge, away from the face.
     */
    Tensor<1, dim>
    outward(const Side &side)
    {
      Tensor<1, dim> direction = cross_product_3d(side.b - side.a, side.normal);
      direction /= direction.norm();
      return direction * (side.a - side.centre) > 0. ? direction : -1. * direction;
    }

    /** Whether @p n, perpendicular to the edge, lies between the normals of its sides. */
    bool
    between_normals(const SharpEdge &edge, const Tensor<1, dim> &n, const double along)
    {
      const auto angle = [](const Tensor<1, dim> &x, const Tensor<1, dim> &y) {
        return std::acos(std::clamp(x * y, -1., 1.));
      };
      // Along one of the normals it is the face beside the edge that touches, which rows describe.
      // In between, both angles add up to the angle of the edge if the direction lies in the plane
      // of the normals; a direction outside that plane has a larger sum.
      const auto &m = edge.normals;
      return n * m[0] < along && n * m[1] < along &&
             angle(n, m[0]) + angle(n, m[1]) < angle(m[0], m[1]) + Tolerances::out_of_plane;
    }
    /** Add the edges of a face. Edges are identified by their two corner nodes, so each face around
     * an edge contributes one side. */
    void
    add_sides(const Face &face, const bool own, SidesOfEdges &sides)
    {
      const FacePoint middle  = evaluate(face, nullptr, {{0., 0.}});
      const auto      corners = corners_of_edges(face);
      for (unsigned int e = 0; e < 4; ++e)
        {
          const auto [i, j] = corners[e];
          sides[std::minmax(face.nodes[i], face.nodes[j])].push_back(
            {face.position(i),
             face.position(j),
             middle.x,
             {{face.nodes[i], face.nodes[j]}},
             &face,
             face.edge_key(e),
             middle.normal(),
             plane_of_symmetry(face, e),
             (face.outer_edges >> e & 1u) != 0,
             own});
        }
    }

    /** Whether two faces meet in a convex edge with an angle between their normals above that of
     * @p cosine. The centre of one lies below the other then; a concave edge cannot be touched from
     * outside. */
    bool
    sharp_now(const Side &one, const Side &two, const double cosine)
    {
      return (two.centre - one.a) * one.normal < 0. && one.normal * two.normal < cosine;
    }

    /** The same in the reference state, for faces of degree 1. */
    bool
    sharp_as_made(const Side &one, const Side &two, const double cosine)
    {
      if (one.face->degree > 1)
        return false;
      const unsigned int m = one.face->number_of(one.nodes[0]);
      Tensor<1, dim>     to_centre;
      for (unsigned int l = 0; l < two.face->n_nodes(); ++l)
        to_centre += 0.25 * (two.face->reference[l] - one.face->reference[m]);
      const Tensor<1, dim> first = reference_area_vector(*one.face, m);
      Tensor<1, dim> second = reference_area_vector(*two.face, two.face->number_of(one.nodes[0]));
      // Of an edge on a plane of symmetry the second face is the image of the first.
      if (one.face == two.face)
        {
          to_centre = reflected(to_centre, one.plane);
          second    = reflected(second, one.plane);
        }
      return to_centre * first < 0. && first * second < cosine * first.norm() * second.norm();
    }

    /** @param as_made Also edges that are flat now, but were not in the reference state. */
    std::vector<SharpEdge>
    sharp_edges_of(const SidesOfEdges &sides, const double cosine, const bool as_made)
    {
      std::vector<SharpEdge> result;
      for (const auto &[nodes, list] : sides)
        {
          const Side &one = list.front();
          // Each edge is reported by ranks that own a face there.
          if (std::none_of(list.begin(), list.end(), [](const Side &s) { return s.own; }))
            continue;
          const auto is_sharp = [&](const Side &two) {
            return sharp_now(one, two, cosine) || (as_made && sharp_as_made(one, two, cosine));
          };
          if (list.size() == 1 && one.plane.norm_square() > 0.)
            {
              Side image   = one;
              image.centre = one.a + reflected(one.centre - one.a, one.plane);
              image.normal = reflected(one.normal, one.plane);
              if (is_sharp(image))
                result.push_back({one.a,
                                  one.b,
                                  one.nodes,
                                  one.key,
                                  {{one.normal, image.normal}},
                                  {{one.face, nullptr}}});
            }
          // Where the surface ends the body may go on at any angle: the second normal lies in the
          // tangent plane of the face, which admits all directions up to a right angle.
          else if (list.size() == 1 && one.outer)
            result.push_back({one.a,
                              one.b,
                              one.nodes,
                              one.key,
                              {{one.normal, outward(one)}},
                              {{one.face, nullptr}}});
          else if (list.size() == 2 && is_sharp(list.back()))
            result.push_back({one.a,
                              one.b,
                              one.nodes,
                              std::min(one.key, list.back().key),
                              {{one.normal, list.back().normal}},
                              {{one.face, list.back().face}}});
        }
      return result;
    }
  } // namespace



  std::array<std::array<unsigned int, 2>, 4>
  corners_of_edges(const Face &face)
  {
    const unsigned int p = face.degree, last = face.n_nodes() - 1;
    return {{{{0, last - p}}, {{p, last}}, {{0, p}}, {{last - p, last}}}};
  }



  Tensor<1, dim>
  plane_of_symmetry(const Face &face, const unsigned int e)
  {
    if ((face.mirrored_edges >> e & 1u) == 0)
      return {};
    const auto [i, j]          = corners_of_edges(face)[e];
    const Tensor<1, dim> edge  = face.position(j) - face.position(i),
                         mean  = face.edge_normals[i] + face.edge_normals[j],
                         plane = cross_product_3d(edge, mean);
    const double length        = plane.norm();
    return length > Tolerances::parallel_sine * edge.norm() * mean.norm() ? plane / length
                                                                          : Tensor<1, dim>();
  }



  std::vector<SharpEdge>
  sharp_edges(const std::vector<Face> &own, const std::vector<Face> &others, const double cosine)
  {
    SidesOfEdges sides;
    for (const auto *list : {&own, &others})
      for (const Face &face : *list)
        add_sides(face, list == &own, sides);
    return sharp_edges_of(sides, cosine, /*as_made=*/false);
  }



  std::vector<SharpEdge>
  sharp_edges(const std::vector<const Face *> &faces, const double cosine)
  {
    SidesOfEdges sides;
    for (const Face *const face : faces)
      add_sides(*face, true, sides);
    return sharp_edges_of(sides, cosine, /*as_made=*/true);
  }



  std::optional<EdgeCrossing>
  edge_crossing(const SharpEdge &first,
                const SharpEdge &second,
                const double     slack,
                const double     along)
  {
    const Tensor<1, dim> d = first.b - first.a, e = second.b - second.a,
                         offset = second.a - first.a;
    Tensor<1, dim> n            = cross_product_3d(d, e);
    const double   square       = n.norm_square();
    // The sine of the angle between the edges: along parallel edges the common perpendicular is not
    // unique, and the position of the feet would be round-off.
    if (square <=
        Tolerances::parallel_sine * Tolerances::parallel_sine * d.norm_square() * e.norm_square())
      return {};
    // Feet of the common perpendicular of two lines.
    const double s = cross_product_3d(offset, e) * n / square,
                 t = cross_product_3d(offset, d) * n / square;
    // Where the end of an edge touches the other edge, round-off must not lose the crossing.
    if (std::min(s, t) < -slack || std::max(s, t) > 1. + slack)
      return {};
    n /= n.norm();
    // The perpendicular is oriented outward from the second edge. The direction from the first to
    // the second point is then positive along it where the edges have passed through each other.
    if (n * (second.normals[0] + second.normals[1]) < 0.)
      n *= -1.;
    const Point<dim> x = first.a + s * d, y = second.a + t * e;
    const double     depth = (y - x) * n;
    // The contact force is normal to both surfaces only if the perpendicular lies in the cone of
    // normals of either edge.
    if (!between_normals(second, n, along) || !between_normals(first, -1. * n, along))
      return {};
    return EdgeCrossing{x, y, s, t, n, depth};
  }
} // namespace Touchstone
