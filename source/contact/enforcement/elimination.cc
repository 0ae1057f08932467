// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/exact_enforcement.h>
#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/contact/friction/friction_response.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>
#include <set>

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
      /** Whatever is not round-off must not lead back. */
      double
      cycle_threshold() const override
      {
        return 1e-12;
      }

      ConstraintGraph::Treatment
      treatment(const ContactRow &row) const override
      {
        return kept.count({row.pair, row.slave}) > 0 ? ConstraintGraph::Treatment::multiplier
                                                     : ConstraintGraph::Treatment::eliminate;
      }

      void
      prepare(const Contact &contact, LinearSystem &system) override
      {
        const MPI_Comm communicator = system.rhs.get_mpi_communicator();
        kept.clear();
        eliminated = active_slaves(contact, communicator);
        if (system.takes_multipliers && !system.keep_symmetric)
          {
            for (const ContactRow &row : contact.rows())
              if (row_states[row].active() && row.friction && row.derivative &&
                  refers_to_others(row))
                kept.insert({row.pair, row.slave});
            for (const auto &of_rank : Utilities::MPI::all_gather(
                   communicator,
                   std::vector<std::pair<unsigned int, Index>>(kept.begin(), kept.end())))
              for (const auto &slave : of_rank)
                eliminated.erase(slave);
          }
        if (system.keep_symmetric)
          for (const ContactRow &row : contact.rows())
            lag_friction(row, row_states[row], row_states[row].lambda);
      }

      /** Slave nodes whose conditions refer to each other cannot all be eliminated: each
       * takes its neighbours to move like itself. */
      void
      adjust(const ContactRow &row, Condition &condition) const override
      {
        if (kept.count({row.pair, row.slave}) > 0)
          return;
        Tensor<1, dim> lagged;
        for (auto &[node, coefficients] : condition.gradient)
          if (node != row.slave && eliminated.count({row.pair, node}) > 0)
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
        // What is an unknown can take part of the force of a condition at the same node.
        std::vector<double>       result = ExactEnforcement::multipliers(accepted, solution);
        const std::vector<double> all =
          solution.graph.forces(solution.system.residual(solution.increment, solution.extra),
                                solution.condense);
        for (std::size_t k = 0; k < accepted.size(); ++k)
          result[k] += all[accepted[k].number];
        return result;
      }

    private:
      using Slaves = std::set<std::pair<unsigned int, Index>>;
      /** Pairs and slave nodes of rows whose conditions are eliminated, of all ranks, and those
       * whose forces are unknowns, of this rank. */
      Slaves eliminated, kept;

      /**
       * Whether taking other slave nodes to move like itself leaves too much of a condition of the
       * row. What it leaves comes back in each iteration, so Newton's method would converge
       * linearly, by about this factor: over one or two nodes in contact, at the edge of what is
       * covered, hardly at all. Without friction the iterations with frozen normals that precede
       * have seen to most of it, and where gaps have kinks multipliers go to and fro between them.
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
              if (node != row.slave && eliminated.count({row.pair, node}) > 0)
                others += coefficients.norm();
            if (others > much)
              return true;
          }
        return false;
      }

      /** Pairs and slave nodes of all active rows, if any of this rank's rows has a
       * derivative. Collective. */
      Slaves
      active_slaves(const Contact &contact, const MPI_Comm communicator) const
      {
        int                                         needed = 0;
        std::vector<std::pair<unsigned int, Index>> mine;
        for (const ContactRow &row : contact.rows())
          if (row_states[row].active())
            {
              mine.emplace_back(row.pair, row.slave);
              needed |= (row.derivative != nullptr);
            }
        Slaves all;
        if (Utilities::MPI::max(needed, communicator) == 1)
          for (const auto &of_rank : Utilities::MPI::all_gather(communicator, mine))
            all.insert(of_rank.begin(), of_rank.end());
        return all;
      }
    };

    const EnforcementRegistry::Entry<Elimination>
      elimination_entry("elimination", "slave components condensed out; any solver");
  } // namespace
} // namespace Touchstone
