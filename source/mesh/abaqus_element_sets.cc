// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/abaqus_element_sets.h>
#include <touchstone/mesh/abaqus_lines.h>
#include <touchstone/mesh/mesh_text.h>

#include <algorithm>
#include <array>
#include <set>

namespace Touchstone
{
  void
  AbaqusElementSets::add(const AbaqusName &set, const AbaqusNumber &element)
  {
    if (std::find(set_names.begin(), set_names.end(), set) == set_names.end())
      set_names.push_back(set);
    sets[set].push_back(element);
  }



  void
  AbaqusElementSets::add(const AbaqusName               &set,
                         const std::vector<std::string> &words,
                         const unsigned int              instance,
                         const bool                      generate)
  {
    if (!generate)
      {
        for (const std::string &word : words)
          for (const AbaqusNumber &element : elements(word, instance))
            add(set, element);
        return;
      }
    if (words.size() < 2)
      throw MeshFileError("The file ends, or is damaged, in *ELSET.");
    const unsigned long step  = words.size() > 2 ? whole_number(words[2]) : 1;
    const unsigned long first = whole_number(words[0]), last = whole_number(words[1]);
    // The bound keeps damaged numbers from filling the memory.
    if (step == 0 || last < first || (last - first) / step > 100000000ul)
      throw MeshFileError("The file is damaged in *ELSET, GENERATE.");
    for (unsigned long e = first; e <= last; e += step)
      add(set, {instance, e});
  }



  void
  AbaqusElementSets::add_faces(const AbaqusName               &surface,
                               const std::vector<std::string> &words,
                               const unsigned int              instance,
                               const Indices                  &cell,
                               MeshFile                       &mesh)
  {
    // Vertices of the faces S1 to S6, in the order of mesh.cells.
    static const unsigned int face_vertices[6][4] = {
      {0, 1, 3, 2}, {4, 5, 7, 6}, {0, 4, 5, 1}, {1, 5, 7, 3}, {3, 7, 6, 2}, {2, 6, 4, 0}};
    const std::string face_name = words.size() > 1 ? in_capitals(words[1]) : "";
    if (face_name.size() != 2 || face_name[0] != 'S' || face_name[1] < '1' || face_name[1] > '6')
      return; // node-based surfaces and shell sides

    // Several lines of one name, of several keywords, too, are one surface.
    const auto [faces, is_new] = surfaces.insert({surface, {}});
    if (is_new)
      surface_names.push_back(surface);
    for (const AbaqusNumber &element : elements(words[0], instance))
      if (const auto found = cell.find(element); found != cell.end())
        {
          faces->second.push_back(mesh.faces.size());
          std::array<unsigned int, 4> corners;
          for (unsigned int v = 0; v < 4; ++v)
            corners[v] = mesh.cells[found->second].vertices[face_vertices[face_name[1] - '1'][v]];
          mesh.add_face(corners, mesh.cell_lines[found->second]);
        }
  }



  /** A set that is named must have been defined before. Names of sets are compared as written. */
  std::vector<AbaqusNumber>
  AbaqusElementSets::elements(const std::string &word, const unsigned int instance) const
  {
    if (const auto number = assembly.number(word, instance))
      return {*number};
    auto found = sets.find({instance, word});
    if (found == sets.end())
      found = sets.find(assembly.outer_name(word));
    if (found == sets.end())
      throw MeshFileError("There is no set '" + word + "' before this line.",
                          "define the set of elements, or correct its name; capitals count");
    return found->second;
  }



  /** At the end only, as sets may be defined before the elements that they name. A set with cells
   * and faces gives a volume and a surface of the same name. */
  void
  AbaqusElementSets::put_into(MeshFile &mesh, const Indices &cell, const Indices &face) const
  {
    const auto add_group = [](std::vector<MeshFile::Group>    &groups,
                              const std::string               &name,
                              const std::vector<unsigned int> &members) {
      if (!members.empty())
        groups.push_back({static_cast<unsigned int>(groups.size() + 1), name, members});
    };
    for (const AbaqusName &name : surface_names)
      add_group(mesh.surfaces, assembly.short_name(name, surface_names), surfaces.at(name));
    for (const AbaqusName &name : set_names)
      for (const auto &[groups, indices] :
           {std::make_pair(&mesh.volumes, &cell), std::make_pair(&mesh.surfaces, &face)})
        {
          // A set may name an element more than once.
          const auto            &numbers = sets.at(name);
          std::set<unsigned int> members;
          for (const AbaqusNumber &element : numbers)
            if (const auto found = indices->find(element); found != indices->end())
              members.insert(found->second);
          add_group(*groups,
                    assembly.short_name(name, set_names),
                    std::vector<unsigned int>(members.begin(), members.end()));
        }
    for (unsigned int i = 1; i <= assembly.n_instances(); ++i)
      {
        std::vector<unsigned int> members;
        for (auto c = cell.lower_bound({i, 0}); c != cell.end() && c->first.first == i; ++c)
          members.push_back(c->second);
        add_group(mesh.volumes, assembly.name(i), members);
      }
  }
} // namespace Touchstone
