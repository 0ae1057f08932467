// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/free_memory.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/reduction.h>
#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/drive/informed_solver.h>
#include <touchstone/drive/step_system.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <limits>

// The order in which conditions enter the system is their precedence: prescribed displacements,
// contact in the order of the pairs, friction; springs come last, because they determine no
// displacement. A condition that the earlier ones imply already is not accepted
// (algebra/constraint_graph).
namespace Touchstone
{
  using namespace dealii;

  StepSystem::StepSystem(const Parts &parts)
    : parts(parts)
    , solver(
        LinearSolverRegistry::make(parts.scene.linear_solver.type, informed_solver(parts.scene)))
    , modes(parts.solid)
    , length(Utilities::MPI::min(GridTools::minimal_cell_diameter(
                                   parts.solid.dof_handler.get_triangulation()),
                                 parts.solid.communicator))
  {
  }



  void
  StepSystem::begin_step()
  {
    free_motions.clear();
    holding.clear();
    loose.clear();
  }



  double
  StepSystem::prescribe(const double t, const Vector &u)
  {
    graph.clear();
    return parts.boundary_conditions.prescribe(t, u, graph);
  }



  // Supports can act along any direction of a node, so their part is projected out node by node and
  // not by components (doc/theory.md 5, "Convergence").
  void
  StepSystem::remove_supported(Vector &forces) const
  {
    for (Index k = 0; k < parts.solid.owned.n_elements() / dim; ++k)
      {
        const Index    node = parts.solid.owned.nth_index_in_set(dim * k) / dim;
        Tensor<1, dim> force;
        for (unsigned int d = 0; d < dim; ++d)
          force[d] = forces.begin()[dim * k + d];
        force = graph.free_part(node, force);
        for (unsigned int d = 0; d < dim; ++d)
          forces.begin()[dim * k + d] = force[d];
      }
  }



  // With friction slip makes the system unsymmetric anyway, so that the derivatives of normals and
  // contact points cost no other factorisation. Without friction a symmetric factorisation saves
  // more than the additional iterations of frozen ones cost; and with an iterative solver the
  // derivatives of averaged rows cost as much as all the rest (doc/theory.md 5, "Linearisation";
  // doc/benchmarks.md, "Frozen or consistent"). Whatever the default, frozen iterations that have
  // gained too little are not repeated in this step.
  bool
  StepSystem::begins_consistent() const
  {
    using Linearisation      = ContactParameters::Linearisation;
    const auto linearisation = parts.scene.contact.linearisation;
    if (solver->symmetric_only() || linearisation == Linearisation::frozen)
      return false;
    return linearisation == Linearisation::consistent ||
           (parts.scene.has_friction() && !solver->wants_basis_change(size()));
  }



  void
  StepSystem::assemble(const State &state)
  {
    begin(state);
    if (consistent(state))
      parts.contact.differentiate();
    Enforcement &enforcement = parts.contact.enforcement();
    // Friction needs to know which conditions of contact were accepted.
    enforcement.enforce(parts.contact, graph, *system);
    add_load_stiffness(state);
    enforcement.add_friction(parts.contact, *system);
    if (!parts.integration.dynamic())
      check_supports(state);
    // Only now are all terms known, and hence the dofs of other ranks that they refer to.
    const IndexSet needed = dofs_of_system();
    constrain(needed);
    if (solver->wants_basis_change(size()))
      change_basis(needed);
    condensed = std::make_unique<CondensedSystem>(*system, applies_operator());
  }



  void
  StepSystem::begin(const State &state)
  {
    system                    = std::make_unique<LinearSystem>();
    system->stiffness         = &parts.integration.stiffness();
    system->rhs               = Vector(state.applied); // its layout without a message
    system->first_extra       = system->rhs.size();
    system->tolerance         = state.tolerance;
    system->keep_symmetric    = solver->symmetric_only();
    system->symmetric         = system->keep_symmetric || parts.solid.symmetric();
    system->takes_multipliers = solver->factorises(size());
  }



  void
  StepSystem::add_load_stiffness(const State &state)
  {
    if (!parts.boundary_conditions.depends_on_displacement())
      return;
    const std::size_t before = system->terms.size();
    parts.boundary_conditions.ground_springs().add_stiffness(system->terms);
    parts.boundary_conditions.follower_pressure().add_stiffness(state.time,
                                                                state.u,
                                                                system->keep_symmetric,
                                                                system->terms);
    bool unsymmetric = !parts.boundary_conditions.follower_pressure().empty();
    for (const auto &load : parts.boundary_conditions.surface_loads())
      if (load.resultant && load.resultant->follows())
        {
          load.resultant->add_stiffness(state.time, state.u, system->keep_symmetric, system->terms);
          unsymmetric = true;
        }
    for (std::size_t k = before; k < system->terms.size(); ++k)
      for (auto &entry : system->terms[k].left)
        // Loads at the end of the step enter the balance with this weight, and so does their
        // stiffness.
        entry.second *= parts.integration.weight();
    // The stiffness of pressures and moments is unsymmetric in general (doc/theory.md 2.3), that of
    // springs is not; systems that have to be symmetric get its symmetric part.
    if (unsymmetric)
      system->symmetric = system->symmetric && system->keep_symmetric;
  }



