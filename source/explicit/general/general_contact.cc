// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/explicit/general/general_contact.h>

#include <algorithm>
#include <cmath>
#include <limits>

// The cycle of general contact (doc/general_contact.md, section 3): candidates, rows, crossings.
// What touches is found in general_touching.cc, crossings in general_crossings.cc; what the solver
// is told and tells is in general_rows.cc.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The margin beyond the present cycle: the motion of so many cycles, up to this part of the
     * smallest face. A cycle whose impulses make more than so many times of its motion begins anew
     * with candidates for that.
     */
    constexpr double cycles_ahead = 160., most_margin = 0.5, of_impulses = 2.2;

    /** After so many rounds no kind of rows waits for earlier ones. */
    constexpr unsigned int rounds_in_order = 2;

    /** A gap that was kept open in vain opens by so many times what is missing, or this part of
     * what surfaces are moved inwards by: faces and normals turn on as it opens, and each round
     * costs more than a gap that is wider. */
    constexpr double opening = 3., least_missing = 0.5;

    /** After so many checks, of which that with free velocities counts as one, that found nothing
     * but rows that are fully open it is no use to go on: what changes in them are places and
     * normals alone. */
    constexpr unsigned int most_in_vain = 3;

    /** For sums and products of lengths that have to be bounds. */
    constexpr double above_round_off = 1. + 1e-9;
  } // namespace



  GeneralContact::GeneralContact(const GeneralContactParameters &parameters,
                                 const ImpactSurfaceInput       &input,
                                 const Solid                    &solid,
                                 const NodeMap                  &nodes)
    : parameters(parameters)
    , nodes(nodes)
    , surface(input, solid, nodes)
    , mirror_planes(input, solid, surface, nodes)
    , candidates(surface, nodes, solid.owned, parameters.search.name)
    , moving(surface, nodes, candidates)
    , impulses(candidates, moving, nodes.communicator())
    , made_at(nodes.n_local())
    , outcome(surface, nodes, solid.owned)
  {
    double size = std::numeric_limits<double>::max();
    for (const unsigned int node : surface.owned_nodes())
      size = std::min(size, surface.size(node));
    smallest = Utilities::MPI::min(size, nodes.communicator());
    if (parameters.friction)
      {
        friction.emplace();
        friction->law = parameters.friction.get();
      }
  }



  void
  GeneralContact::begin_interval()
  {
    renew = true;
    candidates.begin_interval();
    rows.clear();
    totals.clear();
    outcome.begin_interval();
    numbers.clear();
    impulses.begin_interval();
    moving.insets.forget();
    energies = Energy();
  }



  // Two nodes have come no nearer to each other, along an axis, than by the range of what all have
  // moved. Comparisons do not see what is not finite.
  template <class Motion>
  GeneralContact::Range
  GeneralContact::range(const Motion &motion) const
  {
    constexpr double largest = std::numeric_limits<double>::max();
    double lower[3] = {largest, largest, largest}, upper[3] = {-largest, -largest, -largest};
    double none = 0.;
    for (const unsigned int node : surface.owned_nodes())
      {
        const Tensor<1, dim> x = motion(node);
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = x[d] < lower[d] ? x[d] : lower[d];
            upper[d] = x[d] > upper[d] ? x[d] : upper[d];
            none += 0. * x[d];
          }
      }
    std::array<double, 2 * dim> most, all;
    for (unsigned int d = 0; d < dim; ++d)
      {
        most[d]       = none == 0. ? upper[d] : std::numeric_limits<double>::infinity();
        most[dim + d] = -lower[d];
      }
    Utilities::MPI::max(ArrayView<const double>(most.data(), most.size()),
                        nodes.communicator(),
                        ArrayView<double>(all.data(), all.size()));
    Range          result{{}, 0., 0.};
    Tensor<1, dim> distance;
    for (unsigned int d = 0; d < dim; ++d)
      {
        result.along[d] = distance[d] = all[d] + all[dim + d];
        result.largest                = std::max(result.largest, result.along[d]);
      }
    result.distance = above_round_off * distance.norm();
    return result;
  }



  // What nodes have moved in cycles one after the other is a bound, and mostly enough.
  bool
  GeneralContact::candidates_hold(const NodeField &u, const Range &moved)
  {
    const auto hold = [&] {
      return *std::max_element(since_made.begin(), since_made.end()) + most_in_cycle <= margin;
    };
    for (unsigned int d = 0; d < dim; ++d)
      since_made[d] += above_round_off * moved.along[d];
    if (hold())
      return true;
    since_made = range([&](const unsigned int n) { return u[n] - made_at[n]; }).along;
    return hold();
  }



  void
  GeneralContact::renew_candidates(const NodeField &u,
                                   const NodeField &v,
                                   const double     step,
                                   const double     in_cycle)
  {
    keep_totals();
    const LastImpulses::Carried last = impulses.carried(rows);
    made_at                          = u;
    since_made.fill(0.);
    const double wanted = parameters.margin_length();
    const double automatic =
      std::clamp(cycles_ahead * in_cycle, least_margin * smallest, most_margin * smallest);
    margin = most_in_cycle + (wanted > 0. ? wanted : automatic);
    candidates.find(u, v, step, margin);
    begin_candidates();
    rows.clear();
    impulses.clear_rows();
    totals.clear();
    numbers.clear();
    new_rows = true;
    renew    = false;
    impulses.carry_over(last);
  }



  void
  GeneralContact::begin_candidates()
  {
    moving.reinit();
    impulses.reinit();
    slave_of_pair.assign(candidates.node_faces.size(), 0);
    face_limits.assign(candidates.face_pairs.size());
    apart_faces.assign(candidates.face_pairs.size(), {});
    apart_nodes.assign(candidates.node_faces.size(), {});
    apart_edges.assign(candidates.edge_pairs.size(), {});
    apart_inner.assign(candidates.face_pairs.size(), {});
  }



  void
  GeneralContact::begin_cycle(const NodeField &u,
                              const NodeField &v_before,
                              const double     step_before,
                              const NodeField &v,
                              const double     step,
                              const bool       only_touching,
                              const double     reach)
  {
    for (Row &row : rows)
      row.used = false;
    const Range moves = range([&](const unsigned int n) { return step * v[n]; });
    if (!std::isfinite(moves.largest))
      return; // what is wrong with the velocities is told where the cycle is checked
    const NodeField *const start  = moving.insets.start();
    const NodeField       &before = start ? *start : u;
    const Range            moved  = range([&](const unsigned int n) { return u[n] - before[n]; });
    travelled += moved.distance;
    travels = moves.distance;
    // What impulses may make of the motion: of the state alone, not of when candidates were made.
    most_in_cycle = std::max(reach * of_impulses * moves.largest, least_margin * smallest);
    if (renew || !candidates_hold(u, moved))
      renew_candidates(u, v, step, moves.largest);
    moving.cycle   = step;
    checks_in_vain = 0;
    impulses.begin_cycle();
    moving.insets.begin_cycle(u, v_before, step_before);
    if (!candidates.any())
      return;
    moving.clear();
    impulses.add_nodes_to(moving, rows);
    find_near();
    moving.import(u, v);
    find_touching_nodes();
    find_touching_edges();
    if (!only_touching)
      check_motion(/*ahead=*/true, /*in_order=*/true);
    else
      new_rows = Utilities::MPI::max(int(new_rows), nodes.communicator()) > 0;
  }



  GeneralContact::Crossings
  GeneralContact::find_crossings(const NodeField   &u,
                                 const NodeField   &v,
                                 const double       step,
                                 const unsigned int round)
  {
    const Range moves = range([&](const unsigned int n) { return step * v[n]; });
    if (!candidates.any() || !std::isfinite(moves.largest))
      return Crossings::none;
    if (moves.largest > most_in_cycle)
      return Crossings::too_far;
    travels = moves.distance;
    find_near();
    moving.import(u, v);
    return check_motion(/*ahead=*/false, round <= rounds_in_order);
  }



  void
  GeneralContact::find_near()
  {
    near_pairs.clear();
    face_limits.for_each_reached(travelled + travels, [&](const std::size_t pair) {
      near_pairs.push_back(pair);
      moving.add_face(candidates.face_pairs[pair].one);
      moving.add_face(candidates.face_pairs[pair].other);
    });
  }



  // Rows of nodes of the finer side alone mostly keep surfaces apart. Those of the other side, and
  // of edges, say nearly the same where surfaces are flat, which makes sweeps slow: in each place
  // they come only if something still crosses there. With free velocities all that is pressed
  // together crosses, and touches already: only what is new there is worth a look, and of the other
  // side what has pressed lately.
  GeneralContact::Crossings
  GeneralContact::check_motion(const bool ahead, const bool in_order)
  {
    looks_ahead = ahead;
    moving.set_inner_positions();
    find_open_faces();
    found.clear();
    waiting.assign(candidates.at_slots.n(), 0);
    for (const Kind kind : {Kind::slave_node, Kind::node, Kind::edges, Kind::inner})
      if (!ahead || kind == Kind::slave_node)
        {
          const std::size_t of_earlier_kinds = found.size();
          for (const OpenFaces &faces : open_faces)
            check_faces(faces, kind);
          if (in_order && !ahead)
            leave_to_earlier_kinds(of_earlier_kinds);
        }
    if (!ahead)
      for (const OpenFaces &faces : open_faces)
        keep_until(faces);
    // First of all of them: one place can be found more than once.
    int helps = 0;
    if (!ahead)
      for (Row &row : found)
        {
          const Row *const there = taking_part(row.key);
          helps |= there == nullptr || !there->fully_open;
          row.more = opens_more(row);
        }
    for (const Row &row : found)
      use(row);
    int last[3] = {new_rows, !found.empty(), helps};
    Utilities::MPI::max(last, nodes.communicator(), last);
    new_rows       = last[0] > 0;
    checks_in_vain = last[2] > 0 ? 0 : checks_in_vain + 1;
    if (last[1] == 0)
      return Crossings::none;
    return !ahead && checks_in_vain >= most_in_vain ? Crossings::in_vain : Crossings::rows;
  }



  // What crosses without a row at a node that has got a new one mostly does so no more with that
  // row. Rows that take part already are told anew where they cross.
  void
  GeneralContact::leave_to_earlier_kinds(const std::size_t first)
  {
    const RowNodes &at_slots = candidates.at_slots;
    found.erase(std::remove_if(found.begin() + first,
                               found.end(),
                               [&](const Row &row) {
                                 return taking_part(row.key) == nullptr &&
                                        row.any_slot([&](const std::size_t slot) {
                                          return waiting[at_slots.node(slot)] != 0;
                                        });
                               }),
                found.end());
    // What other ranks have found at the same nodes counts as well.
    std::vector<Tensor<1, dim>> marks(at_slots.alone() ? 0 : at_slots.n_slots());
    for (std::size_t k = first; k < found.size(); ++k)
      if (taking_part(found[k].key) == nullptr)
        found[k].any_slot([&](const std::size_t slot) {
          waiting[at_slots.node(slot)] = 1;
          if (!at_slots.alone())
            marks[slot][0] = 1.;
          return false;
        });
    if (at_slots.alone())
      return;
    std::vector<Tensor<1, dim>> sums(at_slots.n());
    at_slots.sum(marks, sums);
    for (unsigned int node = 0; node < at_slots.n_owned(); ++node)
      waiting[node] |= sums[node][0] > 0.;
    at_slots.forward(waiting);
  }



  const GeneralContact::Row *
  GeneralContact::taking_part(const RowKey &key) const
  {
    const auto there = numbers.find(key);
    return there != numbers.end() && rows[there->second].used ? &rows[there->second] : nullptr;
  }



  // As faces turn and nodes slide, a row that takes part can leave open what crosses, round after
  // round; of an overlap that is close to what surfaces are moved inwards by it can do so in the
  // shortest of cycles.
  double
  GeneralContact::opens_more(const Row &row) const
  {
    const Row *const there = taking_part(row.key);
    if (there == nullptr)
      return 0.;
    return there->more +
           opening * std::max(least_missing * inset * row.size, -inner_gap_at_end(moving, row));
  }



  void
  GeneralContact::use(const Row &row)
  {
    const auto [there, is_new] = numbers.try_emplace(row.key, rows.size());
    if (is_new)
      {
        rows.emplace_back();
        impulses.add_row();
        totals.emplace_back();
        new_rows = true;
      }
    rows[there->second]      = row;
    rows[there->second].used = true;
  }
} // namespace Touchstone
