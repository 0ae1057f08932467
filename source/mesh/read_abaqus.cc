// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/abaqus_assembly.h>
#include <touchstone/mesh/abaqus_element_sets.h>
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
// quadrilaterals, *NSET, *ELSET and *SURFACE, flat or in the instances of parts; other keywords are
// skipped. Sets of elements become volumes
// or surfaces, element-based surfaces become surfaces.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Without the nodes and elements that these would make, or in other coordinates, bodies would
     * have holes or lie elsewhere. */
    void
    refuse_what_makes_nodes(const AbaqusKeyword &keyword)
    {
      static const std::set<std::string> refused{
        "*ELCOPY", "*ELGEN", "*INCLUDE", "*NCOPY", "*NFILL", "*NGEN", "*NMAP", "*SYSTEM"};
      const bool  is_mesh = keyword.name == "*NODE" || keyword.name == "*ELEMENT";
      std::string what    = refused.count(keyword.name) > 0 ? keyword.name : "";
      for (const char *parameter : {"INPUT", "SYSTEM"})
        if (is_mesh && keyword.has(parameter) && keyword.value(parameter) != "R")
          what = keyword.name + ", " + parameter;
      if (!what.empty())
        throw MeshFileError("It has " + what + ", which is not read.",
                            "save the mesh with all nodes and elements written out, in "
                            "rectangular coordinates and in one file");
    }



    /** Reads line by line and remembers the keyword line that rules. */
    class AbaqusReader
    {
    public:
      explicit AbaqusReader(std::istream &in)
        : assembly(in)
        , element_sets(assembly)
        , node_sets(assembly)
      {
      }

      MeshFile
      read();

    private:
      const AbaqusAssembly assembly;
      MeshFile             mesh;
      AbaqusAssembly::Line line;
      AbaqusKeyword        keyword;
      /** Numbers of an element whose line goes on. */
      std::vector<unsigned long> pending;
      unsigned int               line_of_pending = 0;

      /** Nodes by their numbers, cells and faces by the number of the element. */
      std::map<AbaqusNumber, unsigned int> node, cell, face;
      /** Line of an element's number. */
      std::map<AbaqusNumber, unsigned int> element_line;
      AbaqusElementSets                    element_sets;
      AbaqusNodeSets                       node_sets;

      void
      read_line(const std::string &text);
      void
      read_node(const std::vector<std::string> &words);
      void
      read_element(const std::vector<std::string> &words);
      /** Add what the pending numbers describe. */
      void
      add_element(const AbaqusElement &element);
      /** The instance of the numbers of a set. */
      unsigned int
      instance_of_set() const;
    };



    MeshFile
    AbaqusReader::read()
    {
      // Errors are thrown where they are found, without a line, and get the number of the present
      // line here.
      unsigned int instance = 0;
      for (const AbaqusAssembly::Line &next : assembly.lines())
        {
          // What rules the lines of one instance does not rule those of another.
          if (next.instance != instance)
            keyword = AbaqusKeyword();
          instance = next.instance;
          line     = next;
          try
            {
              read_line(assembly.text(line));
            }
          catch (const MeshFileError &error)
            {
              throw MeshFileError(line.number, error.what(), error.remedy);
            }
        }
      if (!pending.empty())
        throw MeshFileError(line_of_pending, "The file ends, or is damaged, in *ELEMENT.");
      element_sets.put_into(mesh, cell, face);
      node_sets.put_into(mesh, node);
      mesh.join_copies(false);
      return std::move(mesh);
    }



    void
    AbaqusReader::read_line(const std::string &text)
    {
      const std::vector<std::string> words = split_abaqus(text);
      if (words.empty() || text.compare(0, 2, "**") == 0)
        return;
      if (text[0] == '*')
        {
          if (!pending.empty())
            throw MeshFileError("The file is damaged in *ELEMENT.");
          keyword = AbaqusKeyword(text);
          refuse_what_makes_nodes(keyword);
        }
      else if (keyword.name == "*NODE")
        read_node(words);
      else if (keyword.name == "*ELEMENT")
        read_element(words);
      else if (keyword.name == "*ELSET")
        element_sets.add({line.instance, keyword.value("ELSET")},
                         words,
                         instance_of_set(),
                         keyword.has("GENERATE"));
      else if (keyword.name == "*NSET")
        node_sets.add({line.instance, keyword.value("NSET")},
                      words,
                      instance_of_set(),
                      keyword.has("GENERATE"));
      else if (keyword.name == "*SURFACE")
        element_sets.add_faces(
          {line.instance, keyword.value("NAME")}, words, instance_of_set(), cell, mesh);
    }



    /** A set of an assembly may have the nodes or elements of an instance that it names. */
    unsigned int
    AbaqusReader::instance_of_set() const
    {
      return keyword.has("INSTANCE") ? assembly.instance(keyword.value("INSTANCE")) : line.instance;
    }



    void
    AbaqusReader::read_node(const std::vector<std::string> &words)
    {
      if (words.size() < 4)
        throw MeshFileError("The file ends, or is damaged, in *NODE.");
      const AbaqusNumber number(line.instance, whole_number(words[0]));
      if (!node.insert({number, mesh.vertices.size()}).second)
        throw MeshFileError("Node " + words[0] + " appears twice.", "remove one of the two");
      mesh.vertices.push_back(assembly.place(
        Point<3>(finite_number(words[1]), finite_number(words[2]), finite_number(words[3])),
        line.instance));
      if (keyword.has("NSET"))
        node_sets.add({line.instance, keyword.value("NSET")}, {words[0]}, line.instance, false);
    }



    void
    AbaqusReader::read_element(const std::vector<std::string> &words)
    {
      const std::string   type = in_capitals(keyword.value("TYPE"));
      const AbaqusElement element(type);
      const unsigned int  n = element.of_cell + element.of_face;
      if (element.triangular)
        throw surface_error("Element " + words[0] + " of type " + type);
      if (n == 0)
        {
          if (keyword.has("ELSET"))
            element_sets.declare({line.instance, keyword.value("ELSET")});
          return;
        }

      // An element may go on over several lines: its numbers are collected until there are
      // enough.
      if (pending.empty())
        line_of_pending = line.number;
      for (const std::string &word : words)
        pending.push_back(whole_number(word));
      if (pending.size() < n + 1)
        return;
      if (pending.size() > n + 1)
        throw MeshFileError("Element " + std::to_string(pending[0]) + " of type " + type +
                            " has too many nodes.");

      add_element(element);
      pending.clear();
    }



    void
    AbaqusReader::add_element(const AbaqusElement &element)
    {
      // Sets refer to elements by their numbers, so two elements of one number would be
      // ambiguous.
      const AbaqusNumber number(line.instance, pending[0]);
      const auto [known, is_new] = element_line.insert({number, line_of_pending});
      if (!is_new)
        throw MeshFileError("Element " + std::to_string(pending[0]) + " stands in line " +
                              std::to_string(known->second) + " already.",
                            "remove one of the two from the file, or give it a number of its own");
      std::vector<unsigned int> v;
      for (unsigned int i = 1; i < pending.size(); ++i)
        {
          const auto found = node.find({line.instance, pending[i]});
          if (found == node.end())
            throw MeshFileError("Element " + std::to_string(pending[0]) + " uses node " +
                                std::to_string(pending[i]) + ", which the file does not have.");
          v.push_back(found->second);
        }
      if (element.of_cell > 0)
        {
          cell[number] = mesh.cells.size();
          mesh.add_cell(v, line_of_pending);
        }
      else
        {
          face[number] = mesh.faces.size();
          mesh.add_face({{v[0], v[1], v[2], v[3]}}, line_of_pending);
        }
      if (keyword.has("ELSET"))
        element_sets.add({line.instance, keyword.value("ELSET")}, number);
    }



  } // namespace



  MeshFile
  read_abaqus(std::istream &in)
  {
    return AbaqusReader(in).read();
  }
} // namespace Touchstone