  IndexSet
  StepSystem::dofs_of_system() const
  {
    // Contact terms may refer to nodes that are far from this rank's cells, and to
    // components of them that no condition knows of.
    std::set<Index> far;
    for (const RankOneTerm &term : system->terms)
      for (const LinearForm *form : {&term.left, &term.right})
        for (const auto &[i, value] : *form)
          if (i < system->rhs.size() && !parts.solid.relevant.is_element(i))
            far.insert(i);
    IndexSet needed = parts.solid.relevant;
    needed.add_indices(far.begin(), far.end());
    return needed;
  }



  // Decisions about the kind of system must be the same on all ranks: an unsymmetric row on one
  // makes the whole system unsymmetric.
  bool
  StepSystem::everywhere(const bool here) const
  {
    return Utilities::MPI::min(static_cast<int>(here), parts.solid.communicator) == 1;
  }



  void
  StepSystem::constrain(const IndexSet &needed)
  {
    system->constraints =
      graph.constraints(parts.solid.hanging, parts.solid.owned, needed, parts.solid.communicator);
    // Friction in slip and consistent linearisation: test functions that do no work against the
    // forces of the conditions, doc/theory.md 6.3, equation (22).
    double unsymmetric_graph = graph.symmetric() ? 0. : 1.,
           unsymmetric       = system->symmetric ? 0. : 1.;
    Reduction all;
    all.max(unsymmetric_graph);
    all.max(unsymmetric);
    all.over(parts.solid.communicator);
    system->symmetric = unsymmetric_graph + unsymmetric == 0.;
    if (unsymmetric_graph > 0.)
      system->test_constraints = graph.test_constraints(parts.solid.hanging,
                                                        parts.solid.owned,
                                                        needed,
                                                        parts.solid.communicator);
  }



  // Stiff springs spoil multigrid; with their elongations as dofs each becomes a diagonal entry
  // (doc/theory.md 7, "Stiff springs", equation (23)).
  void
  StepSystem::change_basis(const IndexSet &needed)
  {
    // After all conditions: springs determine no displacement and must not take a component that
    // a condition needs.
    for (const ContactRow &row : parts.contact.rows())
      for (const Condition &spring : friction_springs(row, parts.contact.state(row)))
        graph.accept(spring, ConstraintGraph::Treatment::spring);
    system->basis_change =
      graph.basis_change(system->constraints, parts.solid.owned, needed, parts.solid.communicator);
    if (!system->keep_symmetric && !everywhere(graph.symmetric(ConstraintGraph::Treatment::spring)))
      {
        system->test_basis_change =
          graph.test_basis_change(system->test_constraints ? *system->test_constraints
                                                           : system->constraints,
                                  parts.solid.owned,
                                  needed,
                                  parts.solid.communicator);
        system->symmetric = false;
      }
  }



  // Only supports count here. A body that they leave free and that takes part in no contact pair
  // can never be held: an input error (doc/theory.md 9).
  void
  StepSystem::check_bodies_without_support(const Vector &u)
  {
    prescribe(0., u);
    std::vector<Condition>       held    = graph.accepted();
    const std::vector<Condition> springs = parts.boundary_conditions.ground_springs().conditions();
    held.insert(held.end(), springs.begin(), springs.end());
    left_free = modes.free_motion(held);
    for (const unsigned int body : left_free.bodies)
      {
        const std::string &name  = parts.scene.bodies[body].name;
        bool               meets = false;
        for (const ContactPairParameters &pair : parts.scene.pairs)
          meets = meets || pair.slave_body == name || pair.master_body == name;
        if (!meets)
          throw InputError("Body " + name,
                           "Fixed",
                           "",
                           "nothing holds the bodies in place: " + left_free.description,
                           "add to 'Fixed' or 'Symmetry', prescribe a displacement, or define a "
                           "contact pair.");
      }
    check_parts(held);
  }



  void
  StepSystem::hold_loosely_held(const State &state, std::vector<Condition> holding)
  {
    if (!state.springs.attached())
      return;
    // Where there is friction it decides, even if it leaves a motion free.
    std::vector<int> with_friction(parts.solid.n_bodies());
    bool             pressed = false;
    for (const ContactRow &row : parts.contact.rows())
      if (parts.contact.state(row).active())
        {
          pressed = true;
          if (row.friction || row.tied)
            {
              with_friction[row.body] = 1;
              if (!row.on_obstacle())
                with_friction[row.master_body] = 1;
            }
        }
    Utilities::MPI::max(with_friction, parts.solid.communicator, with_friction);
    for (unsigned int body = 0; body < with_friction.size(); ++body)
      if (with_friction[body] == 1)
        {
          const std::vector<Condition> fixed = modes.all_motions(body);
          holding.insert(holding.end(), fixed.begin(), fixed.end());
        }
    // Facets that strain has tilted against each other resist a motion along them a little.
    constexpr double little = 1e-3;
    state.springs.act_on(everywhere(!pressed) ? FreeMotion() : modes.free_motion(holding, little));
    if (state.springs.act())
      system->diagonal_shift = state.springs.stiffness();
  }



