// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/pairing/linear_rows.h>
#include <touchstone/contact/start_check.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// The geometry of the rows of a pair in each update: search and pairing in the present state for
// finite sliding, or the relative displacement at the weights of the reference state for small
// sliding and tied pairs (doc/theory.md 4), and then the treatment of initial overlaps.
namespace Touchstone
{
  using namespace dealii;

  void
  ContactPair::move_surfaces(const Vector &ghosted)
  {
    slave_surface->move(ghosted);
    if (master_surface)
      master_surface->move(ghosted);
  }



  void
  ContactPair::search(const Vector &u)
  {
    move_surfaces(u);
    pairing_method->update(u, time, present);
    if (points_meet)
      {
        point_rows->update(*pairing_method, time, present);
        for (std::size_t k = 0; k < present.size(); ++k)
          if (ContactRow &row = present[k]; row.between_nodes && row.has_partner)
            row.moved = row.motion.since(committed[k].motion, contact_point(row));
      }
    ++searches;
    // Only once, with the bodies as they are placed: later on surfaces may well separate.
    if (!started)
      check_start(u);
  }



  void
  ContactPair::check_start(const Vector &u)
  {
    const StartCheck check(input.solid,
                           input.parameters,
                           *slave_surface,
                           master_surface.get(),
                           input.slave_body,
                           input.master_body,
                           u,
                           present);
    // With an automatic search distance an initial interference can be deeper than the search
    // reaches, which is a multiple of the face size.
    const double depth = input.parameters.search_distance > 0. ? 0. : check.depth_of_overlap();
    const double face =
      master_surface ? std::max(slave_surface->largest_face(), master_surface->largest_face()) : 0.;
    if (depth > face)
      {
        // The first search did not reach the surface from within the overlap. The new distance
        // covers the depth and two faces beyond it.
        search_distance = std::max(depth + 2. * face, 4. * face);
        pairing_method  = make_pairing(search_distance);
        pairing_method->update(u, time, present);
        ++searches;
      }
    // Input error if all slave nodes face away from the master surface: wrong boundaries or
    // misplaced bodies would otherwise be contact that never happens.
    check.check_facing();
  }



  void
  ContactPair::make_reference()
  {
    // Small sliding pairs the reference state, whatever the displacement is in which a run starts.
    Vector zero;
    zero.reinit(*displacement);
    search(zero);
    if (carries_offset())
      make_linear(pairing_input(search_distance), present);
    reference = {present, with_stencils(present)};
  }



  Vector
  ContactPair::with_stencils(const std::vector<ContactRow> &rows) const
  {
    // Stencils may refer to dofs that are not in the ghost layer.
    IndexSet needed = input.solid.relevant;
    for (const ContactRow &row : rows)
      for (const StencilEntry &entry : row.stencil)
        needed.add_range(dim * entry.node, dim * entry.node + dim);
    needed.compress();
    Vector result;
    result.reinit(input.solid.owned, needed, input.solid.communicator);
    return result;
  }



