// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/search/connected_components.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <functional>
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

    boost::disjoint_sets_with_storage<> components(faces.size());
    for (std::size_t k = 1; k < face_of_node.size(); ++k)
      if (face_of_node[k].first == face_of_node[k - 1].first)
        components.union_set(face_of_node[k - 1].second, face_of_node[k].second);
    std::vector<unsigned int> numbers;
    for (unsigned int i = 0; i < faces.size(); ++i)
      numbers.push_back(components.find_set(i));
    return numbers;
  }



  bool
  is_connected(const std::vector<const Face *> &faces)
  {
    const std::vector<unsigned int> numbers = connected_components(faces);
    return std::adjacent_find(numbers.begin(), numbers.end(), std::not_equal_to<>()) ==
           numbers.end();
  }
} // namespace Touchstone
