// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/search/connected_components.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace Touchstone
{
  std::vector<unsigned int>
  connected_components(const std::vector<const Face *> &faces)
  {
    // Faces with a common node are neighbours in a list that is sorted by nodes: a few dozen
    // entries, for which any table of all nodes of the surface would cost more.
    std::vector<std::pair<Index, unsigned int>> face_of_node;
    for (unsigned int i = 0; i < faces.size(); ++i)
      for (unsigned int m = 0; m < faces[i]->n_nodes(); ++m)
        face_of_node.emplace_back(faces[i]->nodes[m], i);
    std::sort(face_of_node.begin(), face_of_node.end());

    // Disjoint sets of faces, each a tree; the smallest index is the root.
    std::vector<unsigned int> parent(faces.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&parent](unsigned int i) {
      while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
      return i;
    };
    for (std::size_t k = 1; k < face_of_node.size(); ++k)
      if (face_of_node[k].first == face_of_node[k - 1].first)
        {
          const unsigned int a = root(face_of_node[k - 1].second), b = root(face_of_node[k].second);
          // The smaller root wins, so that the number of a component is its smallest index whatever
          // the order of the unions.
          parent[std::max(a, b)] = std::min(a, b);
        }
    for (unsigned int i = 0; i < faces.size(); ++i)
      // Roots instead of parents: equal numbers for all faces of a component.
      parent[i] = root(i);
    return parent;
  }



  bool
  is_connected(const std::vector<const Face *> &faces)
  {
    const std::vector<unsigned int> numbers = connected_components(faces);
    return std::adjacent_find(numbers.begin(), numbers.end(), std::not_equal_to<>()) ==
           numbers.end();
  }
} // namespace Touchstone
