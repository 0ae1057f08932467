// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/general_contact.h>

#include <algorithm>

// Rows of what touches at the start of a cycle (doc/general_contact.md, section 3). They spare the
// check of crossings a round, and hold what rests; what they leave out the check finds.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Relative to the size of the faces: by so much surfaces are moved inwards for the check of
     * crossings, a gap that is closed, and an overlap that is still one of this pair. */
    constexpr double touching = 4. * GeneralContact::inset, overlapping = 0.01;

    /** Relative, of sizes that are the same. */
    constexpr double round_off = 1e-9;
  } // namespace



  Tensor<1, dim>
  GeneralContact::mean(const SurfacePoint &point, Tensor<1, dim> NodeMotion::*const quantity) const
  {
    if (!point.middle)
      return at(point.slot).*quantity;
    Tensor<1, dim>    sum;
    const std::size_t first = point.slot - point.slot % 4;
    for (unsigned int a = 0; a < 4; ++a)
      sum += 0.25 * (at(first + a).*quantity);
    return sum;
  }



  std::uint64_t
  GeneralContact::key(const SurfacePoint &point) const
  {
    // Keys of faces have room for a bit that those of nodes do not have.
    constexpr std::uint64_t of_middles = std::uint64_t(1) << 63;
    return point.middle ? candidates.faces[point.slot / 4].key | of_middles
                        : candidates.key(point.slot);
  }



  void
  GeneralContact::Side::add(const SurfacePoint &point, const double weight)
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



  double
  GeneralContact::gap_at_start(const Row &row) const
  {
    Tensor<1, dim> between;
    for (unsigned int i = 0; i < row.sides[0].n; ++i)
      between += row.sides[0].weights[i] * at(row.sides[0].slots[i]).x;
    for (unsigned int i = 0; i < row.sides[1].n; ++i)
      between -= row.sides[1].weights[i] * at(row.sides[1].slots[i]).x;
    return between * row.normal;
  }



  double
  GeneralContact::inner_gap_at_end(const Row &row) const
  {
    Tensor<1, dim> between;
    for (unsigned int side = 0; side < 2; ++side)
      for (unsigned int i = 0; i < row.sides[side].n; ++i)
        between += (side == 0 ? 1. : -1.) * row.sides[side].weights[i] *
                   Tensor<1, dim>(inner_to[candidates.at_slots.node(row.sides[side].slots[i])]);
    return between * row.normal;
  }



  GeneralContact::Row
  GeneralContact::node_row(const SurfacePoint          &node,
                           const unsigned int           face,
                           const unsigned int           triangle,
                           const std::array<double, 3> &weights,
                           const Tensor<1, dim>        &normal) const
  {
    Row row;
    row.key = {on_faces, key(node), {{candidates.faces[face].key, triangle}}};
    row.sides[0].add(node, 1.);
    for (unsigned int a = 0; a < 4; ++a) // always all corners, in the order of the face
      row.sides[1].add(corner(face, a), 0.25 * weights[2]);
    row.sides[1].add(corner(face, triangle), weights[0]);
    row.sides[1].add(corner(face, triangle + 1), weights[1]);
    row.normal = normal;
    row.size   = std::min(size(node), size(corner(face, triangle)));
    row.gap    = gap_at_start(row);
    return row;
  }



  // The finer surface is the slave; where both are alike, the body or node that comes first.
  bool
  GeneralContact::is_slave(const std::size_t node, const unsigned int face) const
  {
    double other = 0.;
    for (unsigned int a = 0; a < 4; ++a)
      other += 0.25 * size(corner(face, a));
    const double own = at(node).size;
    if (std::abs(own - other) > round_off * other)
      return own < other;
    const ImpactFace &of = candidates.faces[node / 4], &to = candidates.faces[face];
    return of.body != to.body ? of.body < to.body : candidates.key(node) < to.nodes[0];
  }



  bool
  GeneralContact::is_slave(const unsigned int pair) const
  {
    char &known = slave_of_pair[pair];
    if (known == 0)
      {
        const auto &[node, face, of_faces] = candidates.node_faces[pair];
        known                              = is_slave(node, face) ? 1 : 2;
      }
    return known == 1;
  }



  std::optional<GeneralContact::Hit>
  GeneralContact::over_face(const unsigned int pair) const
  {
    const auto &[node, face, of_faces] = candidates.node_faces[pair];
    const Tensor<1, dim>         &x    = at(node).x;
    std::array<Tensor<1, dim>, 4> corners;
    for (unsigned int i = 0; i < 4; ++i)
      corners[i] = at(corner(face, i).slot).x - x;
    const Tensor<1, dim> c = mean(middle(face), &NodeMotion::x) - x;
    Hit                  best;
    double               inside = -tie;
    for (unsigned int t = 0; t < 4; ++t)
      {
        const Tensor<1, dim> &a = corners[t], &b = corners[(t + 1) % 4];
        const Tensor<1, dim>  twice_area = cross_product_3d(b - a, c - a);
        const double          square     = twice_area.norm_square();
        if (square == 0.)
          continue;
        const std::array<double, 3> weights{{cross_product_3d(b, c) * twice_area / square,
                                             cross_product_3d(c, a) * twice_area / square,
                                             cross_product_3d(a, b) * twice_area / square}};
        const double                least = *std::min_element(weights.begin(), weights.end());
        // Not at the edge of the face, where another body can be flush with it.
        if (least < inside || weights[2] < touching)
          continue;
        inside        = least;
        best.face     = face;
        best.normal   = twice_area / std::sqrt(square);
        best.gap      = -(a * best.normal);
        best.middle   = c + x;
        best.triangle = t;
        best.weights  = weights;
      }
    if (best.face == numbers::invalid_unsigned_int)
      return {};
    best.pair    = pair;
    best.opposed = at(node).normal * best.normal;
    return best;
  }



  void
  GeneralContact::add_hit(const unsigned int pair, std::vector<Hit> &hits) const
  {
    const auto &[node, face, of_faces] = candidates.node_faces[pair];

    // The nodes of the other side only where they had to press in the cycle before.
    if (!is_slave(pair) && pressed_nodes[candidates.at_slots.node(node)] != epoch)
      return;
    const auto hit = over_face(pair);
    if (!hit)
      return;
    const double h = std::min(at(node).size, size(corner(face, hit->triangle)));
    if (hit->gap <= touching * h && hit->gap >= -overlapping * h && hit->opposed <= 0.)
      hits.push_back(*hit);
  }



  // In a hollow a node has a row with each of several faces. Where they are flush, or where the
  // edge between them stands out, it has one: with both it could not slide off the edge. But where
  // both are opposed to it in the same way there is nothing to choose by.
  bool
  GeneralContact::stand_together(const Hit &one, const Hit &other, const std::size_t node) const
  {
    const Tensor<1, dim> &x         = at(node).x;
    const double          tolerance = touching * at(node).size;
    if ((one.middle - x) * other.normal > tolerance && (other.middle - x) * one.normal > tolerance)
      return true;
    // Two plates that a node is between face each other.
    return one.normal * other.normal <= 0. &&
           !candidates.faces[one.face].shares_node(candidates.faces[other.face]);
  }



  void
  GeneralContact::find_touching_nodes()
  {
    touches.assign(candidates.node_faces.size(), false);
    // What touches at the start does so before anything has moved.
    std::vector<unsigned int> near;
    const auto &[first, of_pairs] = candidates.nodes_by_faces;
    for (const unsigned int k : near_pairs)
      if (face_limits[k] <= travelled)
        for (unsigned int i = first[k]; i < first[k + 1]; ++i)
          if (!(apart_nodes[of_pairs[i]].until > travelled))
            near.push_back(of_pairs[i]);
    std::sort(near.begin(), near.end());
    std::vector<Hit> hits, kept;
    for (std::size_t begin = 0, end = 0; begin < near.size(); begin = end)
      {
        // The same node may be called by the slots of several faces.
        const std::size_t   node = candidates.node_faces[near[begin]].node;
        const std::uint64_t of   = candidates.key(node);
        hits.clear();
        kept.clear();
        for (end = begin;
             end < near.size() && candidates.key(candidates.node_faces[near[end]].node) == of;
             ++end)
          add_hit(near[end], hits);
        // The face that is most opposed comes first, of equal ones that of the lowest key.
        std::stable_sort(hits.begin(), hits.end(), [](const Hit &a, const Hit &b) {
          return a.opposed < b.opposed;
        });
        for (const Hit &hit : hits)
          if (std::all_of(kept.begin(), kept.end(), [&](const Hit &other) {
                return stand_together(hit, other, node) ||
                       (hit.opposed - kept.front().opposed < tie &&
                        hit.normal * other.normal < 1. - tie);
              }))
            kept.push_back(hit);
        for (const Hit &hit : kept)
          {
            touches[hit.pair] = true;
            use(node_row({node, false}, hit.face, hit.triangle, hit.weights, hit.normal));
          }
      }
  }



  std::array<SurfacePoint, 2>
  GeneralContact::ends_of(const std::size_t edge) const
  {
    const std::size_t other = ContactCandidates::next(edge);
    const bool        first = candidates.key(edge) < candidates.key(other);
    return {{{first ? edge : other, false}, {first ? other : edge, false}}};
  }



  GeneralContact::Points
  GeneralContact::ends_of(const ContactCandidates::EdgePair &pair) const
  {
    const auto e = ends_of(pair.one), f = ends_of(pair.other);
    return {{e[0], e[1], f[0], f[1]}};
  }



  Tensor<1, dim>
  GeneralContact::outward(const Points &ends) const
  {
    return mean(ends[2], &NodeMotion::normal) + mean(ends[3], &NodeMotion::normal) -
           mean(ends[0], &NodeMotion::normal) - mean(ends[1], &NodeMotion::normal);
  }



  GeneralContact::Row
  GeneralContact::edge_row(const Points                &ends,
                           const std::array<double, 2> &at_edges,
                           const Tensor<1, dim>        &normal) const
  {
    Row row;
    row.key = {on_edges, key(ends[0]), {{key(ends[1]), key(ends[2]), key(ends[3])}}};
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
    row.size   = std::min({size(ends[0]), size(ends[1]), size(ends[2]), size(ends[3])});
    row.gap    = gap_at_start(row);
    return row;
  }



  std::optional<GeneralContact::Row>
  GeneralContact::nearest_edges(const Points &ends) const
  {
    const Tensor<1, dim> a = mean(ends[0], &NodeMotion::x), e = mean(ends[1], &NodeMotion::x) - a,
                         b = mean(ends[2], &NodeMotion::x), f = mean(ends[3], &NodeMotion::x) - b;
    const Tensor<1, dim> across = cross_product_3d(e, f);
    const double         square = across.norm_square();
    if (!(square > 1e-12 * e.norm_square() * f.norm_square()))
      return {}; // parallel: nodes on faces serve them
    const double s = cross_product_3d(b - a, f) * across / square,
                 t = cross_product_3d(b - a, e) * across / square;
    if (std::min({s, t, 1. - s, 1. - t}) < -tie)
      return {};
    const Tensor<1, dim> normal =
      (across * outward(ends) < 0. ? -1. : 1.) / std::sqrt(square) * across;
    return edge_row(ends, {{s, t}}, normal);
  }



  void
  GeneralContact::find_touching_edges()
  {
    for (const std::size_t number : watched)
      if (auto row = nearest_edges(ends_of(candidates.edge_pairs[number]));
          row && row->gap <= touching * row->size && row->gap >= -overlapping * row->size)
        {
          row->edges = number;
          use(*row);
        }
  }
} // namespace Touchstone
