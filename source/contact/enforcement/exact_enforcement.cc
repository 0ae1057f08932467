// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/exact_enforcement.h>
#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/contact/friction/friction_response.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <set>

// What elimination and Lagrange multipliers share (doc/theory.md 6): active rows become conditions
// of the constraint graph, and their forces are the multipliers of these conditions, taken from
// each linear solution. Order in an iteration: evaluate() before the rows are judged, constrain()
// for the linear system, take() and set_forces() after its solution.
namespace Touchstone
{
  using namespace dealii;

  void
  ExactEnforcement::evaluate(const Contact &contact, const Vector &, const ConstraintGraph &)
  {
    if (solved)
      find_gaps_of_springs();
    for (const ContactRow &row : contact.rows())
      {
        RowState &state = row_states[row];
        // Of open rows, too: they may close before the next linear system.
        if (row.friction)
          choose_friction(row, state);
        // A dropped row carries no force; its friction would have no bound, for its status stays.
        if (!state.active() || state.dropped())
          continue;
        // Once per linear solve: evaluations without one in between, as at the start of a step,
        // must not augment again.
        if (solved && row.friction && state.fully_constrained())
          augment_unconstrained(row, state);
        if (solved)
          judge_springs(row, state);
        evaluate_force(row, state);
      }
    solved = false;
  }



  void
  ExactEnforcement::constrain(const Contact &contact, ConstraintGraph &graph, LinearSystem &system)
  {
    accepted.clear();
    prepare(contact, system);
    RefusedConditions refused(graph), refused_stick(graph);
    const auto        offer = [&](const ContactRow &row, Condition condition) {
      const ConstraintGraph::Treatment way = treatment(row);
      adjust(row, condition);
      // The graph refuses a condition whose direction supports or other rows determine already; it
      // would make the system singular.
      const bool is_accepted = graph.accept(condition, way);
      if (is_accepted)
        {
          accepted.push_back({&row, condition, graph.accepted().size() - 1, way, row.normal});
          row_states[row].record(condition, true);
        }
      return is_accepted;
    };
    // Non-penetration takes precedence: of two dependent conditions the graph keeps the earlier
    // one, so the normal conditions of all rows are added before those of stick.
    std::vector<std::pair<const ContactRow *, std::vector<Condition>>> stick;
    for (const ContactRow &row : contact.rows())
      {
        start_row(row_states[row]);
        std::vector<Condition> conditions =
          row_conditions(row, row_states[row], system.keep_symmetric);
        // A tied row has one condition per direction, none of which is friction; other rows have
        // their normal first.
        const std::size_t n = row.tied ? conditions.size() : 1;
        for (std::size_t k = 0; k < std::min(n, conditions.size()); ++k)
          if (!offer(row, conditions[k]))
            refused.add(row, conditions[k]);
        if (conditions.size() > n)
          stick.emplace_back(&row,
                             std::vector<Condition>(conditions.begin() + n, conditions.end()));
      }
    add_springs(contact, refused, graph, system);
    for (const auto &[row, conditions] : stick)
      for (const Condition &condition : conditions)
        if (redundant.stick[row->index] || !offer(*row, condition))
          refused_stick.add(*row, condition);
    record_refused_stick(refused_stick, contact, graph);
    if (system.takes_multipliers)
      add_multipliers(accepted, system);
  }



  void
  ExactEnforcement::add_springs(const Contact           &contact,
                                const RefusedConditions &refused,
                                ConstraintGraph         &graph,
                                LinearSystem            &system)
  {
    const MPI_Comm          communicator = contact.communicator();
    const std::vector<bool> can_be_met =
      refused.can_be_met(graph, contact.solid_model().owned, communicator);
    RowTerms terms(system);
    int      n_springs = 0;
    for (std::size_t k = 0; k < refused.all().size(); ++k)
      {
        const auto &[row, condition] = refused.all()[k];
        RowState &state              = row_states[*row];
        if (!state.record(condition, can_be_met[k]))
          continue;
        // The force after the solve is the present one less k (g + dg), and the value of the
        // condition is -g.
        const double stiffness = state.spring.of(row->stiffness);
        const double present   = row->tied ? state.force * condition.direction : state.lambda;
        const double force     = present + stiffness * condition.value;
        terms.add_spring(*row, condition, force, stiffness);
        graph.add_spring(condition);
        accepted.push_back(
          {row, condition, 0, ConstraintGraph::Treatment::spring, row->normal, force});
        ++n_springs;
      }
    has_springs = Utilities::MPI::max(n_springs, communicator) > 0;
    if (has_springs)
      terms.finish();
  }



