// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/multigrid/aggregation.h>

#include <algorithm>
#include <map>

// Which nodes form one aggregate of smoothed aggregation: greedy, in three passes over the graph
// of strong couplings, on each rank by itself (doc/theory.md, section 8). Aggregates never cross
// bodies or ranks.
namespace Touchstone
{
  namespace
  {
    constexpr int none = -1;

    /** The aggregate of most of the neighbours; of several the one that is met first. */
    int
    most_frequent(const std::vector<int> &neighbours, const std::vector<int> &of_node)
    {
      std::map<int, int> votes;
      int                best = none, most = 0;
      for (const int j : neighbours)
        if (of_node[j] != none && ++votes[of_node[j]] > most)
          {
            best = of_node[j];
            most = votes[best];
          }
      return best;
    }
  } // namespace



  Aggregates
  aggregate(std::vector<std::vector<int>> graph, const std::vector<unsigned int> &body)
  {
    // Couplings between bodies come from contact that has been condensed; they must not form
    // aggregates, see the header.
    const int n_nodes = static_cast<int>(graph.size());
    for (int i = 0; i < n_nodes; ++i)
      {
        auto &neighbours = graph[i];
        neighbours.erase(std::remove_if(neighbours.begin(),
                                        neighbours.end(),
                                        [&](const int j) { return body[j] != body[i]; }),
                         neighbours.end());
      }

    Aggregates        result;
    std::vector<int> &of_node = result.of_node;
    of_node.assign(n_nodes, none);
    const auto free   = [&](const int j) { return of_node[j] == none; };
    const auto gather = [&](const int root) {
      for (const int j : graph[root])
        if (free(j))
          of_node[j] = result.n;
      of_node[root] = result.n++;
    };
    // First pass: nodes whose neighbourhoods are still free become roots, with all their
    // neighbours. So aggregates are about three nodes wide, the width for which one step of
    // Jacobi's method smooths them enough.
    for (int i = 0; i < n_nodes; ++i)
      if (free(i) && !graph[i].empty() && std::all_of(graph[i].begin(), graph[i].end(), free))
        gather(i);
    // Second pass: nodes left between these join the neighbouring aggregate to which most of
    // their neighbours belong. Only aggregates of the first pass count, or they would grow in
    // chains. Third pass: what touches none forms its own with its free neighbours, or joins one
    // of the second pass.
    const std::vector<int> whole = of_node;
    for (int i = 0; i < n_nodes; ++i)
      if (free(i))
        of_node[i] = most_frequent(graph[i], whole);
    for (int i = 0; i < n_nodes; ++i)
      if (free(i))
        {
          if (std::any_of(graph[i].begin(), graph[i].end(), free))
            gather(i);
          else
            of_node[i] = most_frequent(graph[i], of_node);
        }
    return result;
  }
} // namespace Touchstone
