// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/cyclic_constraints.h>
#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/contact/enforcement/refused_conditions.h>
#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/contact/enforcement/undetermined_stick.h>
#include <touchstone/contact/friction/friction.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>

// What all enforcements share: they own status and force of each row and lead these through the
// Newton iteration (recover, enforce, add_friction, update), its line search (shorten), and the
// commit or rollback of the step. The strategy of the active set is in active_set.cc.
namespace Touchstone
{
  using namespace dealii;

  Enforcement::Enforcement()
    : row_states("contact state")
    , arrays({&row_states})
  {
  }



  void
  Enforcement::reinit(const ContactRows &rows)
  {
    for (RowArrayBase *array : arrays)
      array->reinit(rows);
  }



  // The memory of a derived class, for example the augmented force of a spring, goes with the
  // force: a row that closes again must not begin with it.
  void
  Enforcement::clear(const ContactRow &row)
  {
    row_states[row].clear_force();
    for (RowArrayBase *array : arrays)
      if (array != &row_states)
        array->reset(row);
  }



  namespace
  {
    /** Whether a node at rest bears more friction than one that slides: if rows of a body at rest
     * began in slip, they would never know. */
    bool
    holds_more_at_rest(const ContactRow &row)
    {
      if (!row.friction)
        return false;
      const double force = row.stiffness * row.size;
      return row.friction->cone(force, /*sliding=*/false).force >
             row.friction->cone(force, /*sliding=*/true).force;
    }
  } // namespace



  void
  Enforcement::begin_step()
  {
    row_states.for_each([](RowState &state) { state.spring = SpringStiffness(); });
  }



  void
  Enforcement::update_partners(const ContactRows &rows, const bool first)
  {
    for (const ContactRow &row : rows)
      {
        ContactStatus &status = row_states[row].status;
        if (!row.has_partner)
          status = ContactStatus::no_partner;
        else if (status == ContactStatus::no_partner)
          // A tied node gets its row back where a joint with others has opened.
          status = row.tied ? ContactStatus::tied : ContactStatus::open;
        if (!first || status != ContactStatus::open)
          continue;
        if (row.tied)
          status = ContactStatus::tied;
        // A surface that just touches starts in contact: otherwise a body that only rests on
        // another would have no support in the first iteration.
        else if (row.gap < Tolerances::touches_at_start * row.size)
          status = holds_more_at_rest(row) ? ContactStatus::stick : ContactStatus::slip;
      }
  }



  void
  Enforcement::recover(const Contact         &contact,
                       const Vector          &unbalanced,
                       const ConstraintGraph &graph)
  {
    if (contact.friction().active())
      {
        const std::vector<bool> undetermined = undetermined_stick(contact, graph);
        for (const ContactRow &row : contact.rows())
          if (row.friction)
            row_states[row].friction->shared = undetermined[row.index];
      }
    evaluate(contact, unbalanced, graph);
  }



  void
  Enforcement::enforce(const Contact &contact, ConstraintGraph &graph, LinearSystem &system)
  {
    // Before any condition is added to the graph: of a cycle between pairs the rows of the latest
    // pair are left out and carry no force (doc/theory.md 6, "Cyclic constraints").
    redundant = contact.cyclic_constraints().find(contact, graph, cycle_threshold());
    for (const ContactRow &row : contact.rows())
      {
        row_states[row].redundant = redundant.rows[row.index];
        if (row_states[row].redundant)
          clear(row);
      }
    constrain(contact, graph, system);
  }



  void
  Enforcement::add_friction(const Contact &contact, LinearSystem &system)
  {
    RowTerms terms(system);
    for (const ContactRow &row : contact.rows())
      {
        RowState &state = row_states[row];
        if (!state.active())
          continue;
        // All conditions of the row were refused: supports or other rows determine its relative
        // motion, and it carries no force.
        if (state.dropped())
          {
            clear(row);
            continue;
          }
        // The direction and stiffness of this linear system are the base of the next trial force in
        // slip, doc/theory.md 6.1, equation (17).
        if (row.friction)
          {
            state.friction->last_direction = state.friction->direction;
            state.friction->last_tangent   = state.friction->tangent;
          }
        terms.add_row(row, state);
      }
    terms.finish();
  }