  // Bodies held by contact alone (doc/theory.md 9): where the accepted conditions leave rigid
  // motions free, a diagonal shift on these bodies keeps the increment finite. It is not in the
  // residual, so the equilibrium does not depend on it.
  void
  StepSystem::check_supports(const State &state)
  {
    std::vector<Condition> supports = parts.boundary_conditions.ground_springs().conditions();
    for (const std::vector<Condition> *conditions : {&graph.accepted(), &graph.met_by_springs()})
      supports.insert(supports.end(), conditions->begin(), conditions->end());
    for (const ContactRow &row : parts.contact.rows())
      {
        const auto springs = elastic_stick(row, parts.contact.state(row));
        // Springs of stick hold a body against sliding although they impose no condition.
        supports.insert(supports.end(), springs.begin(), springs.end());
      }
    hold_loosely_held(state, supports);
    const FreeMotion motion = modes.free_motion(supports);
    holding.clear();
    if (motion.n_modes == 0)
      return;
    holding = std::move(supports);
    // The shift is chosen by the distance that a body may move in one iteration. Before contact:
    // about the smallest open gap, so that the body does not pass through the surface that will
    // hold it. In contact the body can still slide: there the shift must outweigh the geometric
    // stiffness of the contact forces, relative to the stiffness about pressure over Young's
    // modulus, where the tangent lacks it; otherwise the iterates would oscillate about the
    // equilibrium. A consistent tangent has it: the shift vanishes with the residual, slowly enough
    // for motions that nothing resists, whose residual is of second order.
    double        distance = std::numeric_limits<double>::max();
    double        size     = 0.;
    std::uint64_t active   = 0;
    for (const ContactRow &row : parts.contact.rows())
      if (row.has_partner)
        {
          const bool is_active = parts.contact.state(row).active();
          size                 = std::max(size, row.size);
          active += is_active;
          if (!is_active && row.gap > 0.)
            distance = std::min(distance, row.gap);
        }
    distance = -distance; // its minimum
    Reduction all;
    all.max(distance);
    all.max(size);
    all.sum(active);
    all.over(parts.solid.communicator);
    distance = -distance;
    // No row has a partner yet.
    if (size == 0.)
      size = length;
    constexpr double before_contact = 1e-7, in_contact = 1e-3;
    double           smallest;
    if (active == 0)
      {
        distance = std::clamp(1.01 * distance, 1e-3 * size, size);
        smallest = before_contact;
      }
    else if (consistent(state))
      {
        distance = 1e-2 * size;
        smallest = std::clamp(in_contact * std::sqrt(state.residual), before_contact, in_contact);
      }
    else
      {
        distance = 1e-3 * size;
        smallest = in_contact;
      }
    const Vector shift = modes.stabilisation(motion, state.unbalanced, distance, smallest);
    if (system->diagonal_shift.size() == 0)
      system->diagonal_shift = shift;
    else
      system->diagonal_shift += shift;
    free_motions = motion.description;
    loose.insert(motion.bodies.begin(), motion.bodies.end());
  }



  FreeMotion
  StepSystem::undetermined_motion() const
  {
    // The same on all ranks but where the conditions are.
    if (everywhere(holding.empty()))
      return FreeMotion();
    std::vector<Condition> resisting(holding);
    for (const ContactRow &row : parts.contact.rows())
      {
        const auto directions = along_surface(row, parts.contact.state(row));
        resisting.insert(resisting.end(), directions.begin(), directions.end());
      }
    return modes.free_motion(resisting);
  }



  int
  StepSystem::solve(Vector &increment)
  {
    const unsigned int before = solver->counts().iterations;
    Epetra_Vector      solution(condensed->rows());
    solver->solve(*condensed, modes.motions(), solution);
    const Index n = parts.solid.owned.n_elements();
    increment     = Vector(system->rhs); // its layout without a message
    // Eliminated dofs follow from the constraints.
    condensed->expand(solution, increment);
    extra.assign(solution.Values() + n, solution.Values() + solution.MyLength());
    // Frees its memory before the forces are recovered, which need the full system only, and
    // contact is searched, which needs memory of its own.
    condensed.reset();
    system->stiffness->free_work_space();
    if (applies_operator())
      give_back_free_memory();
    const unsigned int iterations = solver->counts().iterations - before;
    return iterations == 0 ? -1 : static_cast<int>(iterations);
  }



  void
  StepSystem::recover(const Vector &increment)
  {
    parts.contact.enforcement().take(
      {*system, graph, increment, extra, [this](Vector &force) { parts.solid.condense(force); }});
  }
} // namespace Touchstone
