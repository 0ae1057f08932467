// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/first_crossing.h>
#include <touchstone/explicit/general/general_contact.h>
#include <touchstone/explicit/general/moving_points.h>

#include <cmath>
#include <limits>

// The check of the straight motion of a cycle for crossings, and the rows that prevent them
// (doc/general_contact.md, section 3). Each face is four triangles around its middle.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Edges are parallel if the sine of their angle is below this: they have no normal of their
     * own. */
    constexpr double parallel = 1e-6;

    /** Sides that come together are on the outside of each other; only what points inwards by more
     * than this leaves a body that it is in. */
    constexpr double inwards = 0.1;

    /** The ends of an edge that is a little longer, so that edges that meet at their ends do so
     * whatever round-off is. */
    std::array<Point<dim>, 2>
    lengthened(const Point<dim> &begin, const Point<dim> &end)
    {
      const Tensor<1, dim> more = GeneralContact::tie * (end - begin);
      return {{begin - more, end + more}};
    }

    Point<dim>
    between(const Point<dim> &from, const Point<dim> &to, const double part)
    {
      return from + part * (to - from);
    }
  } // namespace



  Point<dim>
  GeneralContact::inner_position(const SurfacePoint &point, const bool at_end) const
  {
    return point.middle ? (at_end ? middle_to : middle_from)[point.slot / 4]
                        : (at_end ? inner_to : inner_from)[candidates.at_slots.node(point.slot)];
  }



  void
  GeneralContact::set_inner_positions(const double part)
  {
    inner_from.resize(motion.size());
    inner_to.resize(motion.size());
    for (std::size_t node = 0; node < motion.size(); ++node)
      {
        const NodeMotion &of = motion[node];
        inner_from[node]     = Point<dim>(of.x - part * of.size * of.normal_before);
        inner_to[node]       = Point<dim>(of.x + cycle * of.v - part * of.size * of.normal);
      }
    const std::size_t n_faces = candidates.faces.size();
    middle_from.resize(n_faces);
    middle_to.resize(n_faces);
    face_boxes.resize(n_faces);
    edge_boxes.resize(4 * n_faces);
    inner_boxes.resize(4 * n_faces);
    warped.resize(n_faces);
    for (unsigned int f = 0; f < n_faces; ++f)
      {
        set_boxes(f);
        warped[f] = is_warped(f);
      }
  }



  // Of a face and its edges, a little longer, and of the edges from corners to the middle.
  void
  GeneralContact::set_boxes(const unsigned int face)
  {
    std::array<std::array<Point<dim>, 4>, 2> x;
    std::array<Point<dim>, 2>                middles;
    for (unsigned int at_end = 0; at_end < 2; ++at_end)
      for (unsigned int a = 0; a < 4; ++a)
        {
          x[at_end][a] = inner_position(corner(face, a), at_end);
          middles[at_end] += 0.25 * x[at_end][a];
        }
    middle_from[face] = middles[0];
    middle_to[face]   = middles[1];
    for (unsigned int a = 0; a < 4; ++a)
      {
        std::array<std::array<Point<dim>, 2>, 2> edge, inner;
        for (unsigned int at_end = 0; at_end < 2; ++at_end)
          {
            edge[at_end]  = lengthened(x[at_end][a], x[at_end][(a + 1) % 4]);
            inner[at_end] = lengthened(x[at_end][a], middles[at_end]);
          }
        edge_boxes[4 * std::size_t(face) + a]  = MotionBox(edge[0], edge[1]);
        inner_boxes[4 * std::size_t(face) + a] = MotionBox(inner[0], inner[1]);
      }
    for (auto &corners : x)
      for (unsigned int a = 0; a < 2; ++a)
        {
          const auto ends = lengthened(corners[a], corners[a + 2]);
          corners[a]      = ends[0];
          corners[a + 2]  = ends[1];
        }
    face_boxes[face] = MotionBox(x[0], x[1]);
  }



  void
  GeneralContact::check_node(const SurfacePoint &node, const unsigned int face, const Kind kind)
  {
    const Point<dim> from = inner_position(node, false), to = inner_position(node, true);
    if (!MotionBox(std::array<Point<dim>, 1>{{from}}, std::array<Point<dim>, 1>{{to}})
           .meets(face_boxes[face]))
      return;
    // What slides on a face is never far from it: its normal tells them apart.
    std::array<Point<dim>, 6> all_from, all_to;
    for (unsigned int i = 0; i < 6; ++i)
      {
        const SurfacePoint point = i == 0 ? node : i == 5 ? middle(face) : corner(face, i - 1);
        all_from[i]              = inner_position(point, false);
        all_to[i]                = inner_position(point, true);
      }
    for (const auto *const x : {&all_from, &all_to})
      if (stay_apart(all_from, all_to, 1, cross_product_3d((*x)[3] - (*x)[1], (*x)[4] - (*x)[2])))
        return;
    // Where several triangles are crossed at once, as on the line between them, each has its row:
    // otherwise round-off would choose.
    std::array<std::optional<Crossing>, 4> crossed;
    double                                 first = std::numeric_limits<double>::max();
    for (unsigned int t = 0; t < 4; ++t)
      {
        crossed[t] = first_crossing_node_triangle(node_and_triangle(node, face, t, false),
                                                  node_and_triangle(node, face, t, true));
        if (crossed[t])
          first = std::min(first, crossed[t]->time);
      }
    for (unsigned int t = 0; t < 4; ++t)
      if (crossed[t] && crossed[t]->time <= first + tie)
        keep_out(node, face, t, *crossed[t], kind);
  }



  // A node and a triangle of a face, enlarged a little.
  FourPoints
  GeneralContact::node_and_triangle(const SurfacePoint &node,
                                    const unsigned int  face,
                                    const unsigned int  triangle,
                                    const bool          at_end) const
  {
    FourPoints       x{{inner_position(node, at_end),
                        inner_position(corner(face, triangle), at_end),
                        inner_position(corner(face, triangle + 1), at_end),
                        inner_position(middle(face), at_end)}};
    const Point<dim> centre(1. / 3. * (x[1] + Tensor<1, dim>(x[2]) + x[3]));
    for (unsigned int i = 1; i < 4; ++i)
      x[i] += tie * (x[i] - centre);
    return x;
  }



  void
  GeneralContact::keep_out(const SurfacePoint &node,
                           const unsigned int  face,
                           const unsigned int  triangle,
                           const Crossing     &crossing,
                           const Kind          kind)
  {
    const FourPoints a = node_and_triangle(node, face, triangle, false),
                     b = node_and_triangle(node, face, triangle, true);
    FourPoints     x;
    Tensor<1, dim> closing = b[0] - a[0];
    for (unsigned int i = 0; i < 4; ++i)
      {
        x[i] = between(a[i], b[i], crossing.time);
        if (i > 0)
          closing -= crossing.weights[i - 1] * (b[i] - a[i]);
      }
    Tensor<1, dim> normal = cross_product_3d(x[2] - x[1], x[3] - x[1]);
    if (normal.norm() == 0.)
      normal = mean(middle(face), &NodeMotion::normal);
    if (!(normal.norm() > 0.) || !(closing * normal < 0.))
      return; // it leaves the material
    // Of the triangle as it is.
    std::array<double, 3> weights = crossing.weights;
    for (double &weight : weights)
      weight += tie * (weight - 1. / 3.);
    found.emplace_back(kind, node_row(node, face, triangle, weights, normal / normal.norm()));
  }



  void
  GeneralContact::check_edges(const Points &ends, const Kind kind)
  {
    FourPoints a, b;
    for (unsigned int side = 0; side < 4; side += 2)
      for (FourPoints *const x : {&a, &b})
        {
          const auto edge = lengthened(inner_position(ends[side], x == &b),
                                       inner_position(ends[side + 1], x == &b));
          (*x)[side]      = edge[0];
          (*x)[side + 1]  = edge[1];
        }
    // Edges that rest on each other are never far apart: directions that tell them apart.
    const Tensor<1, dim> e = a[1] - a[0], f = a[3] - a[2], apart = a[2] - a[0];
    for (const Tensor<1, dim> &direction : {outward(ends),
                                            cross_product_3d(e, f),
                                            cross_product_3d(b[1] - b[0], b[3] - b[2]),
                                            cross_product_3d(cross_product_3d(e, apart), e),
                                            cross_product_3d(cross_product_3d(f, apart), f)})
      if (stay_apart(a, b, 2, direction))
        return;
    const auto crossing = first_crossing_edge_edge(a, b);
    if (!crossing)
      return;
    std::array<double, 2> at_edges{{crossing->weights[0], crossing->weights[1]}};
    const Tensor<1, dim>  closing =
      between(b[0], b[1], at_edges[0]) - between(a[0], a[1], at_edges[0]) -
      (between(b[2], b[3], at_edges[1]) - between(a[2], a[3], at_edges[1]));
    std::array<Point<dim>, 4> x;
    for (unsigned int i = 0; i < 4; ++i)
      x[i] = between(a[i], b[i], crossing->time);
    const Tensor<1, dim> normal = edge_normal(ends, x[1] - x[0], x[3] - x[2], closing);
    if (!(closing * normal < 0.))
      return;
    for (double &at_edge : at_edges)
      at_edge += tie * (2. * at_edge - 1.);
    found.emplace_back(kind, edge_row(ends, at_edges, normal));
  }



  // Towards the side that the slave comes from; zero where that is within the master.
  Tensor<1, dim>
  GeneralContact::edge_normal(const Points         &ends,
                              const Tensor<1, dim> &e,
                              const Tensor<1, dim> &f,
                              const Tensor<1, dim> &closing) const
  {
    const Tensor<1, dim> out    = outward(ends);
    Tensor<1, dim>       normal = cross_product_3d(e, f);
    if (normal.norm() > parallel * e.norm() * f.norm())
      normal *= (normal * closing > 0. ? -1. : 1.) / normal.norm();
    else
      {
        // Edges side by side: where the materials are.
        const Tensor<1, dim> along = e.norm() > f.norm() ? e : f;
        if (along.norm() == 0.)
          return Tensor<1, dim>();
        normal = out - (out * along) / along.norm_square() * along;
        if (normal.norm() == 0.)
          return Tensor<1, dim>();
        normal /= normal.norm();
      }
    return normal * out < -inwards * out.norm() ? Tensor<1, dim>() : normal;
  }
} // namespace Touchstone
