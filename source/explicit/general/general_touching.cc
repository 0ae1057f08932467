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
    /** Relative to the size of the faces, an overlap that is still one of this pair. */
    constexpr double overlapping = 0.01;
  } // namespace



  bool
  GeneralContact::is_slave(const unsigned int pair) const
  {
    char &known = slave_of_pair[pair];
    if (known == 0)
      {
        const auto &[node, face, of_faces] = candidates.node_faces[pair];
        known                              = moving.is_slave(node, face) ? 1 : 2;
      }
    return known == 1;
  }



  std::optional<GeneralContact::Hit>
  GeneralContact::over_face(const unsigned int pair) const
  {
    const auto &[node, face, of_faces] = candidates.node_faces[pair];
    const Tensor<1, dim>         &x    = moving.at(node).x;
    std::array<Tensor<1, dim>, 4> corners;
    for (unsigned int i = 0; i < 4; ++i)
      corners[i] = moving.at(moving.corner(face, i).slot).x - x;
    const Tensor<1, dim> c = moving.mean(moving.middle(face), &NodeMotion::x) - x;
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
    best.opposed = moving.at(node).normal * best.normal;
    return best;
  }



  void
  GeneralContact::add_hit(const unsigned int pair, std::vector<Hit> &hits) const
  {
    const auto &[node, face, of_faces] = candidates.node_faces[pair];

    // The nodes of the other side only where they had to press in the cycle before.
    if (!is_slave(pair) && !impulses.pressed(node))
      return;
    const auto hit = over_face(pair);
    if (!hit)
      return;
    const double h =
      std::min(moving.at(node).size, moving.size(moving.corner(face, hit->triangle)));
    if (hit->gap <= touching * h && hit->gap >= -overlapping * h && hit->opposed <= 0.)
      hits.push_back(*hit);
  }



  // In a hollow a node has a row with each of several faces. Where they are flush, or where the
  // edge between them stands out, it has one: with both it could not slide off the edge. But where
  // both are opposed to it in the same way there is nothing to choose by.
  bool
  GeneralContact::stand_together(const Hit &one, const Hit &other, const std::size_t node) const
  {
    const Tensor<1, dim> &x         = moving.at(node).x;
    const double          tolerance = touching * moving.at(node).size;
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
            use(node_row(moving, {node, false}, hit.face, hit.triangle, hit.weights, hit.normal));
          }
      }
  }



  void
  GeneralContact::find_touching_edges()
  {
    for (const std::size_t number : impulses.edges())
      if (auto row = nearest_edges(moving, moving.ends_of(candidates.edge_pairs[number]));
          row && row->gap <= touching * row->size && row->gap >= -overlapping * row->size)
        {
          row->edges = number;
          use(*row);
        }
  }
} // namespace Touchstone
