// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/row_archive.h>
#include <touchstone/contact/start_check.h>

#include <algorithm>

// A contact pair makes the geometry of its rows in each update: search and pairing in the present
// state for finite sliding, or the relative displacement at the weights of the reference state for
// small sliding and tied pairs (doc/theory.md 4), and then the treatment of initial overlaps. It is
// the only writer of rows beside its pairing.
namespace Touchstone
{
  using namespace dealii;

  ContactPair::ContactPair(const ContactPairInput &input)
    : input(input)
    , is_tied(input.parameters.tied())
    , small(is_tied || (input.obstacle == nullptr &&
                        input.parameters.sliding == ContactPairParameters::Sliding::small))
    , slave_surface(
        make_surface(input.slave_body, input.parameters.slave_boundaries, "Slave boundaries"))
  {
    if (input.obstacle == nullptr)
      {
        master_surface =
          make_surface(input.master_body, input.parameters.master_boundaries, "Master boundaries");
        // Surfaces of one body can meet, but a node that is master and slave of the same pair would
        // be constrained to itself.
        for (const types::boundary_id id : master_surface->boundaries())
          if (slave_surface->boundaries().count(id) > 0)
            throw InputError(input.parameters.section(),
                             "Master boundaries",
                             input.forest.boundary_name(id),
                             "this boundary of '" + input.parameters.master_body +
                               "' is slave and master at the same time",
                             "let different boundaries be slave and master");
      }
    pairing_method = make_pairing(input.parameters.search_distance);
    // One row for each slave node that this rank owns; hanging nodes have none. The stiffness E A /
    // h is the complementarity constant c of doc/theory.md 5 and the scale of all springs.
    for (const SurfaceNode &node : slave_surface->owned_nodes())
      {
        ContactRow row;
        row.pair        = input.number;
        row.slave       = node.node;
        row.reference   = node.reference;
        row.area        = node.area;
        row.size        = node.size;
        row.body        = input.slave_body;
        row.master_body = input.master_body;
        row.stiffness   = input.modulus * node.area / node.size;
        row.tied        = is_tied;
        present.push_back(row);
      }
    overlaps.assign(present.size(), 0.);
    number_rows(0);
    committed = present;
  }



  // Collective: all ranks make all surfaces, also those of which they own no face.
  std::unique_ptr<Surface>
  ContactPair::make_surface(const unsigned int              body,
                            const std::vector<std::string> &boundaries,
                            const std::string              &key) const
  {
    const std::string section = input.parameters.section();
    const bool        exact =
      (input.parameters.contact_geometry == ContactPairParameters::Shape::manifold);
    const auto ids     = input.forest.boundary_ids(body, boundaries, section, key);
    auto       surface = std::make_unique<Surface>(input.solid, input.forest, body, ids, exact);
    if (surface->largest_face() == 0.)
      throw InputError(section, key, "", "these boundaries have no faces", "check the mesh.");
    return surface;
  }



  std::shared_ptr<Pairing>
  ContactPair::make_pairing(const double search_distance) const
  {
    return Touchstone::make_pairing({&input.parameters,
                                     input.obstacle,
                                     &input.solid,
                                     slave_surface.get(),
                                     master_surface.get(),
                                     search_distance});
  }



  void
  ContactPair::number_rows(const std::size_t first_index)
  {
    for (std::size_t k = 0; k < present.size(); ++k)
      present[k].index = first_index + k;
    committed = present;
  }



  void
  ContactPair::set_friction(const std::function<const FrictionRow *(std::size_t)> &friction)
  {
    for (ContactRow &row : present)
      row.friction = friction(row.index);
    committed = present;
  }



  std::vector<FrictionRow>
  ContactPair::friction_rows(const Mirrors &mirrors, const ContactParameters &contact) const
  {
    std::vector<FrictionRow> result(present.size());
    if (!input.parameters.friction)
      return result;
    const std::vector<std::array<Stencil, 2>> tangents = slave_surface->material_tangents();
    for (std::size_t k = 0; k < result.size(); ++k)
      {
        FrictionRow &row = result[k];
        row.law          = input.parameters.friction.get();
        if (const auto found = mirrors.find(present[k].slave); found != mirrors.end())
          row.mirrors = found->second;
        row.material_tangents = tangents[k];
        row.small             = small;
        row.exact             = (contact.friction == ContactParameters::Stick::exact);
        // alpha_t = 10 E A / h times the factor of the scene, doc/theory.md 6.1.
        row.alpha = 10. * contact.tangential_factor * present[k].stiffness;
      }
    return result;
  }



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
        pairing_method = make_pairing(std::max(depth + 2. * face, 4. * face));
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
    reference = present;

