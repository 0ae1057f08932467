// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/base/non_convergence.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>

// Forces of eliminated conditions, from the balance at the eliminated dofs (doc/theory.md, section
// 7).
namespace Touchstone
{
  using namespace dealii;

  // Forces mu of eliminated conditions, in units of force, from balance at the eliminated dofs.
  // Sweeps repeat until nothing changes: a force also acts on the dofs of its stencil, and if one
  // of these is eliminated by another condition, that one gets its share in the next sweep.
  std::vector<double>
  ConstraintGraph::forces(Vector rest, const std::function<void(Vector &)> &condense) const
  {
    // r_p + sum_k mu_k F_kp = 0 for the eliminated dofs p (doc/theory.md, section 7) is solved by
    // substitution. Where conditions refer to dofs that others eliminate in chains, that ends after
    // as many passes as the longest has members; in cycles of small coefficients, the only ones
    // that are accepted (doc/theory.md 6, "Cyclic constraints"), it converges.
    constexpr unsigned int longest   = 1000;
    constexpr double       round_off = 1e-14;

    condense(rest);
    std::map<Index, Tensor<1, dim>> by_pivot;
    double                          largest = 0.;
    for (unsigned int pass = 0;; ++pass)
      {
        if (pass == longest)
          throw SingularSystem(
            "conditions of contact depend on each other in a cycle: take another "
            "'Contact/Enforcement', or other slaves and masters");
        std::vector<Index>  dofs;
        std::vector<double> values;
        double              change = 0.;
        for (const auto &[node, reduced] : nodes)
          for (unsigned int k = 0; k < reduced.size(); ++k)
            {
              if (reduced[k].treatment != Treatment::eliminate)
                continue;
              const Side  &side  = reduced[k].test;
              const double force = -rest(dim * node + reduced[k].pivot);
              by_pivot[node][k] += force;
              change  = std::max(change, std::abs(force));
              largest = std::max(largest, std::abs(by_pivot[node][k]));
              for (unsigned int d = 0; d < dim; ++d)
                {
                  dofs.push_back(dim * node + d);
                  values.push_back(force * side.direction[d]);
                }
              for (const auto &[dof, coefficient] : side.others)
                {
                  dofs.push_back(dof);
                  values.push_back(force * coefficient);
                }
            }
        const MPI_Comm communicator = rest.get_mpi_communicator();
        if (Utilities::MPI::max(change, communicator) <=
            round_off * Utilities::MPI::max(largest, communicator))
          break;
        // Stencils reach nodes of other ranks, so the sum is collective; so is the decision to
        // stop above.
        rest.add(dofs, values);
        rest.compress(VectorOperation::add);
        condense(rest);
      }

    // From reduced conditions back to those that were accepted: reduced condition k is the sum of
    // accepted conditions times origin, and its force counts for each of them in that proportion.
    std::vector<double> result(conditions.size(), 0.);
    for (std::size_t i = 0; i < conditions.size(); ++i)
      {
        const auto &reduced = nodes.at(conditions[i].node);
        for (unsigned int k = 0; k < reduced.size(); ++k)
          if (reduced[k].treatment == Treatment::eliminate)
            result[i] += by_pivot.at(conditions[i].node)[k] * reduced[k].test.origin[numbers[i]];
      }
    return result;
  }
} // namespace Touchstone
