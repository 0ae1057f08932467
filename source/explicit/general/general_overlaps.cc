// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/collision/first_crossing.h>
#include <touchstone/explicit/general/general_contact.h>

#include <algorithm>
#include <cmath>

// Surfaces as they stand, without motion: where edges pass through faces, and what overlaps by how
// much (doc/general_contact.md, section 6).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Relative to the size of faces: what overlaps by more is no fault of the mesh; by less
     * surfaces do not cross; and what does not count at all. */
    constexpr double deepest = 0.25, shallow = 0.5 * GeneralContact::inset, least = 1e-9;

    /** The reach is not more than so many times of the smallest face: where sizes differ by
     * more, there would be too many candidates. */
    constexpr double of_smallest = 8.;
  } // namespace



  void
  GeneralContact::look_at(const NodeField &u, const double inwards, const double reach)
  {
    const NodeField at_rest(nodes.n_local());
    keep_totals();
    rows.clear();
    impulses.clear_rows();
    totals.clear();
    numbers.clear();
    impulses.forget();
    made_at = u;
    margin  = reach;
    candidates.find(u, at_rest, 0., margin, /*neighbours_as_well=*/true);
    begin_candidates();
    moving.insets.forget();
    moving.insets.begin_cycle(u, at_rest, 0.);
    moving.cycle = 0.;
    find_near();
    moving.import(u, at_rest);
    moving.set_inner_positions(inwards);
    renew = true;
  }



  void
  GeneralContact::for_each_crossing(
    const std::function<void(unsigned int, unsigned int, unsigned int)> &found) const
  {
    const auto check = [&](const unsigned int of, const unsigned int face) {
      for (unsigned int a = 0; a < 4; ++a)
        {
          const SurfacePoint begin = moving.corner(of, a), end = moving.corner(of, a + 1);
          // An edge that hangs on the cell of the face meets it where it begins.
          if (candidates.faces[face].of_cell(moving.key(begin)) ||
              candidates.faces[face].of_cell(moving.key(end)))
            continue;
          const Point<dim> p = moving.inner_position(begin, false),
                           q = moving.inner_position(end, false);
          for (unsigned int t = 0; t < 4; ++t)
            {
              // The edge as the path of a node.
              const FourPoints start{{p,
                                      moving.inner_position(moving.corner(face, t), false),
                                      moving.inner_position(moving.corner(face, t + 1), false),
                                      moving.inner_position(moving.middle(face), false)}};
              FourPoints       through = start;
              through[0]               = q;
              if (first_crossing_node_triangle(start, through))
                {
                  found(of, a, face);
                  break;
                }
            }
        }
    };
    for (const ContactCandidates::FacePair &pair : candidates.face_pairs)
      if (pair.inner[ContactCandidates::of_both])
        {
          check(pair.one, pair.other);
          check(pair.other, pair.one);
        }
  }



  std::optional<GeneralContact::Row>
  GeneralContact::passed_edge(const SurfacePoint &begin,
                              const SurfacePoint &end,
                              const unsigned int  face) const
  {
    std::optional<Row> best;
    const bool         ascends = moving.key(begin) < moving.key(end);
    const auto         against = [&](const MovingSurface::Edge &other) {
      const auto row =
        nearest_edges(moving, {{ascends ? begin : end, ascends ? end : begin, other[0], other[1]}});
      if (row && row->gap < -shallow * row->size && row->gap > -deepest * row->size &&
          (!best || row->gap > best->gap))
        best = row;
    };
    for (unsigned int b = 0; b < 4; ++b)
      {
        against(moving.ends_of(moving.corner(face, b).slot));
        // Warped faces stand out along the lines to their middle.
        against({{moving.corner(face, b), moving.middle(face)}});
      }
    return best;
  }



  std::vector<GeneralContact::Overlap>
  GeneralContact::overlaps(const NodeField &u)
  {
    double largest = 0.;
    for (const unsigned int node : surface.owned_nodes())
      largest = std::max(largest, surface.size(node));
    largest = Utilities::MPI::max(largest, nodes.communicator());
    look_at(u, inset, deepest * std::min(largest, of_smallest * smallest));
    int                  deep = 0;
    std::vector<Overlap> mine;
    const auto           add = [&](const Row &row) {
      Overlap one;
      one.key    = row.key;
      one.normal = row.normal;
      one.depth  = -row.gap;
      for (unsigned int side = 0; side < 2; ++side)
        for (unsigned int i = 0; i < row.sides[side].n; ++i)
          {
            one.dofs[one.n]      = candidates.dof(row.sides[side].slots[i]);
            one.weights[one.n++] = (side == 0 ? 1. : -1.) * row.sides[side].weights[i];
          }
      mine.push_back(one);
    };
    for (unsigned int i = 0; i < candidates.node_faces.size(); ++i)
      if (const auto hit = over_face(i); hit && hit->opposed < 0. && hit->gap < 0.)
        {
          const Row row = node_row(moving,
                                   {candidates.node_faces[i].node, false},
                                   hit->face,
                                   hit->triangle,
                                   hit->weights,
                                   hit->normal);
          if (row.gap < -least * row.size && row.gap > -deepest * row.size)
            add(row);
          deep |= row.gap < -shallow * row.size && row.gap > -deepest * row.size;
        }
    // Edges pass through faces where nodes are within bodies, too.
    if (Utilities::MPI::max(deep, nodes.communicator()) == 0)
      for_each_crossing([&](const unsigned int of, const unsigned int a, const unsigned int face) {
        if (const auto row = passed_edge(moving.corner(of, a), moving.corner(of, a + 1), face))
          add(*row);
      });
    std::vector<Overlap> all = gather_all(mine, nodes.communicator()), result;
    std::sort(all.begin(), all.end(), [](const Overlap &a, const Overlap &b) {
      return a.key < b.key;
    });
    for (const Overlap &one : all)
      if (result.empty() || one.key.pair != SurfaceRow::on_faces ||
          result.back().key.slave != one.key.slave)
        {
          // Edges are found once from each side.
          if (result.empty() || result.back().key < one.key)
            result.push_back(one);
        }
      else if (one.depth < result.back().depth)
        result.back() = one;
    return result;
  }
} // namespace Touchstone
