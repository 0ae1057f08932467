// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/gmsh_groups.h>

#include <cstdlib>
#include <set>

namespace Touchstone
{
  void
  GmshGroups::read_names(MeshText &text)
  {
    // A name may contain blanks, so the rest of the line is taken between its first and last
    // quotation mark.
    const char *section = "$PhysicalNames";
    for (auto left = text.number(section); left > 0; --left)
      {
        const auto        d      = text.number(section);
        const auto        number = text.number(section);
        const std::string quoted = text.rest_of_line();
        const auto        first = quoted.find('"'), last = quoted.rfind('"');
        if (d > 3 || first == last)
          text.fail("$PhysicalNames is damaged.");
        const std::string name = quoted.substr(first + 1, last - first - 1);
        for (const auto &[other, known] : names[d])
          if (other == number || (known == name && d > 1))
            text.fail("'" + known + "' is the name of physical group " + std::to_string(other) +
                        ", and '" + name + "' that of " + std::to_string(number) + ".",
                      "give each physical group one name of its own");
        names[d][number] = name;
      }
  }



  std::vector<unsigned int>
  GmshGroups::read_groups(const char *section, const unsigned int d, GmshNumbers &numbers)
  {
    const unsigned int n_bounds = d == 0 ? 3 : 6; // a point, or a box
    for (unsigned int b = 0; b < n_bounds; ++b)
      numbers.real(section);
    std::vector<unsigned int> groups;
    for (auto left = numbers.size(section); left > 0; --left)
      groups.push_back(std::abs(numbers.integer(section)));
    if (d > 0) // the entities of its boundary
      for (auto left = numbers.size(section); left > 0; --left)
        numbers.integer(section);
    return groups;
  }



  void
  GmshGroups::read_entities(MeshText &text, GmshNumbers &numbers)
  {
    has_entities          = true;
    const char   *section = "$Entities";
    unsigned long n[4];
    for (unsigned long &count : n)
      count = numbers.size(section);
    for (unsigned int d = 0; d < 4; ++d)
      for (unsigned long i = 0; i < n[d]; ++i)
        {
          const auto entity = numbers.tag(section);
          if (!physical[d].insert({entity, read_groups(section, d, numbers)}).second)
            text.fail("Entity " + std::to_string(entity) + " of dimension " + std::to_string(d) +
                        " appears twice.",
                      "remove one of the two from the file");
        }
  }



  void
  GmshGroups::read_partitioned_entities(MeshText &text, GmshNumbers &numbers)
  {
    has_entities             = true;
    const char *section      = "$PartitionedEntities";
    const auto  n_partitions = numbers.size(section);
    for (auto left = numbers.size(section); left > 0; --left)
      {
        numbers.integer(section); // of ghost cells, and their partition
        numbers.integer(section);
      }
    unsigned long n[4];
    for (unsigned long &count : n)
      count = numbers.size(section);
    std::set<long> with_cells;
    for (unsigned int d = 0; d < 4; ++d)
      for (unsigned long i = 0; i < n[d]; ++i)
        {
          const auto entity     = numbers.tag(section);
          const auto parent_dim = numbers.integer(section);
          const auto parent     = numbers.integer(section);
          for (auto left = numbers.size(section); left > 0; --left)
            if (const long partition = numbers.integer(section); d == 3)
              with_cells.insert(partition);
          std::vector<unsigned int> groups = read_groups(section, d, numbers);
          // Groups are those of the entity that was divided, also where its parts do not say so.
          if (const auto whole = physical[d].find(parent);
              groups.empty() && parent_dim == static_cast<long>(d) && whole != physical[d].end())
            groups = whole->second;
          physical[d][entity] = groups;
        }
    if (with_cells.size() < n_partitions)
      text.fail("The mesh is divided into " + std::to_string(n_partitions) +
                  " partitions, of which the file has " + std::to_string(with_cells.size()) + ".",
                "save the mesh in one file and without partitions: the program divides it itself");
  }



  const std::vector<unsigned int> &
  GmshGroups::of_entity(MeshText &text, const unsigned int d, const unsigned long entity) const
  {
    static const std::vector<unsigned int> none;
    if (d > 3)
      text.fail("$Elements is damaged.");
    const auto found = physical[d].find(entity);
    if (has_entities && found == physical[d].end())
      text.fail("The elements belong to entity " + std::to_string(entity) + " of dimension " +
                std::to_string(d) + ", which $Entities does not have.");
    return found == physical[d].end() ? none : found->second;
  }



  void
  GmshGroups::add_nodes(const unsigned int               d,
                        const std::vector<unsigned int> &groups,
                        const std::vector<unsigned int> &nodes)
  {
    for (const unsigned int number : groups)
      nodes_of[d][number].insert(nodes.begin(), nodes.end());
  }



  void
  GmshGroups::name_groups(MeshFile &mesh) const
  {
    const auto name_of = [this](const unsigned int d, const unsigned int number) {
      const auto found = names[d].find(number);
      return found == names[d].end() ? std::string() : found->second;
    };
    for (MeshFile::Group &group : mesh.surfaces)
      group.name = name_of(2, group.number);
    for (MeshFile::Group &group : mesh.volumes)
      group.name = name_of(3, group.number);
    for (const unsigned int d : {0, 1})
      for (const auto &[number, members] : nodes_of[d])
        if (const std::string name = name_of(d, number); !name.empty())
          mesh.node_sets[name].insert(members.begin(), members.end());
  }
} // namespace Touchstone
