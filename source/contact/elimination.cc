#include <touchstone/contact/balance.h>
#include <touchstone/contact/enforcement.h>
#include <touchstone/contact/row_terms.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>
#include <set>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Each condition determines one displacement component of its slave node,
     * which is condensed out; forces come from the residual. */
    class Elimination : public Enforcement
    {
    public:
      explicit Elimination(const ContactParameters &)
      {
      }

      void
      recover(Contact &contact, const Vector &unbalanced, const ConstraintGraph &graph) override
      {
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            if (row.friction)
              choose_friction(row);

        balance_slave_nodes(contact, unbalanced, graph, [](const ContactRow &) { return true; });
      }

      void
      enforce(Contact &contact, ConstraintGraph &graph, LinearSystem &system) override
      {
        const auto active = active_slaves(contact, system.rhs.get_mpi_communicator());
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            {
              if (system.keep_symmetric)
                lag_friction(row, row.lambda);
              for (Condition &condition : start_row(row, system.keep_symmetric))
                offer(row, condition, active, graph);
            }
      }

      void
      update(Contact &, const std::vector<double> &) override
      {
      }

      /** Whatever is not round-off must not lead back. */
      double
      smallest_circle() const override
      {
        return 1e-12;
      }

    private:
      using Slaves = std::set<std::pair<unsigned int, Index>>;

      /** Offer a condition to the graph. Slave nodes whose conditions refer to each
       * other cannot all be eliminated: each takes its neighbours to move like
       * itself. */
      static void
      offer(ContactRow &row, Condition &condition, const Slaves &active, ConstraintGraph &graph)
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
        row.take(graph.accept(condition));
      }

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
