// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_refused_conditions_h
#define touchstone_contact_enforcement_refused_conditions_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/contact/friction/friction_force.h>
#include <touchstone/contact/row.h>

#include <deal.II/base/index_set.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief Conditions of rows that the constraint graph has refused because supports, or another
   * row, determine the displacement of the slave node already (doc/theory.md 6, "Slave nodes that
   * are not free").
   *
   * Where the other nodes of the row can move they have to meet the condition: springs do that,
   * whose force is augmented in each iteration, t <- t - 100 c g, until no gap is left. A spring
   * takes no displacement for its own, so that conditions which say the same twice do no harm.
   */
  class RefusedConditions
  {
  public:
    struct Entry
    {
      const ContactRow *row;
      Condition         condition;
    };

    /** @param graph Holds the supports only. */
    explicit RefusedConditions(const ConstraintGraph &graph)
      : n_supports(graph.accepted().size())
    {
    }

    void
    add(const ContactRow &row, const Condition &condition)
    {
      entries.push_back({&row, condition});
    }

    const std::vector<Entry> &
    all() const
    {
      return entries;
    }

    /** @brief For each entry, whether nodes of its row are free to meet it. Collective.
     * @param graph The same as before, now with further conditions.
     * @param owned Dofs of this rank. */
    std::vector<bool>
    can_be_met(const ConstraintGraph  &graph,
               const dealii::IndexSet &owned,
               MPI_Comm                communicator) const;

    /** @brief Force per length of the spring of a row. */
    static double
    stiffness(const ContactRow &row)
    {
      return FrictionForce::unconstrained_stiffness(row.stiffness);
    }

  private:
    std::size_t        n_supports;
    std::vector<Entry> entries;
  };
} // namespace Touchstone

#endif
