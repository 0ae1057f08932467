// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/free_memory.h>
#include <touchstone/base/reduction.h>
#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/drive/informed_solver.h>
#include <touchstone/drive/step_system.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

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
