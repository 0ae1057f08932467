// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/base/reduction.h>
#include <touchstone/drive/step_problem.h>

#include <algorithm>
#include <cmath>

// One Newton iteration of an implicit step (doc/theory.md 5): residual() updates the contact
// geometry, the forces and the active set, linearize() makes the linear system with all conditions
// (StepSystem), solve() solves it and update() applies the increment.
namespace Touchstone
{
  using namespace dealii;

  // The order is fixed: geometry at u, forces of the bodies, forces of contact from these, the
  // residual with both, and last the active set, which is judged by the contact forces.
  NewtonState
  StepProblem::residual(const unsigned int damping)
  {
    NewtonState state;
    update_geometry(state);
    Vector without_contact(solid.zero_vector());
    balance(without_contact);
    contact.enforcement().recover(contact, without_contact, system->conditions());
    judge_balance(without_contact, state);
    update_active_set(damping, state);
    // Uzawa's outer iteration augments forces once they are in balance.
    if (state.changes == 0 && state.prescribed && balanced(state, scene.newton))
      contact.enforcement().balanced(contact);
    forcing_term.update(state, system->linear_solver().symmetric_only() && solid.linear());
    return state;
  }



  void
  StepProblem::update_geometry(NewtonState &state)
  {
    {
      TimerOutput::Scope scope(timer, "search");
      contact.update(u, time);
    }
    // See begin_step().
    if (touch_unknown)
      touch = contact.part_to_touch();
    touch_unknown = false;
    // Prescribed displacements first: they take precedence over contact, and the residual needs
    // their directions. Contact is added in linearize().
    missed = system->prescribe(time, u);
    // Exact up to round-off after the first full increment; a shortened increment misses a part.
    state.prescribed = missed <= scene.newton.gap_tolerance * system->smallest_cell();
  }



  void
  StepProblem::balance(Vector &without_contact)
  {
    {
      TimerOutput::Scope scope(timer, "assembly");
      // solve() clears them for iterative solvers. Copies of a layout: to make one takes messages.
      for (Vector *const vector : {&internal, &applied})
        if (vector->size() == 0)
          *vector = Vector(solid.zero_vector());
      solid.internal_force(u, internal);
      if (boundary_conditions.depends_on_displacement())
        boundary_conditions.external_force(time, u, external);
    }
    // Time integration weighs the forces at both ends of the step and adds inertia. Forces on
    // hanging nodes count for the nodes that these follow.
    integration->balance(u, external, internal, applied);
    if (springs.act())
      {
        const Vector of_springs = springs.forces(u);
        spring_force            = of_springs.l2_norm();
        sum_of_springs          = of_springs.l1_norm();
        applied += of_springs;
      }
    without_contact = applied;
    solid.condense(without_contact);
  }



  void
  StepProblem::judge_balance(const Vector &without_contact, NewtonState &state)
  {
    // Relative residual, equation (13): the scale is the largest of internal, external, contact and
    // inertial forces.
    Vector contact_force(solid.zero_vector());
    contact.add_forces(contact_force);
    unbalanced = without_contact;
    unbalanced += contact_force;

    // Forces along prescribed directions are reactions of the supports and no residual.
    Vector free(unbalanced);
    system->remove_supported(free);
    // Squares of this rank, then sums over all.
    const Enforcement &enforcement = contact.enforcement();
    double             of_bodies = squared_on_rank(internal), of_loads = squared_on_rank(external),
           of_contact = squared_on_rank(contact_force), inertia = integration->inertia_squared(),
           left = squared_on_rank(free), motion = integration->round_off_squared(u),
           springs = enforcement.round_off_squared(contact.rows(), extent),
           gaps    = enforcement.round_off_of_gaps_squared(contact.rows(), extent);
    Reduction all;
    for (double *const square :
         {&of_bodies, &of_loads, &of_contact, &inertia, &left, &motion, &springs, &gaps})
      all.sum(*square);
    all.over(solid.communicator);
    const double present   = std::sqrt(std::max({of_bodies, of_loads, of_contact, inertia}));
    double       round_off = solid.round_off(u) + std::sqrt(motion) + std::sqrt(springs);
    // Bodies that only touch, at rest or pushed along, have the forces that round-off makes of
    // their gaps. How exactly a linear solver meets these says nothing.
    const double of_gaps = std::sqrt(gaps);
    if (present <= of_gaps)
      round_off = std::max(round_off, of_gaps);
    // Where forces vanish, at the end of contact for example, the present forces are round-off and
    // no scale for the residual; then a thousandth of the largest forces of earlier steps is used.
    // The forces of a body in free flight are round-off from the start: force_scale excludes them
    // from these.
    constexpr double small_force = 1e-3, largest_round_off = 1e-6;
    force_scale        = largest_round_off * present > round_off ? present : 0.;
    const double scale = std::max(present, small_force * largest_force_scale);
    spring_share       = scale > 0. ? spring_force / scale : 0.;
    carried_by_springs = scale > 0. ? present / scale * sum_carried_by_springs(contact_force) : 0.;
    state.force        = std::sqrt(left);
    state.residual     = scale > 0. ? state.force / scale : 0.;
    relative_residual  = state.residual;
    state.round_off    = scale > 0. ? round_off / scale : 0.;
    // A large round-off is plausible only before the first forces act. Later on it must not hide a
    // residual, so that the allowance is bounded.
    if (largest_force_scale > 0.)
      state.round_off = std::min(state.round_off, largest_round_off);
  }



