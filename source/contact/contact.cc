// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/contact/junctions.h>
#include <touchstone/contact/pairing/sets_of_points.h>
#include <touchstone/contact/shared_faces.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// Contact holds the pairs, their friction and the enforcement and calls them in the order in which
// they depend on each other: pairs make the geometry of the rows, the enforcement their status and
// forces, friction their slip. What is derived from this state is in results.cc and
// contact_checks.cc. All ranks call the same functions in the same order, since most are
// collective.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The force of a row along its present normal, or what is left of it, which is friction (and
     * shear of tied rows). */
    Tensor<1, dim>
    part_of_force(const ContactRow &row, const RowState &state, const ForcePart part)
    {
      const Tensor<1, dim> normal = (state.force * row.normal) * row.normal;
      switch (part)
        {
          case ForcePart::normal:
            return normal;
          case ForcePart::tangential:
            return state.force - normal;
          default:
            return state.force;
        }
    }
  } // namespace



  Contact::Contact(const std::vector<ContactPairInput> &inputs,
                   const ContactParameters             &parameters,
                   const Solid                         &solid,
                   const Mirrors                       &mirrors,
                   const Mirrors                       &supports)
    : solid(solid)
    , mirrors(mirrors)
    , supports(supports)
    , friction_rows(solid)
    , method(parameters.enforcement.make(parameters))
    , impulse_forces("impulse force")
  {
    // Rows are numbered over all pairs of this rank, so that the arrays of enforcement and friction
    // need one index only; friction has an entry for each row, also without a law.
    std::vector<FrictionRow> frictions;
    for (const ContactPairInput &input : inputs)
      {
        pairs.push_back(std::make_unique<ContactPair>(input));
        pairs.back()->number_rows(frictions.size());
        for (FrictionRow &row : pairs.back()->friction_rows(mirrors, parameters))
          frictions.push_back(std::move(row));
      }
    friction_rows.reinit(std::move(frictions));
    // Contact faces of other bodies and of other ranks refer to dofs beyond the ghost layer of the
    // mesh; one import per update serves all surfaces.
    IndexSet seen = solid.relevant;
    // Only now, for `friction_rows` must not move its elements once rows point to them.
    for (const auto &pair : pairs)
      {
        pair->set_friction([this](const std::size_t index) { return friction_rows.row(index); });
        for (const ContactRow &row : pair->rows())
          all_rows.push_back(row);
        seen.add_indices(pair->slave().far_unknowns().begin(), pair->slave().far_unknowns().end());
      }
    for (const auto &pair : pairs)
      if (pair->master())
        seen.add_indices(pair->master()->far_unknowns().begin(),
                         pair->master()->far_unknowns().end());
    held_of_pairs.resize(pairs.size());
    method->reinit(all_rows);
    impulse_forces.reinit(all_rows);
    cyclic.reinit(pairs, solid.communicator);
    // The order of commit, rollback and of checkpoints: first the geometry, to which the rest
    // refers.
    for (const auto &pair : pairs)
      parts.push_back(pair.get());
    for (Stateful *part : {static_cast<Stateful *>(&friction_rows),
                           static_cast<Stateful *>(method.get()),
                           static_cast<Stateful *>(&impulse_forces)})
      parts.push_back(part);
    if (pairs.empty())
      return;
    seen.compress();
    // One rank has all values: no list of them is needed.
    if (Utilities::MPI::n_mpi_processes(solid.communicator) == 1)
      ghosted.reinit(solid.owned, solid.communicator);
    else
      ghosted.reinit(solid.owned, seen, solid.communicator);
    import_ghosts.emplace(Vector(solid.owned, solid.communicator), ghosted);
  }



  void
  Contact::move(const Vector &u)
  {
    if (import_ghosts)
      (*import_ghosts)(u, ghosted);
  }



  void
  Contact::set_points(const unsigned int p, const std::vector<MaterialPoint> &points)
  {
    // Friction belongs to a point, and to the row of a node only as long as this is its row.
    for (const ContactRow &row : pairs[p]->rows())
      if (row.friction && row.between_nodes)
        {
          const MaterialPoint *const last       = point_of(pairs[p]->committed_points(), row.slave),
                                     *const now = point_of(points, row.slave);
          if (last && now && goes_on_from(*last, *now))
            friction_rows.recall(row);
          else if (last || now)
            friction_rows.forget(row);
        }
    pairs[p]->set_points(points);
  }



  void
  Contact::begin_again()
  {
    std::vector<std::vector<MaterialPoint>> points(pairs.size());
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (pairs[p]->takes_points())
        points[p] = pairs[p]->points();
    rollback();
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (pairs[p]->takes_points())
        set_points(p, points[p]);
    method->begin_step();
  }



  void
  Contact::update(const Vector &u, const double time)
  {
    present_time = time;
    move(u);
    for (const auto &pair : pairs)
      pair->update(u, ghosted, time, [this](const ContactRow &row) { return state(row).active(); });
    if (!started)
      remove_junction_rows(u);
    complete_cover(u);
    // Impulses belong to the committed step alone.
    impulse_forces.reinit_present();
    // Before the slip: a row that has lost its partner has none.
    method->update_partners(all_rows, !started);
    started = true;
    friction_rows.update(all_rows, u, time);
  }



  void
  Contact::remove_junction_rows(const Vector &u)
  {
    std::vector<std::set<Index>> nodes = junction_nodes(pairs, solid);
    held_of_pairs                      = held_nodes(pairs, supports, mirrors, solid);
    for (std::size_t p = 0; p < pairs.size(); ++p)
      nodes[p].insert(held_of_pairs[p].begin(), held_of_pairs[p].end());
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (!nodes[p].empty())
        {
          pairs[p]->remove_rows(nodes[p]);
          pairs[p]->update(u, ghosted, present_time, [](const ContactRow &) { return false; });
        }
  }



  void
  Contact::complete_cover(const Vector &u)
  {
    const std::vector<Vector> parts = cover_by_other_pairs(pairs, solid);
    if (parts.empty() && !shares_faces)
      return;
    shares_faces = !parts.empty();
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        const Vector part = shares_faces ? with_ghosts(parts[p]) : Vector();
        pairs[p]->complete_cover(u, shares_faces ? &part : nullptr, !started);
      }
  }



  void
  Contact::differentiate()
  {
    for (const auto &pair : pairs)
      pair->differentiate([this](const ContactRow &row) { return state(row).active(); });
    friction_rows.differentiate(all_rows);
  }



  void
  Contact::add_forces(Vector &force, const ForcePart part) const
  {
    std::vector<Index>  dofs;
    std::vector<double> values;
    for (const ContactRow &row : all_rows)
      if (state(row).active())
        {
          // Nodal forces M^T f: f on the slave node and -w_m f on the master nodes, so that action
          // equals reaction (doc/theory.md 3). Master nodes may belong to other ranks, hence
          // compress().
          const Tensor<1, dim> f = part_of_force(row, state(row), part);
          for (unsigned int d = 0; d < dim; ++d)
            if (f[d] != 0.)
              {
                dofs.push_back(dim * row.slave + d);
                values.push_back(f[d]);
                for (const StencilEntry &entry : row.stencil)
                  {
                    dofs.push_back(dim * entry.node + d);
                    values.push_back(-entry.weight * f[d]);
                  }
              }
        }
    force.add(dofs, values);
    force.compress(VectorOperation::add);
    solid.condense(force); // master nodes can hang
  }



  template <class OfRow>
  auto
  Contact::over_step(const ContactRow &row, const double weight, const OfRow &of) const
  {
    auto result = decltype(of(row, state(row)))();
    if (state(row).active())
      result += weight * of(row, state(row));
    if (const RowState &before = method->states().of_committed(row);
        weight != 1. && before.active())
      result += (1. - weight) * of(committed(row), before);
    return result;
  }



  // An obstacle is rigid and driven from outside: the work that it does on the slave body enters
  // the energy balance of dynamics, whereas contact of two bodies does no work from outside.
  double
  Contact::work_of_obstacles(const ForcePart part, const double weight) const
  {
    double work = 0.;
    for (const ContactRow &row : all_rows)
      {
        const ObstacleParameters *const obstacle = pair(row).obstacle();
        const Tensor<1, dim>            force =
          over_step(row,
                    obstacle != nullptr && obstacle->free.any() ? weight : 1.,
                    [part](const ContactRow &at, const RowState &of) {
                      return part_of_force(at, of, part);
                    });
        if (force.norm_square() > 0.)
          work += row.share * force * row.motion.since(committed(row).motion, contact_point(row));
      }
    return Utilities::MPI::sum(work, solid.communicator);
  }



  double
  Contact::work_of_overlaps(const double weight, const double from) const
  {
    double work = 0.;
    for (const ContactRow &row : all_rows)
      {
        const ContactPair &of   = pair(row);
        const std::size_t  k    = &row - of.rows().data();
        const double       gone = of.entered_overlap(k, from);
        if (gone != 0.)
          work -= gone * over_step(row, weight, [](const ContactRow &at, const RowState &of) {
                    return part_of_force(at, of, ForcePart::normal) * at.normal;
                  });
      }
    return Utilities::MPI::sum(work, solid.communicator);
  }



  void
  Contact::commit_positions()
  {
    for (const auto &pair : pairs)
      pair->commit_positions();
  }



  void
  Contact::record_friction(const ContactRow     &row,
                           const Tensor<1, dim> &force,
                           const Tensor<1, dim> &slip,
                           const double          path,
                           const double          work)
  {
    friction_rows.record(row, force, slip, path, work);
  }



  // Gaps are taken to change linearly over the step. Used to cut a step of dynamics at the first
  // impact; only rows that were open when it began can have one.
  double
  Contact::part_to_touch() const
  {
    double part = 1.;
    for (const ContactRow &row : all_rows)
      {
        const double before = committed(row).gap;
        if (method->states().of_committed(row).status == ContactStatus::open && row.has_partner &&
            before > 0. && row.gap < 0.)
          part = std::min(part, before / (before - row.gap));
      }
    return Utilities::MPI::min(part, solid.communicator);
  }



  void
  Contact::add_impulses(const std::vector<VelocityConstraint> &constraints, const double step)
  {
    for (const VelocityConstraint &constraint : constraints)
      // The impulse is taken from the velocity, see Impact, so the force on the slave node is
      // opposite; divided by the step it is the mean force of the impact.
      impulse_forces[all_rows[constraint.row]].force -=
        constraint.impulse / step * constraint.condition.force();
  }



  void
  Contact::commit()
  {
    // The history needs the forces and the geometry of the step that ends, so it is made before
    // anything is committed. Explicit steps follow it through their cycles: record_friction().
    if (!in_cycles)
      friction_rows.end_step(all_rows, method->states());
    for (Stateful *part : parts)
      part->commit();
  }



  void
  Contact::rollback()
  {
    for (Stateful *part : parts)
      part->rollback();
  }



  void
  Contact::save(ArchiveWriter &archive) const
  {
    for (const Stateful *part : parts)
      part->save(archive);
  }



  void
  Contact::load(const ArchiveReader &archive)
  {
    // The update that made the rows was in the reference state: surfaces have to be moved to the
    // committed displacement before the parts are loaded.
    present_time = archive.get<double>("committed time");
    move(archive.field("displacement"));
    for (const auto &pair : pairs)
      pair->set_displacement(ghosted);
    for (Stateful *part : parts)
      part->load(archive);
  }



  std::vector<Vector>
  Contact::fields(const bool of_committed) const
  {
    std::vector<Vector> result(n_fields * pairs.size(), Vector(solid.owned, solid.communicator));
    for (const ContactRow &present : all_rows)
      {
        // Those between nodes have no area and hence no density: they are found anew.
        if (present.between_nodes)
          continue;
        const ContactRow &row = of_committed ? committed(present) : present;
        const RowState   &now = of_committed ? method->states().of_committed(row) : state(row);
        // Densities over the area: nodal forces cannot be interpolated between meshes
        // (doc/theory.md 11, "History"). Status flags become numbers between 0 and 1 by
        // interpolation.
        Vector *const field = &result[n_fields * row.pair];
        if (now.active() && row.area > 0.)
          for (unsigned int d = 0; d < dim; ++d)
            field[0](dim * row.slave + d) = now.force[d] / row.area;
        field[1](dim * row.slave)     = now.active();
        field[1](dim * row.slave + 1) = (now.status == ContactStatus::stick);
        if (row.friction && row.area > 0.)
          {
            const FrictionHistory &history =
              of_committed ? friction_rows.committed_history(row) : row.friction->history;
            field[2](dim * row.slave)     = history.slip_length;
            field[2](dim * row.slave + 1) = history.work / row.area;
          }
      }
    for (Vector &field : result)
      field.compress(VectorOperation::insert);
    return result;
  }



  void
  Contact::adopt(const std::vector<Vector> &fields, const bool history)
  {
    for (const ContactRow &row : all_rows)
      {
        if (row.between_nodes)
          continue;
        const Vector *const field = &fields[n_fields * row.pair];
        Tensor<1, dim>      force;
        for (unsigned int d = 0; d < dim; ++d)
          force[d] = row.area * field[0](dim * row.slave + d);
        // More than half of the neighbourhood decides about the status of a new node.
        const ContactStatus status = field[1](dim * row.slave) < 0.5 ? ContactStatus::open
                                     : row.friction && field[1](dim * row.slave + 1) >= 0.5
                                       ? ContactStatus::stick
                                       : ContactStatus::slip;
        method->adopt(row, status, force);
        if (row.friction && history)
          friction_rows.adopt(row,
                              state(row).force - state(row).lambda * row.normal,
                              field[2](dim * row.slave),
                              row.area * field[2](dim * row.slave + 1));
      }
    // The fields are the committed state: the step on the new mesh begins with it, and a rollback
    // leads here.
    if (history)
      for (Stateful *part : parts)
        part->commit();
  }



  Vector
  Contact::with_ghosts(const Vector &owned) const
  {
    if (!import_ghosts)
      return solid.ghosted(owned);
    Vector result;
    result.reinit(ghosted);
    (*import_ghosts)(owned, result);
    return result;
  }



  unsigned int
  Contact::n_searches() const
  {
    unsigned int sum = 0;
    for (const auto &pair : pairs)
      sum += pair->n_searches();
    return sum;
  }
} // namespace Touchstone
