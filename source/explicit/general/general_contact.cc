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
     * smallest face. A cycle whose impulses make more than so many times of its motion is halved.
     */
    constexpr double cycles_ahead = 80., most_margin = 0.5, of_impulses = 2.2;

    /** Where many places touch, one or the other always asks for an earlier kind of rows: after so
     * many rounds none waits for others. */
    constexpr unsigned int rounds_in_order = 3;

    /** Of what surfaces are moved inwards: by so much more a gap opens that was kept open in vain.
     */
    constexpr double least_opening = 0.25;

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
    , candidates(surface, nodes, solid.owned, parameters.search.name)
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
    forget();
    inset_now.clear();
    inset_before.clear();
    energies = Energy();
  }



  // Two nodes have come no nearer to each other, along an axis, than by the range of what all have
  // moved.
  GeneralContact::Range
  GeneralContact::range(const NodeField &u, const NodeField &v, const double step) const
  {
    // Largest motions along the axes and against them: since the candidates were made, since the
    // cycle before began, and in the cycle.
    std::array<double, 6 * dim> most, all;
    most.fill(-std::numeric_limits<double>::max());
    const auto widen = [&](const unsigned int i, const double motion) {
      most[i]       = std::max(most[i], motion);
      most[i + dim] = std::max(most[i + dim], -motion);
    };
    const NodeField &before = inset_now.empty() ? u : begun_at;
    for (const unsigned int node : surface.owned_nodes())
      for (unsigned int d = 0; d < dim; ++d)
        {
          widen(d, u[node][d] - made_at[node][d]);
          widen(2 * dim + d, u[node][d] - before[node][d]);
          widen(4 * dim + d, step * v[node][d]);
          // Comparisons do not see it.
          if (!std::isfinite(v[node][d]))
            most[4 * dim + d] = std::numeric_limits<double>::infinity();
        }
    Utilities::MPI::max(ArrayView<const double>(most.data(), most.size()),
                        nodes.communicator(),
                        ArrayView<double>(all.data(), all.size()));
    Range          result{0., 0., 0., 0.};
    Tensor<1, dim> before_cycle, in_cycle;
    for (unsigned int d = 0; d < dim; ++d)
      {
        before_cycle[d] = all[2 * dim + d] + all[3 * dim + d];
        in_cycle[d]     = all[4 * dim + d] + all[5 * dim + d];
        result.before   = std::max(result.before, all[d] + all[dim + d]);
        result.in_cycle = std::max(result.in_cycle, in_cycle[d]);
      }
    result.far_before   = above_round_off * before_cycle.norm();
    result.far_in_cycle = above_round_off * in_cycle.norm();
    return result;
  }



  void
  GeneralContact::renew_candidates(const NodeField &u,
                                   const NodeField &v,
                                   const double     step,
                                   const double     in_cycle)
  {
    keep_totals();
    made_at             = u;
    const double wanted = parameters.margin_length();
    const double automatic =
      std::clamp(cycles_ahead * in_cycle, least_margin * smallest, most_margin * smallest);
    margin = most_in_cycle + (wanted > 0. ? wanted : automatic);
    candidates.find(u, v, step, margin);
    begin_candidates();
    rows.clear();
    totals.clear();
    numbers.clear();
    new_rows = true;
    renew    = false;
    carry_over();
  }



  void
  GeneralContact::begin_candidates()
  {
    motion.resize(candidates.at_slots.n());
    local.resize(candidates.at_slots.n_owned());
    for (unsigned int node = 0; node < local.size(); ++node)
      local[node] = nodes.local(candidates.at_slots.dof(node));
    apart_faces.assign(candidates.face_pairs.size(), {});
    apart_nodes.assign(candidates.node_faces.size(), {});
    apart_edges.assign(candidates.edge_pairs.size(), {});
    apart_inner.assign(candidates.face_pairs.size(), {});
  }



  void
  GeneralContact::carry_over()
  {
    std::map<unsigned int, std::vector<Pressed>> messages;
    for (const auto &[key, what] : pressed)
      {
        std::pair<Point<dim>, Point<dim>> corners(what.lower, what.upper);
        for (unsigned int d = 0; d < dim; ++d)
          {
            corners.first[d] -= candidates.reach();
            corners.second[d] += candidates.reach();
          }
        candidates.regions().for_each_owner(BoundingBox<dim>(corners),
                                            [&, &what = what](const unsigned int rank) {
                                              messages[rank].push_back(what);
                                            });
      }
    forget();
    for (const auto &[rank, list] : exchange_records(messages, nodes.communicator()))
      for (const Pressed &what : list)
        remember(what);
  }



  void
  GeneralContact::import(const NodeField &u, const NodeField &v)
  {
    for (unsigned int node = 0; node < local.size(); ++node)
      motion[node] = {surface.position(local[node], u),
                      v[local[node]],
                      inset_now[local[node]].normal,
                      inset_before[local[node]].normal,
                      surface.size(local[node]),
                      inset_now[local[node]].depth,
                      inset_before[local[node]].depth};
    candidates.at_slots.forward(motion);
  }



  std::vector<ImpactSurface::Inset>
  GeneralContact::insets(const NodeField &u) const
  {
    std::vector<ImpactSurface::Inset> result(nodes.n_local());
    for (const unsigned int node : surface.owned_nodes())
      result[node] = surface.inset(node, u);
    return result;
  }



  // The surfaces of the check go on from where the cycle before has left them, with its normals, so
  // that nothing passes through them as normals turn from one cycle to the next. An interval knows
  // of the cycle before it what a checkpoint knows: where it began.
  void
  GeneralContact::set_insets(const NodeField &u,
                             const NodeField &v_before,
                             const double     step_before)
  {
    bool same = !inset_now.empty();
    for (const unsigned int node : surface.owned_nodes())
      same = same && u[node] == begun_at[node];
    // A cycle that is halved begins where it has begun.
    if (Utilities::MPI::min(int(same), nodes.communicator()) == 1)
      return;
    if (!inset_now.empty())
      inset_before = std::move(inset_now);
    else if (step_before > 0.)
      {
        NodeField before = u;
        for (unsigned int node = 0; node < nodes.n_local(); ++node)
          before[node] -= step_before * v_before[node];
        inset_before = insets(before);
      }
    inset_now = insets(u);
    if (inset_before.empty())
      inset_before = inset_now;
    begun_at = u;
  }



  void
  GeneralContact::begin_cycle(const NodeField &u,
                              const NodeField &v_before,
                              const double     step_before,
                              const NodeField &v,
                              const double     step,
                              const bool       only_touching)
  {
    cycle = step;
    for (Row &row : rows)
      row.used = false;
    const Range moved = range(u, v, step);
    if (!std::isfinite(moved.in_cycle))
      return; // what is wrong with the velocities is told where the cycle is checked
    travelled += moved.far_before;
    travels = moved.far_in_cycle;
    // What impulses may make of the motion: of the state alone, not of when candidates were made.
    most_in_cycle = std::max(of_impulses * moved.in_cycle, least_margin * smallest);
    if (renew || moved.before + most_in_cycle > margin)
      renew_candidates(u, v, step, moved.in_cycle);
    set_insets(u, v_before, step_before);
    if (!candidates.any())
      return;
    import(u, v);
    find_near(std::sqrt(double(dim)) * above_round_off * most_in_cycle);
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
    const Range moves = range(u, v, step);
    if (!candidates.any() || !std::isfinite(moves.in_cycle))
      return Crossings::none;
    if (moves.in_cycle > most_in_cycle)
      return Crossings::too_far;
    travels = moves.far_in_cycle;
    import(u, v);
    return check_motion(/*ahead=*/false, round <= rounds_in_order) ? Crossings::rows
                                                                   : Crossings::none;
  }



  // Rows of nodes of the finer side alone mostly keep surfaces apart. Those of the other side, and
  // of edges, say nearly the same where surfaces are flat, which makes sweeps slow: they come only
  // if something still crosses. With free velocities all that is pressed together crosses, and
  // touches already: only what is new there is worth a look.
  bool
  GeneralContact::check_motion(const bool ahead, const bool in_order)
  {
    looks_ahead = ahead;
    set_inner_positions();
    find_open_faces();
    found.clear();
    std::size_t known   = 0;
    bool        goes_on = true;
    for (const Kind kind : {Kind::slave_node, Kind::node, Kind::edges, Kind::inner})
      if (goes_on && (!ahead || kind == Kind::slave_node))
        {
          for (const OpenFaces &faces : open_faces)
            check_faces(faces, kind);
          // A row that is not there yet.
          int is_new = 0;
          for (; known < found.size(); ++known)
            {
              const auto there = numbers.find(found[known].key);
              is_new |= there == numbers.end() || !rows[there->second].used;
            }
          goes_on = !in_order || Utilities::MPI::max(is_new, nodes.communicator()) == 0;
        }
    if (goes_on && !ahead)
      for (const OpenFaces &faces : open_faces)
        keep_until(faces);
    // First of all of them: one place can be found more than once.
    if (!ahead)
      for (Row &row : found)
        row.more = opens_more(row);
    for (const Row &row : found)
      use(row);
    int last[2] = {new_rows, !found.empty()};
    Utilities::MPI::max(last, nodes.communicator(), last);
    new_rows = last[0] > 0;
    return last[1] > 0;
  }



  // As faces turn and nodes slide, a row that takes part can leave open what crosses; of an overlap
  // that is close to what surfaces are moved inwards by it can do so in the shortest of cycles.
  double
  GeneralContact::opens_more(const Row &row) const
  {
    const auto there = numbers.find(row.key);
    if (there == numbers.end() || !rows[there->second].used)
      return 0.;
    return rows[there->second].more +
           std::max(least_opening * inset * row.size, -inner_gap_at_end(row));
  }



  void
  GeneralContact::use(const Row &row)
  {
    const auto [there, is_new] = numbers.try_emplace(row.key, rows.size());
    if (is_new)
      {
        rows.emplace_back();
        totals.emplace_back();
        new_rows = true;
      }
    rows[there->second]      = row;
    rows[there->second].used = true;
  }
} // namespace Touchstone
