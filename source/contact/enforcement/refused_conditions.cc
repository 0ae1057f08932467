// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/ask_owners.h>
#include <touchstone/base/orthogonal.h>
#include <touchstone/contact/enforcement/refused_conditions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// Which refused conditions the nodes of a row can meet (doc/theory.md 6, "Slave nodes that are not
// free"): supports of master nodes are known to the ranks that own them.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A node of an entry and its coefficients there, which its owner is asked about. */
    struct NodeOfEntry
    {
      Index          node;
      Tensor<1, dim> coefficients;
    };

    /** Of an entry, or a node of it: the size of coefficients, and what of these is free. */
    struct Free
    {
      double all = 0., free = 0.;

      void
      add(const Free &other)
      {
        all += other.all;
        free += other.free;
      }

      double
      part() const
      {
        return all > 0. ? free / all : 0.;
      }
    };

    /** Orthonormal directions in which supports hold nodes, by node. */
    class HeldDirections
    {
    public:
      HeldDirections(const std::vector<Condition> &conditions, const std::size_t n_supports)
        : conditions(conditions)
      {
        for (std::size_t k = 0; k < n_supports; ++k)
          supports.emplace_back(conditions[k].node, k);
        std::sort(supports.begin(), supports.end());
      }

      std::vector<Tensor<1, dim>>
      of(const Index node) const
      {
        std::vector<Tensor<1, dim>> result;
        for (auto support = std::lower_bound(supports.begin(),
                                             supports.end(),
                                             std::make_pair(node, std::size_t(0)));
             support != supports.end() && support->first == node;
             ++support)
          {
            const Tensor<1, dim> direction =
              orthogonal_part(conditions[support->second].direction, result);
            // The graph has accepted it, so that a part is left.
            result.push_back(direction / direction.norm());
          }
        return result;
      }

    private:
      const std::vector<Condition>              &conditions;
      std::vector<std::pair<Index, std::size_t>> supports;
    };
  } // namespace



  std::vector<RefusedConditions::FreeParts>
  RefusedConditions::free_parts(const ConstraintGraph &graph,
                                const IndexSet        &owned,
                                const MPI_Comm         communicator) const
  {
    if (Utilities::MPI::max(static_cast<int>(!entries.empty()), communicator) == 0)
      return {};
    std::vector<NodeOfEntry> asked;
    std::vector<std::size_t> entry_of;
    for (std::size_t k = 0; k < entries.size(); ++k)
      {
        const Condition &condition = entries[k].condition;
        for (const auto &[node, coefficients] :
             relative_motion(condition.node, condition.stencil, condition.direction))
          {
            asked.push_back({node, coefficients});
            entry_of.push_back(k);
          }
      }
    const HeldDirections    held(graph.accepted(), n_supports);
    const std::vector<Free> answers = ask_owners<Free>(
      asked,
      owned,
      communicator,
      [](const NodeOfEntry &of) { return dim * of.node; },
      [&](const NodeOfEntry &of) {
        return Free{of.coefficients.norm(),
                    orthogonal_part(of.coefficients, held.of(of.node)).norm()};
      });

    std::vector<Free> slaves(entries.size()), others(entries.size());
    for (std::size_t i = 0; i < asked.size(); ++i)
      {
        const std::size_t k = entry_of[i];
        (asked[i].node == entries[k].condition.node ? slaves : others)[k].add(answers[i]);
      }
    std::vector<FreeParts> result;
    for (std::size_t k = 0; k < entries.size(); ++k)
      result.push_back({slaves[k].part(), others[k].part()});
    return result;
  }



  std::vector<bool>
  RefusedConditions::can_be_met(const ConstraintGraph &graph,
                                const IndexSet        &owned,
                                const MPI_Comm         communicator) const
  {
    std::vector<bool> result;
    for (const FreeParts &parts : free_parts(graph, owned, communicator))
      result.push_back(parts.can_meet());
    return result;
  }
} // namespace Touchstone