    // Stencils may refer to dofs that are not in the ghost layer.
    IndexSet needed = input.solid.relevant;
    for (const ContactRow &row : reference)
      for (const StencilEntry &entry : row.stencil)
        needed.add_range(dim * entry.node, dim * entry.node + dim);
    needed.compress();
    stencil_values.reinit(input.solid.owned, needed, input.solid.communicator);
  }



  void
  ContactPair::update_small_sliding(const Vector &u)
  {
    // Gap vector g_0 + M u with constant weights and normal. A tied pair keeps its initial gap:
    // only the relative displacement M u is constrained.
    stencil_values = u;
    for (std::size_t k = 0; k < present.size(); ++k)
      {
        ContactRow &row = present[k];
        if (!row.has_partner)
          continue;
        row.gap_vector = is_tied ? Tensor<1, dim>() : reference[k].gap_vector;
        for (unsigned int d = 0; d < dim; ++d)
          {
            row.gap_vector[d] += stencil_values(dim * row.slave + d);
            for (const StencilEntry &entry : row.stencil)
              row.gap_vector[d] -= entry.weight * stencil_values(dim * entry.node + d);
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



  void
  ContactPair::commit_positions()
  {
    if (!small)
      // Sweeps of the next step start from these positions (doc/theory.md 4, "Passing through").
      pairing_method->commit_positions(*displacement);
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
      // Before the search: a row in contact leaves an edge of the master surface later than an open
      // one arrives there, or it would alternate (doc/theory.md 5, "Cycles").
      row.was_active = active(row);
    if (!small)
      search(ghosted);
    else
      {
        if (!started)
          make_reference();
        update_small_sliding(u);
      }
    for (ContactRow &row : present)
      {
        // Current positions; the ghosted displacement also holds the owned dofs.
        for (unsigned int d = 0; d < dim; ++d)
          row.position[d] = ghosted(dim * row.slave + d);
        row.position += row.reference;
      }
    apply_overlap();
    started = true;
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
    for (ContactRow &row : present)
      // Such a derivative holds over much less than a Newton increment, so that the row is better
      // frozen in this iteration.
      if (row.derivative && changes_steeply(row))
        row.derivative.reset();
  }



  void
  ContactPair::commit()
  {
    commit_positions();
    // Derivatives are made anew in each iteration and need not be copied with the history, and
    // distances are not in checkpoints.
    for (ContactRow &row : present)
      {
        row.derivative.reset();
        row.away = 0.;
      }
    committed = present;
  }



  void
  ContactPair::rollback()
  {
    present = committed;
  }



  namespace
  {
    /** @brief References to the rows, the form in which save_rows() and load_rows() take them. */
    ContactRows
    references(const std::vector<ContactRow> &rows)
    {
      return ContactRows(rows.begin(), rows.end());
    }
  } // namespace



  void
  ContactPair::save(ArchiveWriter &archive) const
  {
    // The pairing remembers faces by keys that do not depend on the partition; rows find their own
    // by the number in this pair.
    const PairingMemory memory = pairing_method->memory();
    save_rows(archive, "rows", references(committed), [&](const ContactRow &row, RowPacker &pack) {
      const std::size_t k = &row - committed.data();
      pack(overlaps[k]);
      ContactRow::visit_state(row, pack);
      if (k < memory.of_rows.size() && memory.of_rows[k])
        pack.key(*memory.of_rows[k]);
    });
    // Sorted, so that the checkpoint does not depend on the order in which entries were made.
    KeyPairs faces(memory.of_faces.begin(), memory.of_faces.end());
    std::sort(faces.begin(), faces.end());
    archive.put_keys(input.parameters.section(), faces);
  }



  void
  ContactPair::load(const ArchiveReader &archive)
  {
    PairingMemory memory;
    load_rows(archive,
              "rows",
              references(present),
              [&](const ContactRow &row, RowUnpacker &unpack) {
                const std::size_t k = &row - present.data();
                unpack(overlaps[k]);
                ContactRow::visit_state(present[k], unpack);
                memory.of_rows.emplace_back();
                if (!unpack.keys().empty())
                  memory.of_rows.back() = unpack.keys().front();
              });
    const KeyPairs &faces = archive.keys(input.parameters.section());
    memory.of_faces.insert(faces.begin(), faces.end());
    committed = present;
    // Small sliding: the pairing is that of the reference state, made by the update before.
    if (small)
      return;
    pairing_method->commit_positions(*displacement);
    pairing_method->remember(memory);
  }
} // namespace Touchstone
