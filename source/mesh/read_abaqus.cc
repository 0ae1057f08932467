// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/mesh_file.h>
#include <touchstone/mesh/mesh_text.h>

#include <algorithm>
#include <istream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

// Meshes from Abaqus input files (.inp): *NODE, *ELEMENT with C3D8, C3D20, C3D27 and
// quadrilaterals, *ELSET and *SURFACE; other keywords are skipped. Sets of elements become volumes
// or surfaces, element-based surfaces become surfaces.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    std::string
    upper(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(), ::toupper);
      return text;
    }

    /** The parts of a line between commas, without blanks around them. */
    std::vector<std::string>
    split(const std::string &line)
    {
      std::vector<std::string> words;
      std::istringstream       in(line);
      for (std::string word; std::getline(in, word, ',');)
        {
          const auto first = word.find_first_not_of(" \t\r"), last = word.find_last_not_of(" \t\r");
          words.push_back(first == std::string::npos ? "" : word.substr(first, last - first + 1));
        }
      while (!words.empty() && words.back().empty())
        words.pop_back();
      return words;
    }

    /** Nodes of an element of this type, by the beginning of its name: variants with reduced
     * integration, mixed fields and the like have the same nodes. A digit may not follow, so that
     * C3D8 is not C3D80. Zero for others. */
    unsigned int
    nodes_of(const std::string &type, const std::map<std::string, unsigned int> &known)
    {
      for (const auto &[name, n] : known)
        if (type.compare(0, name.size(), name) == 0 &&
            (type.size() == name.size() ||
             !std::isdigit(static_cast<unsigned char>(type[name.size()]))))
          return n;
      return 0;
    }



    /** Reads line by line and remembers the keyword line that rules. */
    class AbaqusReader
    {
    public:
      MeshFile
      read(std::istream &in);

    private:
      MeshFile     mesh;
      unsigned int line_number = 0;
      /** The keyword and its parameters, in capitals; values as written. */
      std::string                        keyword;
      std::map<std::string, std::string> parameters;
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

      void
      read_line(const std::string &line);
      void
      read_keyword(const std::string &line);
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

      /** Numbers of the nodes of each NSET; of those that cannot be read, as they name nodes of
       * instances for example, nothing. */
      std::map<std::string, std::optional<std::set<unsigned long>>> node_sets;
      void
      read_node_set(const std::vector<std::string> &words);
      void
      make_node_sets();
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
      make_node_sets();
      mesh.join_copies(false);
      return std::move(mesh);
    }



    void
    AbaqusReader::read_line(const std::string &line)
    {
      const std::vector<std::string> words = split(line);
      if (words.empty() || line.compare(0, 2, "**") == 0)
        return;
      if (line[0] == '*')
        read_keyword(line);
      else if (keyword == "*NODE")
        read_node(words);
      else if (keyword == "*ELEMENT")
        read_element(words);
      else if (keyword == "*ELSET")
        read_set(words);
      else if (keyword == "*NSET")
        read_node_set(words);
      else if (keyword == "*SURFACE")
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
      if (parameters.count("NSET") > 0)
        read_node_set({words[0]});
    }



    // As an ELSET; sets may name nodes that come later.
    void
    AbaqusReader::read_node_set(const std::vector<std::string> &words)
    {
      auto &set = node_sets.insert({parameters["NSET"], std::set<unsigned long>()}).first->second;
      const auto is_number = [](const std::string &word) {
        return !word.empty() && word.size() < 18 &&
               word.find_first_not_of("0123456789") == std::string::npos;
      };
      if (!set)
        return;
      if (parameters.count("GENERATE") > 0)
        {
          const bool          numbers = std::all_of(words.begin(), words.end(), is_number);
          const unsigned long step    = numbers && words.size() > 2 ? std::stoul(words[2]) : 1;
          if (!numbers || words.size() < 2 || step == 0 ||
              std::stoul(words[1]) / step > 100000000ul)
            set.reset();
          else
            for (unsigned long n = std::stoul(words[0]); n <= std::stoul(words[1]); n += step)
              set->insert(n);
          return;
        }
      for (const std::string &word : words)
        if (is_number(word))
          set->insert(std::stoul(word));
        else if (const auto other = node_sets.find(word); other != node_sets.end() && other->second)
          set->insert(other->second->begin(), other->second->end());
        else
          {
            set.reset();
            return;
          }
    }



    void
    AbaqusReader::make_node_sets()
    {
      for (const auto &[name, numbers] : node_sets)
        if (numbers && std::all_of(numbers->begin(), numbers->end(), [this](const auto n) {
              return node.count(n) > 0;
            }))
          for (const unsigned long n : *numbers)
            mesh.node_sets[name].insert(node.at(n));
    }



    /** A keyword line rules the data lines up to the next one. Keywords and names of parameters
     * are compared in capitals, as Abaqus does; blanks around commas and equal signs do not
     * count. */
    void
    AbaqusReader::read_keyword(const std::string &line)
    {
      if (!pending.empty())
        throw MeshFileError("The file is damaged in *ELEMENT.");
      const std::vector<std::string> words = split(line);
      keyword                              = upper(words[0]);
      parameters.clear();
      for (unsigned int i = 1; i < words.size(); ++i)
        {
          const auto equals = words[i].find('=');
          const bool has    = equals != std::string::npos;
          const auto name   = split(words[i].substr(0, equals));
          const auto value  = split(has ? words[i].substr(equals + 1) : "");
          if (!name.empty())
            parameters[upper(name[0])] = value.empty() ? "" : value[0];
        }
    }



    void
    AbaqusReader::read_element(const std::vector<std::string> &words)
    {
      // Solid elements of another shape are an error, since the body would have holes without
      // them; elements that carry no volume are skipped.
      const std::string  type      = upper(parameters["TYPE"]);
      const unsigned int n_of_cell = nodes_of(type, {{"C3D8", 8}, {"C3D20", 20}, {"C3D27", 27}}),
                         n_of_face = nodes_of(type,
                                              {{"S4", 4},
                                               {"S8", 8},
                                               {"CPS4", 4},
                                               {"CPS8", 8},
                                               {"CPE4", 4},
                                               {"CPE8", 8},
                                               {"M3D4", 4},
                                               {"M3D8", 8},
                                               {"M3D9", 9},
                                               {"SFM3D4", 4},
                                               {"SFM3D8", 8}});
      const bool is_cell = n_of_cell > 0, is_face = n_of_face > 0;
      if (!is_cell && !is_face)
        {
          // Solids of any kind and shape, and elements without a type.
          for (const char *solid : {"C3D",
                                    "DC3D",
                                    "DCC3D",
                                    "AC3D",
                                    "EC3D",
                                    "Q3D",
                                    "GK3D",
                                    "COH3D",
                                    "SC6",
                                    "SC8",
                                    "CSS8"})
            if (type.compare(0, std::string(solid).size(), solid) == 0)
              throw MeshFileError("It has elements of type " + type + ".");
          if (type.empty())
            throw MeshFileError("It has elements without a TYPE.");
          if (parameters.count("ELSET") > 0)
            sets.insert({parameters["ELSET"], {}});
          return; // beams, springs and the like
        }

      // An element may go on over several lines: its numbers are collected until there are
      // enough.
      if (pending.empty())
        line_of_pending = line_number;
      for (const std::string &word : words)
        pending.push_back(whole_number(word));
      const unsigned int n = n_of_cell + n_of_face;
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
      if (is_cell)
        {
          cell[pending[0]] = mesh.cells.size();
          mesh.add_cell(v, line_of_pending);
        }
      else
        {
          face[pending[0]] = mesh.faces.size();
          mesh.faces.push_back({{v[0], v[1], v[2], v[3]}});
        }
      if (parameters.count("ELSET") > 0)
        add_to_set(parameters["ELSET"], pending[0]);
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
      const std::string name = parameters["ELSET"];
      if (parameters.count("GENERATE") > 0)
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
      const std::string face_name = words.size() > 1 ? upper(words[1]) : "";
      if (face_name.size() != 2 || face_name[0] != 'S' || face_name[1] < '1' || face_name[1] > '6')
        return; // node-based surfaces and shell sides

      std::vector<unsigned long> elements;
      if (std::isdigit(words[0][0]))
        elements.push_back(whole_number(words[0]));
      else
        elements = known_set(words[0]);

      // A surface is defined by lines that can each name a set and a face of its elements; all
      // lines of one name add to the same group.
      const std::string name = parameters["NAME"];
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
