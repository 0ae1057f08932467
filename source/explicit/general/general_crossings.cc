// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/first_crossing.h>
#include <touchstone/explicit/general/general_contact.h>

#include <algorithm>
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

    void
    extend(std::array<double, 2 * dim> &box, const Point<dim> &point)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          box[d]       = std::min(box[d], point[d]);
          box[dim + d] = std::max(box[dim + d], point[d]);
        }
    }

    bool
    meet(const std::array<double, 2 * dim> &a, const std::array<double, 2 * dim> &b)
    {
      bool apart = false;
      for (unsigned int d = 0; d < dim; ++d)
        apart |= a[dim + d] < b[d] || b[dim + d] < a[d];
      return !apart;
    }

    template <std::size_t n>
    std::array<double, 2 * dim>
    box_of(const std::array<Point<dim>, n> &from, const std::array<Point<dim>, n> &to)
    {
      std::array<double, 2 * dim> box;
      for (unsigned int d = 0; d < dim; ++d)
        box[d] = box[dim + d] = from[0][d];
      for (std::size_t i = 0; i < n; ++i)
        {
          extend(box, from[i]);
          extend(box, to[i]);
        }
      return box;
    }

    /** Whether all of the first @p n points are on one side of all others along a direction, at the
     * start and at the end of straight paths, and so throughout. By more than round-off. */
    template <std::size_t n_points>
    bool
    separated(const std::array<Point<dim>, n_points> &from,
              const std::array<Point<dim>, n_points> &to,
              const std::size_t                       n,
              const Tensor<1, dim>                   &direction)
    {
      constexpr double round_off = 1e-13;
      double           below = std::numeric_limits<double>::max(), above = below, size = 0.;
      for (const auto *const x : {&from, &to})
        {
          // Least and largest of both groups.
          std::array<double, 2> low, high;
          low.fill(std::numeric_limits<double>::max());
          high.fill(-std::numeric_limits<double>::max());
          for (std::size_t i = 0; i < n_points; ++i)
            {
              const double along = (*x)[i] * direction;
              low[i >= n]        = std::min(low[i >= n], along);
              high[i >= n]       = std::max(high[i >= n], along);
              for (unsigned int d = 0; d < dim; ++d)
                size = std::max(size, std::abs((*x)[i][d]));
            }
          below = std::min(below, low[1] - high[0]);
          above = std::min(above, low[0] - high[1]);
        }
      return std::max(below, above) > round_off * size * direction.norm();
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
    const std::vector<Point<dim>> &x  = at_end ? inner_to : inner_from;
    const RowNodes                &on = candidates.at_slots;
    if (!point.middle)
      return x[on.node(point.slot)];
    const std::size_t first = point.slot - point.slot % 4;
    Point<dim>        sum;
    for (unsigned int a = 0; a < 4; ++a)
      sum += 0.25 * x[on.node(first + a)];
    return sum;
  }



  void
  GeneralContact::set_inner_positions()
  {
    inner_from.resize(motion.size());
    inner_to.resize(motion.size());
    for (std::size_t node = 0; node < motion.size(); ++node)
      {
        const NodeMotion &of = motion[node];
        inner_from[node]     = Point<dim>(of.x - inset * of.size * of.normal);
        inner_to[node]       = inner_from[node] + cycle * of.v;
      }
    face_boxes.resize(candidates.faces.size());
    for (unsigned int f = 0; f < face_boxes.size(); ++f)
      {
        std::array<Point<dim>, 4> from, to;
        for (unsigned int a = 0; a < 4; ++a)
          {
            from[a] = inner_position(corner(f, a), false);
            to[a]   = inner_position(corner(f, a), true);
          }
        face_boxes[f] = box_of(from, to);
      }
  }



  bool
  GeneralContact::check_node(const SurfacePoint &node, const unsigned int face)
  {
    const Point<dim> from = inner_position(node, false), to = inner_position(node, true);
    if (!meet(box_of<1>({{from}}, {{to}}), face_boxes[face]))
      return false;
    // What slides on a face is never far from it: its normal tells them apart.
    std::array<Point<dim>, 6> all_from, all_to;
    for (unsigned int i = 0; i < 6; ++i)
      {
        const SurfacePoint point = i == 0 ? node : i == 5 ? middle(face) : corner(face, i - 1);
        all_from[i]              = inner_position(point, false);
        all_to[i]                = inner_position(point, true);
      }
    for (const auto *const x : {&all_from, &all_to})
      if (separated(all_from, all_to, 1, cross_product_3d((*x)[3] - (*x)[1], (*x)[4] - (*x)[2])))
        return false;
    std::optional<Crossing> first;
    unsigned int            triangle = 0;
    const auto              ends     = [&](const unsigned int t, const bool at_end) {
      return std::array<Point<dim>, 4>{{at_end ? to : from,
                                        inner_position(corner(face, t), at_end),
                                        inner_position(corner(face, t + 1), at_end),
                                        inner_position(middle(face), at_end)}};
    };
    for (unsigned int t = 0; t < 4; ++t)
      {
        const auto found = first_crossing_node_triangle(ends(t, false), ends(t, true));
        if (found && (!first || found->time < first->time))
          {
            first    = found;
            triangle = t;
          }
      }
    if (!first)
      return false;
    const auto                a = ends(triangle, false), b = ends(triangle, true);
    std::array<Point<dim>, 4> x;
    Tensor<1, dim>            closing = b[0] - a[0];
    for (unsigned int i = 0; i < 4; ++i)
      {
        x[i] = between(a[i], b[i], first->time);
        if (i > 0)
          closing -= first->weights[i - 1] * (b[i] - a[i]);
      }
    Tensor<1, dim> normal = cross_product_3d(x[2] - x[1], x[3] - x[1]);
    if (normal.norm() == 0.)
      normal = mean(middle(face), &NodeMotion::normal);
    if (!(normal.norm() > 0.) || !(closing * normal < 0.))
      return false; // it leaves the material
    set_node_row(node, face, triangle, first->weights, normal / normal.norm());
    return true;
  }



  bool
  GeneralContact::check_edges(const Points &ends)
  {
    std::array<Point<dim>, 4> a, b;
    for (unsigned int i = 0; i < 4; ++i)
      {
        a[i] = inner_position(ends[i], false);
        b[i] = inner_position(ends[i], true);
      }
    if (!meet(box_of<2>({{a[0], a[1]}}, {{b[0], b[1]}}), box_of<2>({{a[2], a[3]}}, {{b[2], b[3]}})))
      return false;
    // Edges that rest on each other are never far apart: directions that tell them apart.
    const Tensor<1, dim> e = a[1] - a[0], f = a[3] - a[2], apart = a[2] - a[0];
    for (const Tensor<1, dim> &direction : {outward(ends),
                                            cross_product_3d(e, f),
                                            cross_product_3d(b[1] - b[0], b[3] - b[2]),
                                            cross_product_3d(cross_product_3d(e, apart), e),
                                            cross_product_3d(cross_product_3d(f, apart), f)})
      if (separated(a, b, 2, direction))
        return false;
    const auto found = first_crossing_edge_edge(a, b);
    if (!found)
      return false;
    const std::array<double, 2> at_edges{{found->weights[0], found->weights[1]}};
    const Tensor<1, dim>        closing =
      between(b[0], b[1], at_edges[0]) - between(a[0], a[1], at_edges[0]) -
      (between(b[2], b[3], at_edges[1]) - between(a[2], a[3], at_edges[1]));
    std::array<Point<dim>, 4> x;
    for (unsigned int i = 0; i < 4; ++i)
      x[i] = between(a[i], b[i], found->time);
    const Tensor<1, dim> normal = edge_normal(ends, x[1] - x[0], x[3] - x[2], closing);
    if (!(closing * normal < 0.))
      return false;
    set_edge_row(ends, at_edges, normal);
    return true;
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
  bool
  GeneralContact::check_inner_edges(const unsigned int one, const unsigned int other)
  {
    if (!meet(face_boxes[one], face_boxes[other]))
      return false;
    const bool warped[2] = {is_warped(one), is_warped(other)};
    if (!warped[0] && !warped[1])
      return false;
    bool       more = false;
    const auto edge = [&](const unsigned int face, const unsigned int a, const bool inner) {
      const SurfacePoint begin = corner(face, a);
      return inner ? std::array<SurfacePoint, 2>{{begin, middle(face)}} : ends_of(begin.slot);
    };
    for (const bool inner_one : {false, true})
      for (const bool inner_other : {false, true})
        if ((inner_one || inner_other) && (!inner_one || warped[0]) && (!inner_other || warped[1]))
          for (unsigned int a = 0; a < 4; ++a)
            for (unsigned int b = 0; b < 4; ++b)
              {
                const auto e = edge(one, a, inner_one), f = edge(other, b, inner_other);
                more |= check_edges({{e[0], e[1], f[0], f[1]}});
              }
    if (warped[0])
      more |= check_node(middle(one), other);
    if (warped[1])
      more |= check_node(middle(other), one);
    return more;
  }
} // namespace Touchstone
