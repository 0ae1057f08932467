#include <touchstone/contact/exact_enforcement.h>
#include <touchstone/contact/row_terms.h>

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

      /** Whatever is not round-off must not lead back. */
      double
      smallest_circle() const override
      {
        return 1e-12;
      }

    protected:
      ConstraintGraph::Treatment
      treatment() const override
      {
        return ConstraintGraph::Treatment::eliminate;
      }

      void
      prepare(Contact &contact, const LinearSystem &system) override
      {
        active = active_slaves(contact, system.rhs.get_mpi_communicator());
        if (system.keep_symmetric)
          for (auto &pair_rows : contact.rows)
            for (ContactRow &row : pair_rows)
              lag_friction(row, row.lambda);
      }

      /** Slave nodes whose conditions refer to each other cannot all be eliminated: each
       * takes its neighbours to move like itself. */
      void
      adjust(const ContactRow &row, Condition &condition) const override
      {
        Tensor<1, dim> lagged;
        for (auto &[node, coefficients] : condition.gradient)
          if (node != row.slave && active.count({row.pair, node}) > 0)
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
        const std::vector<double> all =
          solution.graph.forces(solution.system.residual(solution.increment, solution.extra),
                                solution.condense);
        std::vector<double> result;
        for (const Accepted &entry : accepted)
          result.push_back(all[entry.number]);
        return result;
      }

    private:
      using Slaves = std::set<std::pair<unsigned int, Index>>;
      Slaves active;

      /** Pairs and slave nodes of all active rows, if any of this rank's rows has a
       * derivative. Collective. */
      static Slaves
      active_slaves(const Contact &contact, const MPI_Comm communicator)
      {
        int                                         needed = 0;
        std::vector<std::pair<unsigned int, Index>> mine;
        for (const auto &pair_rows : contact.rows)
          for (const ContactRow &row : pair_rows)
            if (row.active())
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
      entry("elimination", "slave components condensed out; any solver");
  } // namespace
} // namespace Touchstone
