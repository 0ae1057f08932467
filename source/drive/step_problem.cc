// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/contact/contact_checks.h>
#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/drive/step_problem.h>
#include <touchstone/scene/pair_input.h>
#include <touchstone/solid/bodies.h>
#include <touchstone/solid/hyperelastic_law.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <set>
#include <tuple>

// One implicit step as Newton's method sees it (doc/theory.md 5). In each iteration residual()
// updates the contact geometry, the forces and the active set, linearize() makes the linear system
// with all conditions, solve() solves it and update() applies the increment. A converged step is
// kept by try_commit() or taken back by rollback(). Checks of its outcome are in step_checks.cc,
// checkpoints in restart.cc. All functions are collective.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Whether contact is linearised consistently from the first iteration of a step on. With
     * friction slip makes the system unsymmetric anyway, so that the derivatives cost no other
     * factorisation. Without friction a symmetric factorisation saves more than the additional
     * iterations cost; and with an iterative solver (@p iterates) the derivatives of averaged rows
     * cost as much as all the rest (doc/theory.md 5, "Linearisation"; doc/benchmarks.md, "Frozen
     * or consistent"). */
    bool
    consistent(const Scene &scene, const bool iterates)
    {
      return scene.contact.linearisation == ContactParameters::Linearisation::consistent ||
             (scene.contact.linearisation == ContactParameters::Linearisation::automatic &&
              scene.has_friction() && !iterates);
    }



    /** A value at a quadrature point of a body, and where that is in the reference state. */
    struct ExtremePoint
    {
      double     value = std::numeric_limits<double>::max();
      Point<dim> position;
      double     body = 0.;

      /** By position where values are equal, so that the order does not depend on the partition. */
      bool
      operator<(const ExtremePoint &other) const
      {
        return std::tie(value, position[0], position[1], position[2]) <
               std::tie(other.value, other.position[0], other.position[1], other.position[2]);
      }

      /** Body and position in words. */
      std::string
      place(const Scene &scene) const
      {
        char text[80];
        std::snprintf(text,
                      sizeof(text),
                      "(%.4g, %.4g, %.4g)",
                      position[0] + 0.,
                      position[1] + 0.,
                      position[2] + 0.);
        return "body '" + scene.bodies[static_cast<unsigned int>(body)].name + "' at " + text;
      }
    };



    /** The point of bodies with a nonlinear law where a function of body and deformation gradient
     * is smallest. Collective. */
    ExtremePoint
    smallest(const Scene                                                       &scene,
             const Solid                                                       &solid,
             const Vector                                                      &u,
             const std::function<double(unsigned int, const Tensor<2, dim> &)> &function)
    {
      Vector ghosted(solid.owned, solid.relevant, solid.communicator);
      ghosted = u;
      const QGauss<dim>           quadrature(solid.fe.degree + 1);
      FEValues<dim>               values(solid.mapping,
                           solid.fe,
                           quadrature,
                           update_gradients | update_quadrature_points);
      std::vector<Tensor<2, dim>> gradients(quadrature.size());
      ExtremePoint                found;
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && !scene.bodies[cell->material_id()].material.linear())
          {
            values.reinit(cell);
            values[FEValuesExtractors::Vector(0)].get_function_gradients(ghosted, gradients);
            for (const unsigned int q : values.quadrature_point_indices())
              {
                const Tensor<2, dim> F = gradients[q] + unit_symmetric_tensor<dim>();
                found                  = std::min(found,
                                 {function(cell->material_id(), F),
                                                   values.quadrature_point(q),
                                                   static_cast<double>(cell->material_id())});
              }
          }
      const std::vector<double> mine{
        found.value, found.position[0], found.position[1], found.position[2], found.body};
      for (const auto &of : Utilities::MPI::all_gather(solid.communicator, mine))
        found = std::min(found, {of[0], Point<dim>(of[1], of[2], of[3]), of[4]});
      return found;
    }



    /** Where a body is compressed so far that its law resists further compression no longer:
     * n_i N_J A_iJkL n_k N_L < 0 with the direction N of the largest compression and n = F N /
     * |F N|. Laws for small strains do so (doc/theory.md 2.2), and then no step size helps. Empty
     * if there is no such point. Collective. */
    std::string
    unstable_place(const Scene &scene, const Solid &solid, const Vector &u)
    {
      std::vector<std::shared_ptr<HyperelasticLaw>> laws;
      for (const BodyParameters &body : scene.bodies)
        laws.push_back(HyperelasticRegistry::knows(body.material.law.name)
                         ? body.material.law.make<HyperelasticRegistry>(body.material)
                         : nullptr);
      const auto resistance = [&](const unsigned int body, const Tensor<2, dim> &F) {
        if (!laws[body] || !(determinant(F) > 0.))
          return std::numeric_limits<double>::max();
        // In descending order.
        const auto           eigen = eigenvectors(symmetrize(transpose(F) * F));
        const Tensor<1, dim> N     = eigen[dim - 1].second;
        const Tensor<1, dim> n     = F * N / (F * N).norm();
        const Tensor<2, dim> nN    = outer_product(n, N);
        return scalar_product(nN, double_contract<2, 0, 3, 1>(laws[body]->tangent(F), nN));
      };
      const ExtremePoint found = smallest(scene, solid, u, resistance);
      return found.value < 0. ? found.place(scene) : "";
    }
  } // namespace



  StepProblem::StepProblem(const Scene  &scene,
                           const Forest &forest,
                           Solid        &solid,
                           TimerOutput  &timer)
    : scene(scene)
    , solid(solid)
    , timer(timer)
    , boundary_conditions(forest, solid)
    , contact(pair_inputs(scene, forest, solid),
              scene.contact,
              solid,
              boundary_conditions.mirrors())
    , solver(LinearSolverRegistry::make(scene.linear_solver.type, scene.linear_solver))
    , u(solid.owned, solid.communicator)
    , committed_u(u)
    , external(u)
    , internal(u)
    , applied(u)
    , unbalanced(u)
    , increment(u)
    , solved_increment(u)
    , before_increment(u)
    , forcing_term(scene.linear_solver.tolerance,
                   scene.newton.residual_tolerance,
                   scene.has_friction())
  {
    {
      TimerOutput::Scope scope(timer, "assembly");
      solid.assemble();
      ++assemblies;
    }
    modes = std::make_unique<RigidBodyModes>(solid);
    // Slave nodes whose contact may open and close: some schemes move their mass to neighbours, so
    // that no momentum is concentrated in the contact surface. Tied nodes never do.
    std::set<Index> slaves;
    for (const ContactRow &row : contact.rows())
      if (!row.tied)
        slaves.insert(dim * row.slave);
    integration = TimeIntegration::make(scene.time_integration,
                                        scene.load_stepping.end_time / scene.load_stepping.steps,
                                        solid,
                                        slaves,
                                        committed_u);
    // Three lengths: of the smallest cell, against which missed prescribed displacements are
    // judged; of the largest coordinate, which sets the round-off of positions; and of the box
    // around all bodies, beyond which no increment makes sense.
    length = GridTools::minimal_cell_diameter(solid.dof_handler.get_triangulation());
    length = Utilities::MPI::min(length, solid.communicator);
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        extent = std::max(extent, cell->center().norm());
    extent                 = Utilities::MPI::max(extent, solid.communicator);
    const auto       boxes = body_boxes(solid);
    BoundingBox<dim> all(boxes.front());
    for (const auto &box : boxes)
      all.merge_with(box);
    diameter = all.get_boundary_points().first.distance(all.get_boundary_points().second);
  }



  std::vector<std::string>
  StepProblem::start()
  {
    u = committed_u = integration->initial_displacement();
    // Formulas without a finite value at time 0 are input errors and reported before the run.
    boundary_conditions.external_force(0., u, external);
    boundary_conditions.displacements(0.);
    {
      TimerOutput::Scope scope(timer, "search");
      // Contact starts in the initial displacement and is committed at once: the first step may
      // fail and has to be able to return here.
      contact.update(u, 0.);
      contact.commit();
      remember_contact();
    }
    // In statics a rigid motion without support has no equilibrium; in dynamics inertia resists it.
    if (!integration->dynamic())
      check_bodies_without_support();
    else
      {
        solid.internal_force(u, internal);
        graph.clear();
        boundary_conditions.prescribe(0., u, graph);
        // The velocity that a support prescribes is the difference quotient of its displacement
        // over a time that is short compared with a step. Components across the prescribed
        // direction keep their initial velocity.
        const double instant  = 1e-6 * scene.load_stepping.end_time / scene.load_stepping.steps;
        const auto   set_rate = [&](Vector &velocity) {
          const auto now  = boundary_conditions.displacements(0.),
                     soon = boundary_conditions.displacements(instant);
          for (std::size_t k = 0; k < now.size(); ++k)
            {
              double miss = (soon[k].value - now[k].value) / instant;
              for (unsigned int d = 0; d < dim; ++d)
                miss -= now[k].direction[d] * velocity(dim * now[k].node + d);
              for (unsigned int d = 0; d < dim; ++d)
                velocity(dim * now[k].node + d) += miss * now[k].direction[d];
            }
          velocity.compress(VectorOperation::add);
        };
        integration->start(external, internal, {set_rate, [&](Vector &force) {
                                                  remove_supported(force);
                                                }});
      }
    return start_report(contact);
  }



  // Supports can act along any direction of a node, so their part is projected out node by node and
  // not by components (doc/theory.md 5, "Convergence").
  void
  StepProblem::remove_supported(Vector &forces) const
  {
    for (Index k = 0; k < solid.owned.n_elements() / dim; ++k)
      {
        const Index    node = solid.owned.nth_index_in_set(dim * k) / dim;
        Tensor<1, dim> force;
        for (unsigned int d = 0; d < dim; ++d)
          force[d] = forces.begin()[dim * k + d];
        force = graph.free_part(node, force);
        for (unsigned int d = 0; d < dim; ++d)
          forces.begin()[dim * k + d] = force[d];
      }
  }



  void
  StepProblem::begin_step(const double t)
  {
    time = t;
    contact.enforcement().begin_step();
    integration->begin_step(time, u);
    // Only the first residual of the step, at the first guess of its end, estimates when the first
    // gap closes: later iterates already obey contact.
    touch_unknown = integration->dynamic();
    forcing_term.begin_step();
    loose_bodies.clear();
    boundary_conditions.external_force(time, u, external);
    stabilised.clear();
    // Last: the functions above use the committed state of the material.
    solid.begin_step(time - committed_time);
  }



  unsigned int
  StepProblem::solve(const double            t,
                     const NewtonParameters &parameters,
                     const Newton::Observer &observer)
  {
    begin_step(t);
    return Newton(parameters).solve(*this, observer);
  }



  double
  StepProblem::try_commit(const double smallest_part)
  {
    double part = 1.;
    with_forces([&](const StepForces &forces) {
      // The energies are known only with the forces at the end; in dynamics they decide whether the
      // step is short enough. A part below the smallest one is not worth a repetition: the step is
      // then kept as it is.
      const Energies end = integration->end_step(u, forces);
      if (smallest_part <= 1.)
        part = acceptable_part(end);
      if (part < smallest_part)
        part = 1.;
      if (part == 1.)
        keep(forces, end);
    });
    return part;
  }



  void
  StepProblem::keep(const StepForces &forces, const Energies &end)
  {
    // First, because the time integration refers to committed_u and keeps no copy: it must still
    // be the displacement with which the step began.
    integration->commit(u, forces, end);
    if (forces.velocity_constraints != nullptr)
      contact.add_impulses(*forces.velocity_constraints, time - committed_time);
    committed_u    = u;
    committed_time = time;
    solid.commit();
    contact.commit();
    largest_force_scale = std::max(largest_force_scale, force_scale);
    remember_contact();
  }



  void
  StepProblem::with_forces(const std::function<void(const StepForces &)> &use)
  {
    // Statics has no energy balance and needs none of these forces.
    if (!integration->dynamic())
      return use(StepForces());
    Vector normal(solid.owned, solid.communicator), tangential(normal), support(unbalanced);
    contact.add_forces(normal, ForcePart::normal);
    contact.add_forces(tangential, ForcePart::tangential);
    // What the supports add is what is missing to the balance of the nodes.
    support *= -1.;
    std::vector<VelocityConstraint> constraints;
    // Impacts without rebound change velocities, and need the conditions of the nodes in contact.
    const bool plastic = scene.time_integration.plastic_impacts();
    if (plastic && time > committed_time)
      constraints = velocity_constraints(contact, graph, time - committed_time);
    use({&external,
         &internal,
         &normal,
         &tangential,
         &support,
         plastic ? &constraints : nullptr,
         [this](Vector &force) { remove_supported(force); },
         contact.work_of_obstacles(ForcePart::normal),
         contact.work_of_obstacles(ForcePart::tangential)});
  }



  double
  StepProblem::acceptable_part(const Energies &end) const
  {
    if (!integration->dynamic())
      return 1.;
    const TimeIntegrationParameters &parameters = scene.time_integration;
    // Energy that nothing has supplied comes from the discretisation in time; a shorter step
    // reduces it, hence the exception.
    if (end.gain() > parameters.gain_tolerance * end.largest)
      throw EnergyGain("energy " + std::to_string(end.gain() / end.largest) +
                       " times the largest so far came from nowhere ('Time integration/Gain "
                       "tolerance')");
    // An impact in the middle of a step: repeat it such that it ends where the first gap closes, as
    // estimated from the first guess.
    const double change = end.contact - integration->committed_energies().contact;
    const bool   impact = parameters.adapts_to_impacts() && touch < 1. - 1e-6 &&
                        std::abs(change) > parameters.impact_tolerance * end.largest;
    return impact ? touch : 1.;
  }



  void
  StepProblem::rollback()
  {
    u = committed_u;
    integration->rollback();
    solid.rollback();
    contact.rollback();
  }



  StepTransfer
  StepProblem::transfer() const
  {
    StepTransfer result;
    // Both states: the committed one as history, the present one as initial guess on the new mesh
    // (doc/theory.md 11, "History"). The order of the fields is the interface to adopt().
    for (const bool of_committed : {true, false})
      {
        result.fields.push_back(of_committed ? committed_u : u);
        for (Vector &field : contact.fields(of_committed))
          result.fields.push_back(std::move(field));
      }
    for (const Vector *field : integration->rates())
      result.fields.push_back(*field);
    result.momenta             = integration->momenta();
    result.committed_time      = committed_time;
    result.energies            = integration->committed_energies();
    result.largest_force_scale = largest_force_scale;
    result.counts              = {linear_counts(), assemblies, n_searches()};
    return result;
  }



  void
  StepProblem::adopt(const StepTransfer &before, const double t)
  {
    earlier             = before.counts.linear;
    earlier_searches    = before.counts.searches;
    largest_force_scale = before.largest_force_scale;
    committed_time      = before.committed_time;
    assemblies += before.counts.assemblies;
    // At time 0 the energies are those that the first velocities mean on this mesh.
    if (committed_time > 0.)
      integration->resume(committed_time, before.energies);

    const std::vector<Vector> &fields  = before.fields;
    const std::size_t          n_rates = integration->rates().size();
    // Fields: committed displacement and contact, the same of the present state, and the rates at
    // the end; see transfer().
    const auto middle = fields.begin() + (fields.size() - n_rates) / 2;
    const auto rates  = fields.end() - n_rates;
    // Before the first step there is no history but what start() makes.
    if (committed_time > 0.)
      {
        committed_u = u = fields.front();
        // Twice: first the committed state becomes the history, then the present one the initial
        // guess.
        contact.update(u, committed_time);
        contact.adopt({fields.begin() + 1, middle}, true);
        if (integration->dynamic())
          {
            boundary_conditions.external_force(committed_time, u, external);
            solid.internal_force(u, internal);
            unbalanced = 0.;
          }
        with_forces([&](const StepForces &forces) {
          integration->adopt({rates, fields.end()}, forces, before.momenta);
        });
      }
    u = *middle;
    contact.update(u, t);
    contact.adopt({middle + 1, rates}, false);
  }



  LinearSolverCounts
  StepProblem::linear_counts() const
  {
    LinearSolverCounts        sum = earlier;
    const LinearSolverCounts &now = solver->counts();
    sum.solves += now.solves;
    sum.iterations += now.iterations;
    sum.factorisations += now.factorisations;
    sum.preconditioner_setups += now.preconditioner_setups;
    return sum;
  }



  // The order is fixed: geometry at u, forces of the bodies, forces of contact from these, the
  // residual with both, and last the active set, which is judged by the contact forces.
  NewtonState
  StepProblem::residual(const unsigned int damping)
  {
    NewtonState state;
    update_geometry(state);
    Vector without_contact(solid.owned, solid.communicator);
    balance(without_contact);
    contact.enforcement().recover(contact, without_contact, graph);
    judge_balance(without_contact, state);
    update_active_set(damping, state);
    // Uzawa's outer iteration augments forces once they are in balance.
    if (state.changes == 0 && state.prescribed && balanced(state, scene.newton))
      contact.enforcement().balanced(contact);
    forcing_term.update(state, solver->symmetric_only() && solid.linear());
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
    graph.clear();
    missed = boundary_conditions.prescribe(time, u, graph);
    // Exact up to round-off after the first full increment; a shortened increment misses a part.
    state.prescribed = missed <= scene.newton.gap_tolerance * length;
  }



  void
  StepProblem::balance(Vector &without_contact)
  {
    {
      TimerOutput::Scope scope(timer, "assembly");
      solid.internal_force(u, internal);
      if (!boundary_conditions.follower_pressure().empty())
        boundary_conditions.external_force(time, u, external);
    }
    // Time integration weighs the forces at both ends of the step and adds inertia. Forces on
    // hanging nodes count for the nodes that these follow.
    integration->balance(u, external, internal, applied);
    without_contact = applied;
    solid.condense(without_contact);
  }



  void
  StepProblem::judge_balance(const Vector &without_contact, NewtonState &state)
  {
    // Relative residual, equation (13): the scale is the largest of internal, external, contact and
    // inertial forces.
    Vector contact_force(solid.owned, solid.communicator);
    contact.add_forces(contact_force);
    unbalanced = without_contact;
    unbalanced += contact_force;

    // Forces along prescribed directions are reactions of the supports and no residual.
    Vector free(unbalanced);
    remove_supported(free);
    const double present = std::max(
      {internal.l2_norm(), external.l2_norm(), contact_force.l2_norm(), integration->inertia()});
    const double round_off =
      solid.round_off(u) + integration->round_off(u) +
      std::sqrt(Utilities::MPI::sum(contact.enforcement().round_off_squared(contact.rows(), extent),
                                    solid.communicator));
    // Where forces vanish, at the end of contact for example, the present forces are round-off and
    // no scale for the residual; then a thousandth of the largest forces of earlier steps is used.
    // The forces of a body in free flight are round-off from the start: force_scale excludes them
    // from these.
    constexpr double small_force = 1e-3, largest_round_off = 1e-6;
    force_scale        = largest_round_off * present > round_off ? present : 0.;
    const double scale = std::max(present, small_force * largest_force_scale);
    state.force        = free.l2_norm();
    state.residual     = scale > 0. ? state.force / scale : 0.;
    state.round_off    = scale > 0. ? round_off / scale : 0.;
    // A large round-off is plausible only before the first forces act. Later on it must not hide a
    // residual, so that the allowance is bounded.
    if (largest_force_scale > 0.)
      state.round_off = std::min(state.round_off, largest_round_off);
  }



  void
  StepProblem::update_active_set(const unsigned int damping, NewtonState &state)
  {
    const ActiveSetUpdate set =
      contact.enforcement().update_active_set(contact, scene.newton.gap_tolerance, damping);
    changed_rows.clear();
    for (const ContactRow *row : set.changed)
      changed_rows.push_back(
        {{row->reference[0], row->reference[1], row->reference[2], double(row->pair)}});
    state.gap       = set.gap;
    state.active    = set.active;
    state.changes   = set.changes;
    state.signature = set.signature;
  }



  void
  StepProblem::linearize()
  {
    TimerOutput::Scope scope(timer, "assembly");
    if (!solid.linear())
      {
        // Linear bodies have a constant stiffness, which was assembled in the constructor
        // (doc/theory.md 2.1).
        solid.assemble(u, solver->symmetric_only());
        ++assemblies;
      }
    begin_system();
    // Consistent linearisation of contact by choice or default, or because a frozen iteration of
    // this step has gained too little (doc/theory.md 5, "Linearisation").
    if (!system->keep_symmetric &&
        (consistent(scene, solver->wants_basis_change(static_cast<int>(u.size()))) ||
         (forcing_term.slow() &&
          scene.contact.linearisation == ContactParameters::Linearisation::automatic)))
      contact.differentiate();
    // Conditions of contact follow the prescribed displacements in the graph, in the order of
    // pairs; friction needs to know which of them were accepted.
    contact.enforcement().enforce(contact, graph, *system);
    add_follower_pressure();
    contact.enforcement().add_friction(contact, *system);
    if (!integration->dynamic())
      check_supports();
    // Only now are all terms known, and hence the dofs of other ranks that they refer to.
    const IndexSet needed = dofs_of_system();
    constrain_system(needed);
    if (solver->wants_basis_change(static_cast<int>(u.size())))
      change_basis(needed);
    condensed =
      std::make_unique<CondensedSystem>(*system,
                                        solver->applies_operator(static_cast<int>(u.size())));
  }



  void
  StepProblem::begin_system()
  {
    system            = std::make_unique<LinearSystem>();
    system->stiffness = &integration->stiffness();
    system->rhs.reinit(solid.owned, solid.communicator);
    system->rhs               = applied;
    system->first_extra       = system->rhs.size();
    system->tolerance         = forcing_term.tolerance();
    system->keep_symmetric    = solver->symmetric_only();
    system->symmetric         = system->keep_symmetric || solid.symmetric();
    system->takes_multipliers = solver->factorises(static_cast<int>(u.size()));
  }



  void
  StepProblem::add_follower_pressure()
  {
    if (boundary_conditions.follower_pressure().empty())
      return;
    const std::size_t before = system->terms.size();
    boundary_conditions.follower_pressure().add_stiffness(time,
                                                          u,
                                                          system->keep_symmetric,
                                                          system->terms);
    for (std::size_t k = before; k < system->terms.size(); ++k)
      for (auto &entry : system->terms[k].left)
        // Loads at the end of the step enter the balance with this weight, and so does their
        // stiffness.
        entry.second *= integration->weight();
    // The load stiffness is unsymmetric in general (doc/theory.md 2.3); systems that have to be
    // symmetric get its symmetric part.
    system->symmetric = system->symmetric && system->keep_symmetric;
  }



  IndexSet
  StepProblem::dofs_of_system() const
  {
    // Contact terms may refer to nodes that are far from this rank's cells, and to
    // components of them that no condition knows of.
    std::set<Index> far;
    for (const RankOneTerm &term : system->terms)
      for (const LinearForm *form : {&term.left, &term.right})
        for (const auto &[i, value] : *form)
          if (i < system->rhs.size() && !solid.relevant.is_element(i))
            far.insert(i);
    IndexSet needed = solid.relevant;
    needed.add_indices(far.begin(), far.end());
    return needed;
  }



  // Decisions about the kind of system must be the same on all ranks: an unsymmetric row on one
  // makes the whole system unsymmetric.
  bool
  StepProblem::everywhere(const bool here) const
  {
    return Utilities::MPI::min(static_cast<int>(here), solid.communicator) == 1;
  }



  void
  StepProblem::constrain_system(const IndexSet &needed)
  {
    system->constraints = graph.constraints(solid.hanging, solid.owned, needed, solid.communicator);
    // Friction in slip and consistent linearisation: test functions that do no work against the
    // forces of the conditions, doc/theory.md 6.3, equation (22).
    if (!everywhere(graph.symmetric()))
      {
        system->test_constraints =
          graph.test_constraints(solid.hanging, solid.owned, needed, solid.communicator);
        system->symmetric = false;
      }
    system->symmetric = everywhere(system->symmetric);
  }



  // Stiff springs spoil multigrid; with their elongations as dofs each becomes a diagonal entry
  // (doc/theory.md 7, "Stiff springs", equation (23)).
  void
  StepProblem::change_basis(const IndexSet &needed)
  {
    // After all conditions: springs determine no displacement and must not take a component that
    // a condition needs.
    for (const ContactRow &row : contact.rows())
      for (const Condition &spring : friction_springs(row, contact.state(row)))
        graph.accept(spring, ConstraintGraph::Treatment::spring);
    system->basis_change =
      graph.basis_change(system->constraints, solid.owned, needed, solid.communicator);
    if (!system->keep_symmetric && !everywhere(graph.symmetric(ConstraintGraph::Treatment::spring)))
      {
        system->test_basis_change =
          graph.test_basis_change(system->test_constraints ? *system->test_constraints
                                                           : system->constraints,
                                  solid.owned,
                                  needed,
                                  solid.communicator);
        system->symmetric = false;
      }
  }



  // Only supports count here. A body that they leave free and that takes part in no contact pair
  // can never be held: an input error (doc/theory.md 9).
  void
  StepProblem::check_bodies_without_support()
  {
    graph.clear();
    boundary_conditions.prescribe(0., u, graph);
    const FreeMotion motion = modes->free_motion(graph.accepted());
    for (const unsigned int body : motion.bodies)
      {
        const std::string &name  = scene.bodies[body].name;
        bool               meets = false;
        for (const ContactPairParameters &pair : scene.pairs)
          meets = meets || pair.slave_body == name || pair.master_body == name;
        if (!meets)
          throw InputError("Body " + name,
                           "Fixed",
                           "",
                           "nothing holds the bodies in place: " + motion.description,
                           "add to 'Fixed' or 'Symmetry', prescribe a displacement, or define a "
                           "contact pair.");
      }
  }



  // Bodies held by contact alone (doc/theory.md 9): where the accepted conditions leave rigid
  // motions free, a diagonal shift on these bodies keeps the increment finite. It is not in the
  // residual, so the equilibrium does not depend on it.
  void
  StepProblem::check_supports()
  {
    std::vector<Condition> supports = graph.accepted();
    for (const ContactRow &row : contact.rows())
      {
        const auto springs = elastic_stick(row, contact.state(row));
        // Springs of stick hold a body against sliding although they impose no condition.
        supports.insert(supports.end(), springs.begin(), springs.end());
      }
    const FreeMotion motion = modes->free_motion(supports);
    if (motion.n_modes == 0)
      return;
    // The shift is chosen by the distance that a body may move in one iteration. Before contact:
    // about the smallest open gap, so that the body does not pass through the surface that will
    // hold it. In contact the body can still slide: there the shift must outweigh the geometric
    // stiffness of the contact forces, relative to the stiffness about pressure over Young's
    // modulus, which the tangent lacks; otherwise the iterates would oscillate about the
    // equilibrium.
    double       distance = std::numeric_limits<double>::max();
    double       size     = 0.;
    unsigned int active   = 0;
    for (const ContactRow &row : contact.rows())
      if (row.has_partner)
        {
          const bool is_active = contact.state(row).active();
          size                 = std::max(size, row.size);
          active += is_active;
          if (!is_active && row.gap > 0.)
            distance = std::min(distance, row.gap);
        }
    distance = Utilities::MPI::min(distance, solid.communicator);
    size     = Utilities::MPI::max(size, solid.communicator);
    active   = Utilities::MPI::sum(active, solid.communicator);
    // No row has a partner yet.
    if (size == 0.)
      size = length;
    distance = active > 0 ? 1e-3 * size : std::clamp(1.01 * distance, 1e-3 * size, size);
    system->diagonal_shift =
      modes->stabilisation(motion, unbalanced, distance, active > 0 ? 1e-3 : 1e-7);
    stabilised = motion.description;
    loose_bodies.insert(motion.bodies.begin(), motion.bodies.end());
  }



  int
  StepProblem::solve()
  {
    TimerOutput::Scope scope(timer, "linear solver");
    const unsigned int before = solver->counts().iterations;
    Epetra_Vector      solution(condensed->rows());
    solver->solve(*condensed, modes->motions(), solution);
    const Index n = solid.owned.n_elements();
    // Eliminated dofs follow from the constraints.
    condensed->expand(solution, solved_increment);
    check_increment();
    extra.assign(solution.Values() + n, solution.Values() + solution.MyLength());
    // Frees its memory before the forces are recovered, which need the full system only.
    condensed.reset();
    contact.enforcement().take(
      {*system, graph, solved_increment, extra, [this](Vector &force) { solid.condense(force); }});
    const unsigned int iterations = solver->counts().iterations - before;
    return iterations == 0 ? -1 : static_cast<int>(iterations);
  }



  void
  StepProblem::update()
  {
    // The strain energy is not defined for det F <= 0, so the increment is halved until all cells
    // are admissible (doc/theory.md 2.2). The multipliers belong to the end of the full increment
    // and are not scaled.
    admissible_part = 1.;
    increment       = solved_increment;
    Vector trial(u);
    trial += increment;
    for (unsigned int halvings = 0; !solid.admissible(trial); ++halvings)
      {
        // The load stepping then cuts the step.
        if (halvings == 6)
          throw InvertedCells("a cell turns inside out (det F <= 0), even with 1/64 of a Newton "
                              "increment: " +
                              smallest(scene, solid, trial, [](unsigned int, const auto &F) {
                                return determinant(F);
                              }).place(scene));
        increment *= 0.5;
        admissible_part *= 0.5;
        trial = u;
        trial += increment;
      }
    before_increment = u;
    u                = trial;
    contact.enforcement().update(contact,
                                 scene.newton.line_search != NewtonParameters::LineSearch::none);
  }



  void
  StepProblem::shorten(const double fraction)
  {
    u = before_increment;
    u.add(fraction, increment);
    contact.enforcement().shorten(contact,
                                  fraction < 1. ? fraction * admissible_part
                                                : 1.); // the full increment, as in update()
  }



  StepState
  StepProblem::state() const
  {
    return {u, contact, *integration, solid, {linear_counts(), assemblies, n_searches()}, [this]() {
              // What the supports must add for the nodes to be in balance.
              Vector support(unbalanced);
              support *= -1.;
              return boundary_conditions.reactions(support);
            }};
  }



  StepFindings
  StepProblem::findings() const
  {
    StepFindings result;
    result.remarks  = remarks();
    result.warnings = check_loose_bodies();
    check_contact();
    return result;
  }



  StepDifficulty
  StepProblem::difficulty() const
  {
    std::string suspicion;
    if (!stabilised.empty())
      suspicion = "; held by contact alone, perhaps against no resistance: " + stabilised;
    if (!solid.linear())
      if (const std::string place = unstable_place(scene, solid, u); !place.empty())
        suspicion += "; the material of " + place +
                     " is compressed so far that by its 'Law' it resists no longer";
    return {worst_place(), suspicion};
  }



  std::unique_ptr<Step>
  Step::make(const Scene &scene, const Forest &forest, Solid &solid, TimerOutput &timer)
  {
    return std::make_unique<StepProblem>(scene, forest, solid, timer);
  }



  std::string
  StepProblem::remarks() const
  {
    std::string  text;
    unsigned int dropped = 0;
    for (const ContactRow &row : contact.rows())
      dropped += (contact.state(row).active() && contact.state(row).dropped());
    dropped = Utilities::MPI::sum(dropped, solid.communicator);
    if (dropped > 0)
      // A remark and no error: what the dropped conditions would determine is determined already.
      text = std::to_string(dropped) +
             " contact row(s) dropped: prescribed displacements or other pairs decide there";
    if (!stabilised.empty())
      text +=
        std::string(text.empty() ? "" : "\n") + "held by contact alone, stabilised: " + stabilised;
    // Each remark of the solver is reported once.
    for (const std::string &remark : solver->take_remarks())
      text += (text.empty() ? "" : "\n") + remark;
    return text;
  }
} // namespace Touchstone