  // Springs act on all nodes of a body, contact on few: only sums tell what is missing of a
  // resultant.
  double
  StepProblem::sum_carried_by_springs(const Vector &contact_force) const
  {
    if (!springs.act())
      return 0.;
    const double present =
      std::max({internal.l1_norm(), external.l1_norm(), contact_force.l1_norm()});
    return present > 0. ? sum_of_springs / present : 0.;
  }



  void
  StepProblem::update_active_set(const unsigned int damping, NewtonState &state)
  {
    const ActiveSetUpdate set = contact.enforcement().update_active_set(
      contact, scene.newton.gap_tolerance, damping, balanced(state, scene.newton));
    const auto places = [](const std::vector<const ContactRow *> &rows) {
      RowPlaces result;
      for (const ContactRow *row : rows)
        result.push_back(
          {{row->reference[0], row->reference[1], row->reference[2], double(row->pair)}});
      return result;
    };
    changed_rows = places(set.changed);
    // Rows that go to and fro, with an active set that does so more slowly, may rest in between.
    constexpr unsigned int few = 8;
    if (set.exchanges > 0 || ++exchanged_since > few)
      {
        exchanged_rows  = places(set.exchanged);
        exchanges       = set.exchanges;
        exchanged_since = 0;
      }
    state.gap       = set.gap;
    state.active    = set.active;
    state.changes   = set.changes;
    state.judged    = set.judged;
    state.signature = set.signature;
    state.exchanges = exchanges;
  }



  void
  StepProblem::linearize()
  {
    TimerOutput::Scope scope(timer, "assembly");
    forget_increment();
    if (!integration->dynamic())
      strayed.note(system->loose_bodies(), solid, u, committed_u);
    if (!solid.linear())
      {
        // Linear bodies have a constant stiffness, which was assembled in the constructor
        // (doc/theory.md 2.1).
        solid.assemble(u, system->linear_solver().symmetric_only());
        ++assemblies;
      }
    system->assemble({time,
                      u,
                      applied,
                      unbalanced,
                      relative_residual,
                      forcing_term.tolerance(),
                      forcing_term.slow(),
                      springs});
  }



  int
  StepProblem::solve()
  {
    TimerOutput::Scope scope(timer, "linear solver");
    // The linear solver takes most memory of a run; the next residual makes these forces anew.
    if (system->applies_operator())
      {
        internal.clear();
        applied.clear();
      }
    const int iterations = system->solve(solved_increment);
    check_increment();
    system->recover(solved_increment);
    return iterations;
  }



  void
  StepProblem::update()
  {
    // The strain energy is not defined for det F <= 0, so the increment is halved until all cells
    // are admissible (doc/theory.md 2.2). The multipliers belong to the end of the full increment
    // and are not scaled.
    admissible_part = 1.;
    Vector trial(u);
    trial += solved_increment;
    for (unsigned int halvings = 0; !solid.admissible(trial); ++halvings)
      {
        // The load stepping then cuts the step.
        if (halvings == 6)
          throw InvertedCells("a cell turns inside out (det F <= 0) or beyond the limit of its "
                              "law, even with 1/64 of a Newton increment: " +
                              inverted_place(trial));
        admissible_part *= 0.5;
        trial = u;
        trial.add(admissible_part, solved_increment);
      }
    before_increment.swap(u);
    u.swap(trial);
    contact.enforcement().update(contact,
                                 scene.newton.line_search != NewtonParameters::LineSearch::none);
  }



  void
  StepProblem::forget_increment()
  {
    before_increment.clear();
    solved_increment.clear();
    contact.enforcement().forget_update();
  }



  void
  StepProblem::shorten(const double fraction)
  {
    u = before_increment;
    u.add(fraction * admissible_part, solved_increment);
    contact.enforcement().shorten(contact,
                                  fraction < 1. ? fraction * admissible_part
                                                : 1.); // the full increment, as in update()
  }
} // namespace Touchstone
