// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/strong_components.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/strong_components.hpp>

namespace Touchstone
{
  std::vector<std::vector<unsigned int>>
  strong_components(const unsigned int                                        n,
                    const std::vector<std::pair<unsigned int, unsigned int>> &edges)
  {
    const boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS> graph(edges.begin(),
                                                                                  edges.end(),
                                                                                  n);
    std::vector<unsigned int>                                               component(n);
    std::vector<std::vector<unsigned int>>                                  result;
    if (n > 0)
      result.resize(
        boost::strong_components(graph,
                                 boost::make_iterator_property_map(
                                   component.begin(), boost::get(boost::vertex_index, graph))));
    for (unsigned int i = 0; i < n; ++i)
      result[component[i]].push_back(i);
    return result;
  }
} // namespace Touchstone
