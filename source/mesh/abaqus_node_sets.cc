// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/abaqus_node_sets.h>

#include <algorithm>

namespace Touchstone
{
  namespace
  {
    /** A larger set is taken for a damaged number, which must not fill the memory. */
    constexpr unsigned long largest_set = 100000000;

    bool
    is_number(const std::string &word)
    {
      return !word.empty() && word.size() < 18 &&
             word.find_first_not_of("0123456789") == std::string::npos;
    }
  } // namespace



  void
  AbaqusNodeSets::add(const std::string              &name,
                      const std::vector<std::string> &words,
                      const bool                      generate)
  {
    auto &set = sets.insert({name, std::set<unsigned long>()}).first->second;
    if (!set)
      return;
    if (generate)
      {
        const bool          numbers = std::all_of(words.begin(), words.end(), is_number);
        const unsigned long step    = numbers && words.size() > 2 ? std::stoul(words[2]) : 1;
        if (!numbers || words.size() < 2 || step == 0 || std::stoul(words[1]) / step > largest_set)
          set.reset();
        else
          for (unsigned long n = std::stoul(words[0]); n <= std::stoul(words[1]); n += step)
            set->insert(n);
        return;
      }
    for (const std::string &word : words)
      if (is_number(word))
        set->insert(std::stoul(word));
      else if (const auto other = sets.find(word); other != sets.end() && other->second)
        set->insert(other->second->begin(), other->second->end());
      else
        {
          set.reset();
          return;
        }
  }



  void
  AbaqusNodeSets::put_into(MeshFile &mesh, const std::map<unsigned long, unsigned int> &node) const
  {
    for (const auto &[name, numbers] : sets)
      if (numbers && std::all_of(numbers->begin(), numbers->end(), [&node](const unsigned long n) {
            return node.count(n) > 0;
          }))
        for (const unsigned long n : *numbers)
          mesh.node_sets[name].insert(node.at(n));
  }
} // namespace Touchstone
