#include <touchstone/contact/enforcement.h>
#include <touchstone/contact/row_terms.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>
#include <cmath>
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

        // The contact force balances the slave node in the directions that no
        // prescribed displacement balances. One sweep does it, unless slave nodes
        // are master nodes of other rows, or belong to two pairs.
        for (unsigned int sweep = 0; sweep < 50; ++sweep)
          {
            Vector force(unbalanced);
            contact.add_forces(force);
            double                          change = 0., largest = 0.;
            std::map<Index, Tensor<1, dim>> corrections;
            for (auto &pair_rows : contact.rows)
              for (ContactRow &row : pair_rows)
                {
                  if (!row.active() || row.dropped())
                    continue;
                  Tensor<1, dim> rest = corrections[row.slave];
                  for (unsigned int d = 0; d < dim; ++d)
                    rest[d] += force(dim * row.slave + d);
                  const Tensor<1, dim> before = row.force;
                  if (row.held())
                    {
                      row.force -= graph.free_part(row.slave, rest);
                      row.lambda = row.force * row.normal;
                      if (row.friction)
                        row.friction->base = row.force - row.lambda * row.normal;
                      respond(row);
                    }
                  else
                    {
                      const Tensor<1, dim> normal = graph.free_part(row.slave, row.normal);
                      const double         square = normal.norm_square();
                      // The force follows the present normal.
                      Tensor<1, dim> friction;
                      if (row.friction)
                        friction = before - (before * row.normal) * row.normal;
                      row.lambda =
                        square > 1e-6 ? ((before - friction - rest) * normal) / square : 0.;
                      respond(row);
                    }
                  const Tensor<1, dim> correction = row.force - before;
                  corrections[row.slave] += correction;
                  change  = std::max(change, correction.norm());
                  largest = std::max(largest, row.force.norm());
                }
            if (Utilities::MPI::max(change, unbalanced.get_mpi_communicator()) <=
                1e-13 * Utilities::MPI::max(largest, unbalanced.get_mpi_communicator()))
              break;
          }
      }

      void
      enforce(Contact &contact, ConstraintGraph &graph, LinearSystem &system) override
      {
        const auto active = active_slaves(contact, system.rhs.get_mpi_communicator());
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            for (Condition &condition : start_row(row, system.keep_symmetric))
              {
                // Slave nodes whose conditions refer to each other cannot all be
                // eliminated: each takes its neighbours to move like itself.
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
      /** Pairs and slave nodes of all active rows, if any of this rank's rows has a
       * derivative. Collective. */
      static std::set<std::pair<unsigned int, Index>>
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
        std::set<std::pair<unsigned int, Index>> all;
        if (Utilities::MPI::max(needed, communicator) == 1)
          for (const auto &of_rank : Utilities::MPI::all_gather(communicator, mine))
            all.insert(of_rank.begin(), of_rank.end());
        return all;
      }
    };

    const EnforcementRegistry::Entry<Elimination>
      entry("elimination", "slave components condensed out; positive definite, any solver");
  } // namespace
} // namespace Touchstone