  void
  Enforcement::update(const Contact &contact, const bool may_shorten)
  {
    if (may_shorten)
      for (RowArrayBase *array : arrays)
        array->keep();
    set_forces(contact);
    after_solve = true;
  }



  void
  Enforcement::shorten(const Contact &contact, const double fraction)
  {
    // Forces that are dofs of the linear system take the same fraction of their change as the
    // displacements. Those of springs and elimination are evaluated from the displacement and from
    // the states before the update.
    for (RowArrayBase *array : arrays)
      array->restore();
    set_forces(contact);
    after_solve = true;
    for (const ContactRow &row : contact.rows())
      {
        RowState       &state  = row_states[row];
        const RowState &before = row_states.of_kept(row);
        // The whole update is repeated from the kept states, because a derived class may set more
        // than the force; then the change is scaled.
        state.force  = before.force + fraction * (state.force - before.force);
        state.lambda = before.lambda + fraction * (state.lambda - before.lambda);
        if (row.friction)
          state.friction->base =
            before.friction->base + fraction * (state.friction->base - before.friction->base);
      }
  }



  void
  Enforcement::forget_update()
  {
    for (RowArrayBase *array : arrays)
      array->forget();
  }



  void
  Enforcement::adopt(const ContactRow &row, const ContactStatus status, const Tensor<1, dim> &force)
  {
    clear(row);
    RowState &state = row_states[row];
    if (!row.has_partner)
      return;
    if (!row.tied)
      state.status = status;
    if (state.active())
      {
        // The interpolated traction is an initial guess or a history of the new mesh. Its direction
        // is that of the slip: a row that slips has no other state (doc/theory.md 6.1).
        state.force                     = force;
        state.lambda                    = force * row.normal;
        const Tensor<1, dim> tangential = force - state.lambda * row.normal;
        if (row.friction)
          {
            state.friction->base = tangential;
            if (state.status == ContactStatus::slip && tangential.norm() > 0.)
              state.friction->last_direction = tangential / tangential.norm();
          }
        adopted(row);
      }
  }



  void
  Enforcement::record_refused_stick(const RefusedConditions &refused,
                                    const Contact           &contact,
                                    const ConstraintGraph   &graph)
  {
    const std::vector<bool> can_be_met =
      refused.can_be_met(graph, contact.solid_model().owned, contact.communicator());
    for (std::size_t k = 0; k < refused.all().size(); ++k)
      {
        const auto &[row, condition] = refused.all()[k];
        row_states[*row].record(condition, false, can_be_met[k]);
      }
  }



  double
  Enforcement::round_off_of_gaps_squared(const ContactRows &rows, const double length) const
  {
    // Positions of magnitude `length` are known up to machine precision; a gap is the
    // difference of a few of them.
    double sum = 0.;
    for (const ContactRow &row : rows)
      if (row_states[row].active())
        sum += std::pow(4. * std::numeric_limits<double>::epsilon() * length * row.stiffness, 2);
    return sum;
  }



  void
  Enforcement::commit()
  {
    for (RowArrayBase *array : arrays)
      array->commit();
  }



  void
  Enforcement::rollback()
  {
    after_solve = false;
    for (RowArrayBase *array : arrays)
      array->rollback();
  }



  void
  Enforcement::save(ArchiveWriter &archive) const
  {
    for (const RowArrayBase *array : arrays)
      array->save(archive);
  }



  void
  Enforcement::load(const ArchiveReader &archive)
  {
    for (RowArrayBase *array : arrays)
      array->load(archive);
  }
} // namespace Touchstone
