// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_refused_conditions_h
#define touchstone_contact_enforcement_refused_conditions_h

#include <touchstone/algebra/constraint_graph.h>
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
   * whose force is augmented in each iteration, t <- t - k g, until no gap is left, see
   * SpringStiffness. A spring takes no displacement for its own, so that conditions which say the
   * same twice do no harm.
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

    /** The parts of the coefficients of a condition that supports leave free: those of its slave
     * node, and those of all other nodes. 1: all. */
    struct FreeParts
    {
      double slave, others;

      /** @brief Nodes of the row are free to meet the condition: a slave node that supports leave
       * free moves with the row that determines it. Of the others half of the weight: where they
       * are held but for small weights, as beside an edge at which both bodies are fixed, these
       * would have to move by many times the gap. */
      bool
      can_meet() const
      {
        return slave > 0.1 || others > 0.5;
      }
    };

    /** @brief What supports leave free of each entry. Collective.
     * @param graph The same as before, now with further conditions.
     * @param owned Dofs of this rank. */
    std::vector<FreeParts>
    free_parts(const ConstraintGraph  &graph,
               const dealii::IndexSet &owned,
               MPI_Comm                communicator) const;

    /** @brief For each entry, whether nodes of its row are free to meet it. Collective, with the
     * parameters of free_parts(). */
    std::vector<bool>
    can_be_met(const ConstraintGraph  &graph,
               const dealii::IndexSet &owned,
               MPI_Comm                communicator) const;

  private:
    std::size_t        n_supports;
    std::vector<Entry> entries;
  };
} // namespace Touchstone

#endif
