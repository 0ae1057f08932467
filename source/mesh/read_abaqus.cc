// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/abaqus_elements.h>
#include <touchstone/mesh/abaqus_lines.h>
#include <touchstone/mesh/abaqus_node_sets.h>
#include <touchstone/mesh/mesh_file.h>
#include <touchstone/mesh/mesh_text.h>

#include <algorithm>
#include <istream>
#include <map>
#include <set>

// Meshes from Abaqus input files (.inp): *NODE, *ELEMENT with C3D8, C3D20, C3D27 and
// quadrilaterals, *ELSET and *SURFACE; other keywords are skipped. Sets of elements become volumes
// or surfaces, element-based surfaces become surfaces.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Reads line by line and remembers the keyword line that rules. */
    class AbaqusReader
    {
    public:
      MeshFile
      read(std::istream &in);

    private:
      MeshFile      mesh;
      unsigned int  line_number = 0;
      AbaqusKeyword keyword;
      /** Numbers of an element whose line goes on. */
      std::vector<unsigned long> pending;
      unsigned int               line_of_pending = 0;

      std::map<unsigned long, unsigned int> node;
      /** Cells and faces by the number of the element. */
      std::map<unsigned long, unsigned int> cell, face;
      /** Line of an element's number. */
      std::map<unsigned long, unsigned int> element_line;
      /** Numbers of the elements of each ELSET. */
      std::map<std::string, std::vector<unsigned long>> sets;
      /** In the order of the file, for the sets' numbers. */
      std::vector<std::string> set_names;
      AbaqusNodeSets           node_sets;

      void
      read_line(const std::string &line);
      void
      read_node(const std::vector<std::string> &words);
      void
      read_element(const std::vector<std::string> &words);
      void
      add_to_set(const std::string &name, unsigned long element);
      const std::vector<unsigned long> &
      known_set(const std::string &name) const;
      void
      read_set(const std::vector<std::string> &words);
      void
      read_surface(const std::vector<std::string> &words);
    };



    MeshFile
    AbaqusReader::read(std::istream &in)
    {
      // Errors are thrown where they are found, without a line, and get the number of the present
      // line here.
      for (std::string line; std::getline(in, line);)
        {
          ++line_number;
          try
            {
              read_line(line);
            }
          catch (const MeshFileError &error)
            {
              throw MeshFileError(line_number, error.what(), error.remedy);
            }
        }
      if (!pending.empty())
        throw MeshFileError(line_of_pending, "The file ends, or is damaged, in *ELEMENT.");

      // Groups are made at the end only, as sets may be defined before the elements that they
      // name. A set with cells and faces gives a volume and a surface of the same name.
      for (const std::string &name : set_names)
        for (const auto &[groups, elements] :
             {std::make_pair(&mesh.volumes, &cell), std::make_pair(&mesh.surfaces, &face)})
          {
            MeshFile::Group group{static_cast<unsigned int>(groups->size() + 1), name, {}};
            // A set may name an element more than once.
            for (const unsigned long element :
                 std::set<unsigned long>(sets[name].begin(), sets[name].end()))
              if (const auto found = elements->find(element); found != elements->end())
                group.members.push_back(found->second);
            if (!group.members.empty())
              groups->push_back(group);
          }
      node_sets.put_into(mesh, node);
      mesh.join_copies(false);
      return std::move(mesh);
    }



    void
    AbaqusReader::read_line(const std::string &line)
    {
      const std::vector<std::string> words = split_abaqus(line);
      if (words.empty() || line.compare(0, 2, "**") == 0)
        return;
      if (line[0] == '*')
        {
          if (!pending.empty())
            throw MeshFileError("The file is damaged in *ELEMENT.");
          keyword = AbaqusKeyword(line);
        }
      else if (keyword.name == "*NODE")
        read_node(words);
      else if (keyword.name == "*ELEMENT")
        read_element(words);
      else if (keyword.name == "*ELSET")
        read_set(words);
      else if (keyword.name == "*NSET")
        node_sets.add(keyword.value("NSET"), words, keyword.has("GENERATE"));
      else if (keyword.name == "*SURFACE")
        read_surface(words);
    }



    void
    AbaqusReader::read_node(const std::vector<std::string> &words)
    {
      // Parts of an assembly each number their nodes from one, which a flat file cannot tell
      // apart; the message says so.
      if (words.size() < 4)
        throw MeshFileError("The file ends, or is damaged, in *NODE.");
      if (!node.insert({whole_number(words[0]), mesh.vertices.size()}).second)
        throw MeshFileError("Node " + words[0] + " appears twice.",
                            "remove one of the two, or, if the parts of an assembly number "
                            "their nodes alike, save the model as one flat input without parts "
                            "and instances");
      mesh.vertices.emplace_back(finite_number(words[1]),
                                 finite_number(words[2]),
                                 finite_number(words[3]));
      if (keyword.has("NSET"))
        node_sets.add(keyword.value("NSET"), {words[0]}, false);
    }



    void
    AbaqusReader::read_element(const std::vector<std::string> &words)
    {
      const std::string   type = in_capitals(keyword.value("TYPE"));
      const AbaqusElement element(type);
      const unsigned int  n = element.of_cell + element.of_face;
      if (n == 0)
        {
          if (keyword.has("ELSET"))
            sets.insert({keyword.value("ELSET"), {}});
          return;
        }

      // An element may go on over several lines: its numbers are collected until there are
      // enough.
      if (pending.empty())
        line_of_pending = line_number;
      for (const std::string &word : words)
        pending.push_back(whole_number(word));
      if (pending.size() < n + 1)
        return;
      if (pending.size() > n + 1)
        throw MeshFileError("Element " + std::to_string(pending[0]) + " of type " + type +
                            " has too many nodes.");

      // Sets refer to elements by their numbers, so two elements of one number would be
      // ambiguous.
      const auto [known, is_new] = element_line.insert({pending[0], line_of_pending});
      if (!is_new)
        throw MeshFileError("Element " + std::to_string(pending[0]) + " stands in line " +
                              std::to_string(known->second) + " already.",
                            "remove one of the two from the file, or give it a number of its own");
      std::vector<unsigned int> v;
      for (unsigned int i = 1; i <= n; ++i)
        {
          const auto found = node.find(pending[i]);
          if (found == node.end())
            throw MeshFileError("Element " + std::to_string(pending[0]) + " uses node " +
                                std::to_string(pending[i]) + ", which the file does not have.");
          v.push_back(found->second);
        }
      if (element.of_cell > 0)
        {
          cell[pending[0]] = mesh.cells.size();
          mesh.add_cell(v, line_of_pending);
        }
      else
        {
          face[pending[0]] = mesh.faces.size();
          mesh.faces.push_back({{v[0], v[1], v[2], v[3]}});
        }
      if (keyword.has("ELSET"))
        add_to_set(keyword.value("ELSET"), pending[0]);
      pending.clear();
    }



    void
    AbaqusReader::add_to_set(const std::string &name, const unsigned long element)
    {
      // The order of the file gives sets their numbers; a map alone would sort them by name.
      if (std::find(set_names.begin(), set_names.end(), name) == set_names.end())
        set_names.push_back(name);
      sets[name].push_back(element);
    }



    /** A set that is named inside another definition must have been defined before. Names of sets
     * are compared as written. */
    const std::vector<unsigned long> &
    AbaqusReader::known_set(const std::string &name) const
    {
      const auto found = sets.find(name);
      if (found == sets.end())
        throw MeshFileError("There is no set '" + name + "' before this line.",
                            "define the set of elements, or correct its name; capitals count");
      return found->second;
    }



    void
    AbaqusReader::read_set(const std::vector<std::string> &words)
    {
      // GENERATE gives first, last and step; otherwise a line lists numbers of elements and names
      // of other sets.
      const std::string name = keyword.value("ELSET");
      if (keyword.has("GENERATE"))
        {
          if (words.size() < 2)
            throw MeshFileError("The file ends, or is damaged, in *ELSET.");
          const unsigned long step  = words.size() > 2 ? whole_number(words[2]) : 1;
          const unsigned long first = whole_number(words[0]), last = whole_number(words[1]);
          // The bound keeps damaged numbers from filling the memory.
          if (step == 0 || last < first || (last - first) / step > 100000000ul)
            throw MeshFileError("The file is damaged in *ELSET, GENERATE.");
          for (unsigned long e = first; e <= last; e += step)
            add_to_set(name, e);
          return;
        }
      for (const std::string &word : words)
        if (std::isdigit(word[0]))
          add_to_set(name, whole_number(word));
        else
          for (const unsigned long e : std::vector<unsigned long>(known_set(word)))
            add_to_set(name, e);
    }



    void
    AbaqusReader::read_surface(const std::vector<std::string> &words)
    {
      // Vertices of the faces S1 to S6, in the order of mesh.cells.
      static const unsigned int face_vertices[6][4] = {
        {0, 1, 3, 2}, {4, 5, 7, 6}, {0, 4, 5, 1}, {1, 5, 7, 3}, {3, 7, 6, 2}, {2, 6, 4, 0}};
      const std::string face_name = words.size() > 1 ? in_capitals(words[1]) : "";
      if (face_name.size() != 2 || face_name[0] != 'S' || face_name[1] < '1' || face_name[1] > '6')
        return; // node-based surfaces and shell sides

      std::vector<unsigned long> elements;
      if (std::isdigit(words[0][0]))
        elements.push_back(whole_number(words[0]));
      else
        elements = known_set(words[0]);

      // A surface is defined by lines that can each name a set and a face of its elements; all
      // lines of one name add to the same group.
      const std::string name = keyword.value("NAME");
      auto group = std::find_if(mesh.surfaces.begin(), mesh.surfaces.end(), [&](auto &g) {
        return g.name == name;
      });
      if (group == mesh.surfaces.end())
        group =
          mesh.surfaces.insert(group,
                               {static_cast<unsigned int>(mesh.surfaces.size() + 1), name, {}});
      for (const unsigned long element : elements)
        if (const auto found = cell.find(element); found != cell.end())
          {
            group->members.push_back(mesh.faces.size());
            mesh.faces.emplace_back();
            for (unsigned int v = 0; v < 4; ++v)
              mesh.faces.back()[v] =
                mesh.cells[found->second].vertices[face_vertices[face_name[1] - '1'][v]];
          }
    }
  } // namespace



  MeshFile
  read_abaqus(std::istream &in)
  {
    return AbaqusReader().read(in);
  }
} // namespace Touchstone
