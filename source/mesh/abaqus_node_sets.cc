// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/abaqus_node_sets.h>

#include <algorithm>

namespace Touchstone
{
  namespace
  {
    /** A larger set is taken for a damaged number, which must not fill the memory. */
    constexpr unsigned long largest_set = 100000000;
  } // namespace



  void
  AbaqusNodeSets::add(const AbaqusName               &name,
                      const std::vector<std::string> &words,
                      const unsigned int              instance,
                      const bool                      generate)
  {
    auto &set = sets.insert({name, Set()}).first->second;
    if (!set)
      return;
    std::vector<std::optional<AbaqusNumber>> numbers;
    for (const std::string &word : words)
      numbers.push_back(assembly.number(word, instance));
    if (generate)
      {
        const bool all_numbers =
          std::all_of(numbers.begin(), numbers.end(), [](const auto &n) { return n.has_value(); });
        const unsigned long step = all_numbers && words.size() > 2 ? numbers[2]->second : 1;
        if (!all_numbers || words.size() < 2 || step == 0 ||
            numbers[1]->second / step > largest_set)
          set.reset();
        else
          for (unsigned long n = numbers[0]->second; n <= numbers[1]->second; n += step)
            set->insert({instance, n});
        return;
      }
    for (unsigned int i = 0; i < words.size(); ++i)
      if (numbers[i])
        set->insert(*numbers[i]);
      else
        {
          auto other = sets.find({instance, words[i]});
          if (other == sets.end())
            other = sets.find(assembly.outer_name(words[i]));
          if (other == sets.end() || !other->second)
            {
              set.reset();
              return;
            }
          set->insert(other->second->begin(), other->second->end());
        }
  }



  void
  AbaqusNodeSets::put_into(MeshFile &mesh, const std::map<AbaqusNumber, unsigned int> &node) const
  {
    std::vector<AbaqusName> names;
    for (const auto &set : sets)
      names.push_back(set.first);
    for (const auto &[name, numbers] : sets)
      if (numbers && std::all_of(numbers->begin(), numbers->end(), [&node](const auto &n) {
            return node.count(n) > 0;
          }))
        for (const AbaqusNumber &n : *numbers)
          mesh.node_sets[assembly.short_name(name, names)].insert(node.at(n));
  }
} // namespace Touchstone
