// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/surface_row.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The gap of a row at the start of the cycle, from its sides and normal. */
    double
    gap_at_start(const MovingSurface &surface, const SurfaceRow &row)
    {
      Tensor<1, dim> between;
      for (unsigned int i = 0; i < row.sides[0].n; ++i)
        between += row.sides[0].weights[i] * surface.at(row.sides[0].slots[i]).x;
      for (unsigned int i = 0; i < row.sides[1].n; ++i)
        between -= row.sides[1].weights[i] * surface.at(row.sides[1].slots[i]).x;
      return between * row.normal;
    }
  } // namespace



  void
  SurfaceRow::Side::add(const SurfacePoint &point, const double weight)
  {
    const std::size_t  first = point.middle ? point.slot - point.slot % 4 : point.slot;
    const unsigned int last  = point.middle ? 4 : 1;
    for (unsigned int a = 0; a < last; ++a)
      {
        unsigned int i = 0;
        while (i < n && slots[i] != first + a)
          ++i;
        if (i == n)
          slots[n++] = first + a;
        weights[i] += weight / last;
      }
  }



  SurfaceRow
  node_row(const MovingSurface         &surface,
           const SurfacePoint          &node,
           const unsigned int           face,
           const unsigned int           triangle,
           const std::array<double, 3> &weights,
           const Tensor<1, dim>        &normal)
  {
    SurfaceRow row;
    row.key = {SurfaceRow::on_faces, surface.key(node), {{surface.face_key(face), triangle}}};
    row.sides[0].add(node, 1.);
    for (unsigned int a = 0; a < 4; ++a) // always all corners, in the order of the face
      row.sides[1].add(surface.corner(face, a), 0.25 * weights[2]);
    row.sides[1].add(surface.corner(face, triangle), weights[0]);
    row.sides[1].add(surface.corner(face, triangle + 1), weights[1]);
    row.normal = normal;
    row.size   = std::min(surface.size(node), surface.size(surface.corner(face, triangle)));
    row.gap    = gap_at_start(surface, row);
    return row;
  }



  SurfaceRow
  edge_row(const MovingSurface           &surface,
           const MovingSurface::TwoEdges &ends,
           const std::array<double, 2>   &at_edges,
           const Tensor<1, dim>          &normal)
  {
    SurfaceRow row;
    row.key = {SurfaceRow::on_edges,
               surface.key(ends[0]),
               {{surface.key(ends[1]), surface.key(ends[2]), surface.key(ends[3])}}};
    for (unsigned int side = 0; side < 2; ++side)
      {
        // Sides with a middle always have all corners, in the order of the face.
        if (ends[2 * side + 1].middle)
          row.sides[side].add(ends[2 * side + 1], at_edges[side]);
        row.sides[side].add(ends[2 * side], 1. - at_edges[side]);
        if (!ends[2 * side + 1].middle)
          row.sides[side].add(ends[2 * side + 1], at_edges[side]);
      }
    row.normal = normal;
    row.size   = std::min(
      {surface.size(ends[0]), surface.size(ends[1]), surface.size(ends[2]), surface.size(ends[3])});
    row.gap = gap_at_start(surface, row);
    return row;
  }



  std::optional<SurfaceRow>
  nearest_edges(const MovingSurface &surface, const MovingSurface::TwoEdges &ends)
  {
    const Tensor<1, dim> a      = surface.mean(ends[0], &MovingSurface::NodeMotion::x),
                         e      = surface.mean(ends[1], &MovingSurface::NodeMotion::x) - a,
                         b      = surface.mean(ends[2], &MovingSurface::NodeMotion::x),
                         f      = surface.mean(ends[3], &MovingSurface::NodeMotion::x) - b;
    const Tensor<1, dim> across = cross_product_3d(e, f);
    const double         square = across.norm_square();
    if (!(square > 1e-12 * e.norm_square() * f.norm_square()))
      return {}; // parallel: nodes on faces serve them
    const double s = cross_product_3d(b - a, f) * across / square,
                 t = cross_product_3d(b - a, e) * across / square;
    if (std::min({s, t, 1. - s, 1. - t}) < -MovingSurface::tie)
      return {};
    const Tensor<1, dim> normal =
      (across * surface.outward(ends) < 0. ? -1. : 1.) / std::sqrt(square) * across;
    return edge_row(surface, ends, {{s, t}}, normal);
  }



  double
  inner_gap_at_end(const MovingSurface &surface, const SurfaceRow &row)
  {
    Tensor<1, dim> between;
    for (unsigned int side = 0; side < 2; ++side)
      for (unsigned int i = 0; i < row.sides[side].n; ++i)
        between += (side == 0 ? 1. : -1.) * row.sides[side].weights[i] *
                   Tensor<1, dim>(surface.inner_position({row.sides[side].slots[i], false}, true));
    return between * row.normal;
  }
} // namespace Touchstone
