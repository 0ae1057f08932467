// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/base/orthogonal.h>
#include <touchstone/contact/enforcement/refused_conditions.h>

#include <deal.II/base/mpi.h>

#include <map>

// Which refused conditions the nodes of a row can meet (doc/theory.md 6, "Slave nodes that are not
// free"): supports of master nodes are known to the ranks that own them.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The coefficients of a node in an entry of the rank that asks. */
    struct Query
    {
      std::size_t    entry;
      Index          node;
      bool           slave;
      Tensor<1, dim> coefficients;
    };

    /** Coefficients of the slave node and of the others of an entry, and what of these is free. */
    struct Free
    {
      double slave = 0., slave_free = 0., others = 0., others_free = 0.;

      bool
      enough() const
      {
        // A slave node that supports leave free moves with the row that determines it. Of the
        // others half of the weight: where they are held but for small weights, as beside an edge
        // at which both bodies are fixed, these would have to move by many times the gap.
        return slave_free > 0.1 * slave || others_free > 0.5 * others;
      }
    };

    /** Orthonormal directions in which supports hold each of some nodes. */
    std::map<Index, std::vector<Tensor<1, dim>>>
    held_directions(const std::vector<Condition>          &conditions,
                    const std::size_t                      n_supports,
                    const std::vector<std::vector<Query>> &queries,
                    const IndexSet                        &owned)
    {
      std::map<Index, std::vector<Tensor<1, dim>>> held;
      for (const std::vector<Query> &of_rank : queries)
        for (const Query &query : of_rank)
          if (owned.is_element(dim * query.node))
            held.emplace(query.node, std::vector<Tensor<1, dim>>());
      for (std::size_t k = 0; k < n_supports; ++k)
        if (const auto found = held.find(conditions[k].node); found != held.end())
          {
            const Tensor<1, dim> direction =
              orthogonal_part(conditions[k].direction, found->second);
            // The graph has accepted it, so that a part is left.
            found->second.push_back(direction / direction.norm());
          }
      return held;
    }
  } // namespace



  std::vector<bool>
  RefusedConditions::can_be_met(const ConstraintGraph &graph,
                                const IndexSet        &owned,
                                const MPI_Comm         communicator) const
  {
    if (Utilities::MPI::max(static_cast<int>(!entries.empty()), communicator) == 0)
      return {};
    std::vector<Query> mine;
    for (std::size_t k = 0; k < entries.size(); ++k)
      {
        const Condition &condition = entries[k].condition;
        for (const auto &[node, coefficients] :
             relative_motion(condition.node, condition.stencil, condition.direction))
          mine.push_back({k, node, node == condition.node, coefficients});
      }
    const auto queries = gather_records(mine, communicator);
    const auto held    = held_directions(graph.accepted(), n_supports, queries, owned);

    // By rank and entry, as numbers that are summed over all ranks.
    constexpr unsigned int   n = sizeof(Free) / sizeof(double);
    std::vector<std::size_t> begin(1, 0);
    for (const std::vector<Query> &of_rank : queries)
      begin.push_back(begin.back() + (of_rank.empty() ? 0 : of_rank.back().entry + 1));
    std::vector<double> sums(n * begin.back());
    for (std::size_t rank = 0; rank < queries.size(); ++rank)
      for (const Query &query : queries[rank])
        if (const auto found = held.find(query.node); found != held.end())
          {
            double *const sum = &sums[n * (begin[rank] + query.entry) + (query.slave ? 0 : 2)];
            sum[0] += query.coefficients.norm();
            sum[1] += orthogonal_part(query.coefficients, found->second).norm();
          }
    Utilities::MPI::sum(sums, communicator, sums);

    std::vector<bool> result;
    const std::size_t first = n * begin[Utilities::MPI::this_mpi_process(communicator)];
    for (std::size_t k = 0; k < entries.size(); ++k)
      {
        const double *const sum = &sums[first + n * k];
        result.push_back(Free{sum[0], sum[1], sum[2], sum[3]}.enough());
      }
    return result;
  }
} // namespace Touchstone
