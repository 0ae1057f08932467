// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/refused_conditions.h>
#include <touchstone/contact/enforcement/spring_enforcement.h>
#include <touchstone/contact/friction/friction_response.h>

#include <utility>
#include <vector>

// Springs in the linear system: the conditions of active rows that the constraint graph accepts,
// each with its stiffness and the force that it starts from (doc/theory.md 6 and 6.3).
namespace Touchstone
{
  using namespace dealii;

  void
  SpringEnforcement::constrain(const Contact &contact, ConstraintGraph &graph, LinearSystem &system)
  {
    // The residual was judged with the forces before the augmentation; the linear system
    // starts from those after it, so its residual is computed again.
    Vector residual;
    if (system.keep_symmetric)
      {
        residual = system.rhs;
        contact.add_forces(residual);
      }
    for (const ContactRow &row : contact.rows())
      if (RowState &state = row_states[row]; state.active() && row.friction)
        {
          // The forces may have been augmented since they were evaluated, so that the friction
          // response has to be made anew for the linear system.
          choose_formulation(row, state, epsilon(row));
          friction_response(row, normal_force(row), state);
          if (system.keep_symmetric)
            lag_friction(row, state, balancing_force(row, residual, graph));
        }

    springs.clear();
    RowTerms          terms(system);
    RefusedConditions refused(graph), refused_stick(graph);
    const auto        offer = [&](const ContactRow &row, const Condition &condition) {
      const bool is_accepted = graph.accept(condition, ConstraintGraph::Treatment::spring);
      if (is_accepted)
        {
          row_states[row].record(condition, true);
          add_spring(row, condition, terms);
        }
      return is_accepted;
    };
    // As in ExactEnforcement: of two dependent conditions the graph keeps the earlier one, and
    // those along normals precede those of stick.
    std::vector<std::pair<const ContactRow *, Condition>> stick;
    for (const ContactRow &row : contact.rows())
      {
        start_row(row_states[row]);
        const std::vector<Condition> conditions =
          row_conditions(row, row_states[row], system.keep_symmetric);
        for (std::size_t k = 0; k < conditions.size(); ++k)
          if (k > 0 && !row.tied)
            stick.emplace_back(&row, conditions[k]);
          else if (!offer(row, conditions[k]))
            refused.add(row, conditions[k]);
      }
    const std::vector<bool> can_be_met =
      refused.can_be_met(graph, contact.solid_model().owned, contact.communicator());
    for (std::size_t k = 0; k < refused.all().size(); ++k)
      if (const auto &[row, condition] = refused.all()[k];
          row_states[*row].record(condition, can_be_met[k]))
        {
          graph.add_spring(condition);
          add_spring(*row, condition, terms);
        }
    for (const auto &[row, condition] : stick)
      if (redundant.stick[row->index] || !offer(*row, condition))
        refused_stick.add(*row, condition);
    record_refused_stick(refused_stick, contact, graph);
    terms.finish();
  }



  double
  SpringEnforcement::balancing_force(const ContactRow      &row,
                                     const Vector          &residual,
                                     const ConstraintGraph &graph) const
  {
    Tensor<1, dim> rest;
    for (unsigned int d = 0; d < dim; ++d)
      rest[d] = residual(dim * row.slave + d);
    return row_states[row].lambda - graph.free_part(row.slave, rest) * row.normal;
  }



  void
  SpringEnforcement::add_spring(const ContactRow &row, const Condition &condition, RowTerms &terms)
  {
    // The force after the iteration is lambda_k - epsilon (g + dg),
    // and the condition's value is -g.
    const double   stiffness = epsilon(row);
    Tensor<1, dim> augmented = augmentation[row].rest;
    if (!row.tied)
      augmented += (augmentation[row].lambda - augmented * row.normal) * row.normal;
    const double force = augmented * condition.direction + stiffness * condition.value;
    terms.add_spring(row, condition, force, stiffness);
    if (!by_gap(row))
      springs.push_back({&row, condition, force, stiffness, row.normal});
  }
} // namespace Touchstone
