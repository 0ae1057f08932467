#include <touchstone/contact/balance.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace Touchstone
{
  using namespace dealii;

  void
  balance_slave_nodes(Contact                                       &contact,
                      const Vector                                  &unbalanced,
                      const ConstraintGraph                         &graph,
                      const std::function<bool(const ContactRow &)> &applies)
  {
    // One sweep does it, unless slave nodes are master nodes of other rows, or
    // belong to two pairs.
    for (unsigned int sweep = 0; sweep < 50; ++sweep)
      {
        Vector force(unbalanced);
        contact.add_forces(force);
        double                          change = 0., largest = 0.;
        std::map<Index, Tensor<1, dim>> corrections;
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            {
              if (!row.active() || row.dropped() || !applies(row))
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
                  row.lambda = square > 1e-6 ? ((before - friction - rest) * normal) / square : 0.;
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
} // namespace Touchstone