  void
  ExactEnforcement::find_gaps_of_springs()
  {
    for (const Accepted &entry : accepted)
      if (entry.treatment == ConstraintGraph::Treatment::spring)
        row_states[*entry.row].spring.found(std::abs(
          entry.row->tied ? entry.row->gap_vector * entry.condition.direction : entry.row->gap));
  }



  void
  ExactEnforcement::take_springs(const LinearSolution &solution)
  {
    if (!has_springs)
      return;
    std::vector<LinearForm> forms;
    for (const Accepted &entry : accepted)
      if (entry.treatment == ConstraintGraph::Treatment::spring)
        forms.push_back(by_unknowns(entry.condition.motion_form()));
    const std::vector<double> elongations = evaluate_forms(forms, solution.increment);
    std::size_t               next        = 0;
    for (std::size_t k = 0; k < accepted.size(); ++k)
      if (const auto &[row, condition, number, treatment, normal, force] = accepted[k];
          treatment == ConstraintGraph::Treatment::spring)
        forces[k] = force - row_states[*row].spring.of(row->stiffness) * elongations[next++];
  }



  void
  ExactEnforcement::add_multipliers(const std::vector<Accepted> &accepted, LinearSystem &system)
  {
    const auto is_unknown = [](const Accepted &entry) {
      return entry.treatment == ConstraintGraph::Treatment::multiplier;
    };
    const MPI_Comm communicator = system.rhs.get_mpi_communicator();
    system.n_extra              = std::count_if(accepted.begin(), accepted.end(), is_unknown);
    // No multipliers on any rank: the system stays positive definite.
    if (Utilities::MPI::max(system.n_extra, communicator) == 0)
      return;
    // Extra dofs are numbered after all displacements, by rank.
    Index     before = 0;
    const int error =
      MPI_Exscan(&system.n_extra, &before, 1, DEAL_II_DOF_INDEX_MPI_TYPE, MPI_SUM, communicator);
    AssertThrowMPI(error);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      before = 0; // MPI leaves it undefined there
    system.first_extra = system.rhs.size() + before;
    system.definite    = false;
    Index extra        = system.first_extra;
    for (const Accepted &entry : accepted)
      {
        if (!is_unknown(entry))
          continue;
        // Scaled to the size of the stiffness, so that neither block is lost
        // in the other's round-off.
        const double scale = entry.row->stiffness;
        // The blocks B and B^T of the saddle-point system. With friction in slip the column acts
        // along n + L' tau and the row along n, equation (22): the system is then unsymmetric.
        system.terms.push_back({{{extra, scale}}, by_unknowns(entry.condition.motion_form())});
        system.terms.push_back({by_unknowns(entry.condition.force_form()), {{extra, scale}}});
        if (!entry.condition.symmetric())
          system.symmetric = false;
        system.extra_rhs.push_back(scale * entry.condition.value);
        ++extra;
      }
  }



  std::vector<double>
  ExactEnforcement::multipliers(const std::vector<Accepted> &accepted,
                                const LinearSolution        &solution) const
  {
    // The dof is -lambda / c, see the scale in add_multipliers().
    std::vector<double> result;
    std::size_t         extra = 0;
    for (const Accepted &entry : accepted)
      result.push_back(entry.treatment == ConstraintGraph::Treatment::multiplier
                         ? -entry.row->stiffness * solution.extra[extra++]
                         : 0.);
    return result;
  }



  void
  ExactEnforcement::set_forces(const Contact &)
  {
    for (const Accepted &entry : accepted)
      row_states[*entry.row].force = Tensor<1, dim>();
    for (std::size_t k = 0; k < accepted.size(); ++k)
      // A row can have up to three conditions, so its force is summed up over them. Friction in
      // slip is not among them: it follows from lambda in evaluate_force().
      row_states[*accepted[k].row].force += forces[k] * accepted[k].condition.direction;
    std::set<const ContactRow *> found;
    for (const Accepted &entry : accepted)
      {
        const ContactRow &row = *entry.row;
        if (!found.insert(&row).second)
          continue;
        RowState &state = row_states[row];
        state.lambda    = state.force * entry.normal;
        if (row.friction && state.fully_constrained())
          set_stick(state, entry.normal);
      }
    solved = true;
  }
} // namespace Touchstone