  void
  ContactPair::set_gaps(std::vector<ContactRow> &rows, ReferenceRows &from, const Vector &u) const
  {
    // Gap vector g_0 + M u with constant weights and normal. A tied pair keeps its initial gap:
    // only the relative displacement M u is constrained, or what it lacks of a shortening.
    from.stencil_values        = u;
    const Tensor<1, dim> drawn = plane_cut ? plane_cut->drawn(*displacement) : Tensor<1, dim>();
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        ContactRow       &row       = rows[k];
        const ContactRow &reference = from.rows[k];
        if (!row.has_partner)
          continue;
        row.gap_vector = is_tied ? -drawn : reference.gap_vector;
        if (input.obstacle != nullptr)
          {
            // The node keeps its place on an obstacle that moves.
            row.motion = pairing_method->motion(time);
            row.gap_vector -=
              row.motion.since(reference.motion,
                               row.motion.place(reference.motion.back(row.reference)));
          }
        for (unsigned int d = 0; d < dim; ++d)
          {
            row.gap_vector[d] += from.stencil_values(dim * row.slave + d);
            for (const StencilEntry &entry : row.stencil)
              row.gap_vector[d] -= entry.weight * from.stencil_values(dim * entry.node + d);
          }
        row.gap = row.gap_vector * row.normal;
      }
  }



  double
  ContactPair::part_of_overlap(const double t) const
  {
    return input.parameters.initial_overlap == ContactPairParameters::Overlap::ramp
             ? std::max(0., 1. - t / input.end_time)
             : 1.;
  }



  double
  ContactPair::entered_overlap(const std::size_t k, const double from) const
  {
    if (is_tied)
      return 0.;
    if (input.parameters.initial_overlap == ContactPairParameters::Overlap::interference)
      return from == 0. && committed[k].has_partner ? std::min(committed[k].gap, 0.) : 0.;
    return (part_of_overlap(from) - part_of_overlap(time)) * overlaps[k];
  }



  void
  ContactPair::apply_overlap()
  {
    // "adjust" takes the initial overlap out of the gap for good, "ramp" at time 0 and less and
    // less until the end of the run, when all of it presses; "interference" leaves gaps alone. The
    // overlap is that of the first update. The gap vector changes as well, for friction with small
    // sliding is measured by it.
    const ContactPairParameters::Overlap treatment = input.parameters.initial_overlap;
    for (std::size_t k = 0; k < present.size(); ++k)
      {
        ContactRow &row = present[k];
        if (!row.has_partner)
          continue;
        if (!started && treatment != ContactPairParameters::Overlap::interference)
          overlaps[k] = std::min(row.gap, 0.);
        if (overlaps[k] < 0.)
          {
            const double part = part_of_overlap(time);
            row.gap -= part * overlaps[k];
            row.gap_vector -= part * overlaps[k] * row.normal;
          }
      }
  }



  void
  ContactPair::update(const Vector                                  &u,
                      const Vector                                  &ghosted,
                      const double                                   t,
                      const std::function<bool(const ContactRow &)> &active)
  {
    time         = t;
    displacement = &ghosted;
    for (ContactRow &row : present)
      {
        // Before the search: a row in contact leaves an edge of the master surface later than an
        // open one arrives there, or it would alternate (doc/theory.md 5, "Cycles").
        row.was_active = active(row);
        row.touched    = row.touches;
        row.touches    = 0;
        // Current positions; the ghosted displacement also holds the owned dofs.
        for (unsigned int d = 0; d < dim; ++d)
          row.position[d] = ghosted(dim * row.slave + d);
        row.position += row.reference;
      }
    if (points_meet)
      point_rows->release(present);
    if (!small)
      search(ghosted);
    else
      {
        if (!started)
          make_reference();
        set_gaps(present, reference, u);
      }
    apply_overlap();
    started = true;
  }



  void
  ContactPair::complete_cover(const Vector &u, const Vector *const part, const bool first)
  {
    // What is paired once is that of the first update.
    if (small && !first)
      return;
    const bool changes = pairing_method->set_cover_by_others(part);
    if (Utilities::MPI::max(static_cast<int>(changes), input.solid.communicator) == 0)
      return;
    if (small)
      {
        make_reference();
        set_gaps(present, reference, u);
      }
    else
      search(*displacement);
    // Overlaps that are taken out of gaps are those of the first rows.
    started = !first;
    apply_overlap();
    started = true;
  }



  void
  ContactPair::remove_rows(const std::set<Index> &nodes)
  {
    without_rows = nodes;
    slave_surface->set_without_rows(nodes);
    // Pairings hold copies of the faces.
    search_distance = input.parameters.search_distance;
    pairing_method  = make_pairing(search_distance);
    started         = false;
  }



  void
  ContactPair::remember(const PairingMemory &memory)
  {
    // Small sliding: the pairing is that of the reference state, made by an update.
    if (small)
      return;
    pairing_method->commit_positions(*displacement);
    pairing_method->remember(memory);
  }



  std::vector<ContactRow>
  ContactPair::rows_of_all_nodes(const Vector &u)
  {
    std::vector<ContactRow> rows(present);
    if (!master_surface)
      return rows;
    for (ContactRow &row : rows)
      {
        row.was_active = false;
        for (unsigned int d = 0; d < dim; ++d)
          row.position[d] = row.reference[d] + (*displacement)(dim * row.slave + d);
      }
    if (!small || !reference_of_all)
      {
        Vector none;
        none.reinit(*displacement);
        const Vector &where = small ? none : *displacement;
        slave_surface->set_without_rows({});
        move_surfaces(where);
        make_pairing(search_distance)->update(where, time, rows);
        ++searches;
        slave_surface->set_without_rows(without_rows);
        if (carries_offset())
          make_linear(pairing_input(search_distance), rows);
        if (small)
          reference_of_all = {rows, with_stencils(rows)};
      }
    if (small)
      {
        rows = reference_of_all->rows;
        set_gaps(rows, *reference_of_all, u);
      }
    return rows;
  }



  void
  ContactPair::differentiate(const std::function<bool(const ContactRow &)> &active)
  {
    if (small)
      return; // normals and stencils do not change
    // Only active rows get derivatives, which are expensive for averaged pairings; the active set
    // has been updated since update() was called.
    for (ContactRow &row : present)
      row.was_active = active(row);
    pairing_method->differentiate(*displacement, time, present);
    if (points_meet)
      point_rows->differentiate(*pairing_method, time, present);
    for (ContactRow &row : present)
      // Such a derivative holds over much less than a Newton increment, so that the row is better
      // frozen in this iteration.
      if (row.derivative && changes_steeply(row))
        row.derivative.reset();
  }
} // namespace Touchstone
