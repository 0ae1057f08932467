// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/ask_owners.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/exact_enforcement.h>
#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/contact/friction/friction_response.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <boost/serialization/utility.hpp>
#include <map>
#include <set>

// Enforcement by elimination (doc/theory.md 6 and 6.3): conditions are condensed out of the system,
// which stays positive definite without friction and fits any solver. Only rows whose condition
// depends too much on other slave nodes, and rows between nodes, keep multipliers, where the system
// is factorised anyway.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Each condition determines one displacement component of its slave node, which is
     * condensed out; the forces follow from the residual of the linear system. */
    class Elimination : public ExactEnforcement
    {
    public:
      explicit Elimination(const ContactParameters &)
      {
      }

    protected:
      ConstraintGraph::Treatment
      treatment(const ContactRow &row) const override
      {
        return kept.count(row.index) > 0 ? ConstraintGraph::Treatment::multiplier
                                         : ConstraintGraph::Treatment::eliminate;
      }

      void
      prepare(const Contact &contact, LinearSystem &system) override
      {
        const MPI_Comm communicator = system.rhs.get_mpi_communicator();
        // Stencils cross partitions, hence the collective exchange; both sets are made anew for
        // each system as rows open and close.
        kept.clear();
        if (system.takes_multipliers)
          for (const ContactRow &row : contact.rows())
            if (row_states[row].active() && row.between_nodes)
              kept.insert(row.index);
        eliminated = active_slaves(contact, communicator);
        if (system.takes_multipliers && !system.keep_symmetric)
          {
            for (const ContactRow &row : contact.rows())
              if (row_states[row].active() && row.derivative && refers_to_others(row))
                kept.insert(row.index);
            eliminated = active_slaves(contact, communicator);
          }
        if (!system.takes_multipliers)
          check_order(contact, communicator);
        // Solvers for symmetric systems cannot take the direction n + L' tau of equation (22).
        if (system.keep_symmetric)
          for (const ContactRow &row : contact.rows())
            lag_friction(row, row_states[row], row_states[row].lambda);
      }

      /** Slave nodes whose conditions refer to each other cannot all be eliminated: in the
       * condition of each node its neighbours are assumed to have the same displacement increment
       * as the node itself (doc/theory.md 6.3, "Elimination"). */
      void
      adjust(const ContactRow &row, Condition &condition) const override
      {
        if (kept.count(row.index) > 0)
          return;
        // The coefficients of other eliminated slave nodes are moved to the row's own node, so that
        // the sum over all nodes stays what it was and a common translation violates nothing.
        Tensor<1, dim> lagged;
        for (auto &[node, coefficients] : condition.gradient)
          if (is_lagged(row, node))
            {
              lagged += coefficients;
              coefficients = Tensor<1, dim>();
            }
        if (lagged.norm_square() > 0.)
          condition.gradient.emplace_back(row.slave, lagged);
      }

      std::vector<double>
      multipliers(const std::vector<Accepted> &accepted,
                  const LinearSolution        &solution) const override
      {
        // A condition with a multiplier is zero in `all` unless eliminated conditions at the same
        // node are combined with it; so both parts are added. The latter follow from the residual
        // of the linear system, doc/theory.md 6, equation (14).
        std::vector<double>       result = ExactEnforcement::multipliers(accepted, solution);
        const std::vector<double> all =
          solution.graph.forces(solution.system.residual(solution.increment, solution.extra),
                                solution.condense);
        for (std::size_t k = 0; k < accepted.size(); ++k)
          if (accepted[k].treatment != ConstraintGraph::Treatment::spring)
            result[k] += all[accepted[k].number];
        return result;
      }

    private:
      /** A slave node of a pair. */
      struct SlaveNode
      {
        unsigned int pair;
        Index        node;

        bool
        operator<(const SlaveNode &other) const
        {
          return pair != other.pair ? pair < other.pair : node < other.node;
        }
      };
      using Slaves = std::set<SlaveNode>;
      /** Slave nodes of rows whose conditions are eliminated: of this rank, and those of other
       * ranks that rows of this one refer to. */
      Slaves eliminated;
      /** Indices of rows whose forces are multipliers in the linear system, of this rank. */
      std::set<std::size_t> kept;

      /** Forces of rows are found one after the other, the later ones from the earlier: rows
       * between nodes that refer to each other's slave nodes have no such order. References to
       * slave nodes of other pairs are small, see CyclicConstraints. Collective.
       * @throws UnresolvedContactFailure */
      void
      check_order(const Contact &contact, const MPI_Comm communicator) const
      {
        std::multimap<SlaveNode, SlaveNode> refers;
        for (const ContactRow &row : contact.rows())
          if (row_states[row].active())
            for (const StencilEntry &entry : row.stencil)
              if (entry.weight < 0.)
                refers.insert({{row.pair, row.slave}, {row.pair, entry.node}});
        // Nodes that refer to none are last in the order, as their owners know; what is left is
        // on a cycle of references, or leads to one.
        int left = 1;
        for (int removed = 1; removed > 0 && left > 0;)
          {
            left = Utilities::MPI::max(static_cast<int>(!refers.empty()), communicator);
            if (left == 0)
              break;
            Slaves referred;
            for (const auto &[from, to] : refers)
              referred.insert(to);
            const std::vector<SlaveNode> known = known_to_owners(
              std::vector<SlaveNode>(referred.begin(), referred.end()),
              contact.solid_model().owned,
              communicator,
              [](const SlaveNode &slave) { return dim * slave.node; },
              [&](const SlaveNode &slave) { return refers.count(slave) > 0; });
            const Slaves refer(known.begin(), known.end());
            removed = 0;
            for (auto entry = refers.begin(); entry != refers.end();)
              if (refer.count(entry->second) == 0)
                {
                  entry   = refers.erase(entry);
                  removed = 1;
                }
              else
                ++entry;
            removed = Utilities::MPI::max(removed, communicator);
          }
        if (left > 0)
          throw UnresolvedContactFailure(
            "edges or vertices touch the same slave edge or face in several points, whose slave "
            "unknowns cannot all be eliminated by an iterative solver. Set 'Linear solver/Type = "
            "MUMPS', or 'Contact/Enforcement' to 'augmented lagrange' or 'penalty'");
      }

      /** Whether a node that the condition of a row refers to is one of the eliminated slave nodes
       * of the same pair that adjust() takes to move with the node of the row. Not what that node
       * touches, where a body touches itself: such chains end, see CyclicConstraints, and are
       * eliminated one after the other. */
      bool
      is_lagged(const ContactRow &row, const Index node) const
      {
        return node != row.slave && eliminated.count({row.pair, node}) > 0 &&
               std::none_of(row.stencil.begin(), row.stencil.end(), [node](const auto &entry) {
                 return entry.node == node && entry.weight > Tolerances::negligible_weight;
               });
      }

      /**
       * Whether the assumption of adjust() would neglect too large a part of a condition of the
       * row. The error returns in each iteration, so that Newton's method converges linearly, with
       * about this part as its factor: hardly or not at all if only one or two nodes touch or a
       * face is covered in part. Rows have derivatives in consistent iterations alone, whose system
       * is unsymmetric anyway.
       */
      bool
      refers_to_others(const ContactRow &row) const
      {
        constexpr double much = 0.05;
        for (const Condition &condition :
             row_conditions(row, row_states[row], /*keep_symmetric=*/false))
          {
            double others = 0.;
            for (const auto &[node, coefficients] : condition.gradient)
              if (is_lagged(row, node))
                others += coefficients.norm();
            if (others > much)
              return true;
          }
        return false;
      }

      /** Slave nodes of active rows that are not kept, if any rank's rows have a derivative: those
       * of this rank, and what their owners say of others that rows of this rank refer to. Rows are
       * where their slave nodes are owned. Collective. */
      Slaves
      active_slaves(const Contact &contact, const MPI_Comm communicator) const
      {
        int    needed = 0;
        Slaves mine, referred;
        for (const ContactRow &row : contact.rows())
          if (row_states[row].active() && kept.count(row.index) == 0)
            {
              mine.insert({row.pair, row.slave});
              needed |= (row.derivative != nullptr);
            }
        if (Utilities::MPI::max(needed, communicator) == 0)
          return {};
        for (const ContactRow &row : contact.rows())
          if (row_states[row].active())
            {
              const auto refer = [&](const Index node) { referred.insert({row.pair, node}); };
              for (const StencilEntry &entry : row.stencil)
                refer(entry.node);
              if (row.derivative)
                for (const Index node : row.derivative->nodes)
                  refer(node);
              if (row.friction)
                for (const auto &slip : row.friction->kinematics.slip_gradient)
                  refer(slip.first);
            }
        const std::vector<SlaveNode> known = known_to_owners(
          std::vector<SlaveNode>(referred.begin(), referred.end()),
          contact.solid_model().owned,
          communicator,
          [](const SlaveNode &slave) { return dim * slave.node; },
          [&](const SlaveNode &slave) { return mine.count(slave) > 0; });
        mine.insert(known.begin(), known.end());
        return mine;
      }
    };

    const EnforcementRegistry::Entry<Elimination>
      elimination_entry("elimination", "slave components condensed out; any solver");
  } // namespace
} // namespace Touchstone
