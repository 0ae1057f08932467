// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/mesh_file.h>
#include <touchstone/mesh/mesh_text.h>

#include <cstdlib>
#include <map>
#include <set>

// Meshes of Gmsh (.msh) in ASCII, versions 2.2 and 4.1. In version 2 elements name their physical
// groups themselves; in version 4 they name an entity, whose groups are listed in $Entities. Each
// section is checked to end where it should, for a wrong number of entries shifts all that
// follows.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** One pass through a .msh file, section by section. */
    class GmshReader
    {
    public:
      explicit GmshReader(std::istream &in)
        : text(in)
      {
      }

      MeshFile
      read();

    private:
      MeshText text;
      MeshFile mesh;
      double   version      = 0.;
      bool     has_entities = false;

      /** Index of a node's number. */
      std::map<unsigned long, unsigned int> node;
      /** Line of an element's number. */
      std::map<unsigned long, unsigned int> element;
      /** Physical groups of each surface (2) and volume (3) of version 4. */
      std::map<unsigned long, std::vector<unsigned int>> physical[4];
      /** Names of physical surfaces and volumes. */
      std::map<unsigned int, std::string> names[4];

      void
      read_format();
      void
      read_names();
      void
      read_entities();
      void
      read_nodes();
      void
      read_elements();
      void
      read_node(unsigned long number);
      void
      new_element(unsigned long number);
      void
      read_element(unsigned int type, const std::vector<unsigned int> &groups);
      void
      check_sum(unsigned long found, unsigned long announced, const char *what);
    };



    MeshFile
    GmshReader::read()
    {
      // The sections can be in any order, except that the format comes first, as it decides how
      // the others are read. Names are attached to the groups at the end for this reason.
      std::set<std::string> sections;
      std::string           word;
      while (text.word(word))
        {
          const std::string end = "$End" + word.substr(1);
          if (word[0] != '$')
            text.fail("The word '" + word + "' stands where a section like $Nodes should begin.");
          if (word != "$MeshFormat" && version == 0.)
            text.fail("$MeshFormat should stand before " + word + ".");
          const bool is_known = word == "$MeshFormat" || word == "$PhysicalNames" ||
                                word == "$Entities" || word == "$Nodes" || word == "$Elements";
          if (is_known && !sections.insert(word).second)
            text.fail("The file has a second " + word + ".");
          if (word == "$MeshFormat")
            read_format();
          else if (word == "$PhysicalNames")
            read_names();
          else if (word == "$Entities")
            read_entities();
          else if (word == "$Nodes")
            read_nodes();
          else if (word == "$Elements")
            read_elements();

          const std::string section = word;
          if (!text.word(word))
            text.fail("The file ends before " + end + ".");
          if (is_known && word != end)
            text.fail("'" + word + "' stands where " + section + " should end: " + section +
                        " has more entries than it announces, or is damaged.",
                      "save the mesh again, or correct the number at the head of " + section +
                        " if you know all of its lines to be right");
          // Sections that this reader does not know are skipped up to their end.
          while (word != end)
            if (!text.word(word))
              text.fail("The file ends before " + end + ".");
        }
      if (sections.count("$Elements") == 0)
        throw MeshFileError("The file has no $Elements.");

      // Only version 2 writes an element again for each of its physical groups.
      mesh.join_copies(version < 3.);
      for (auto *groups : {&mesh.surfaces, &mesh.volumes})
        for (MeshFile::Group &group : *groups)
          group.name = names[groups == &mesh.surfaces ? 2 : 3][group.number];
      return std::move(mesh);
    }



    void
    GmshReader::read_format()
    {
      // Version 4.0 has another layout of entities and nodes than 4.1 and is an error, like
      // binary files.
      const char *what = "$MeshFormat";
      version          = text.real(what);
      if (text.number(what) != 0)
        text.fail("The file is binary; save it as ASCII.");
      if (!((version >= 2. && version < 3.) || (version >= 4.1 && version < 5.)))
        text.fail("The format is version " + std::to_string(version) +
                  "; save it as version 2.2 or 4.1.");
      text.number(what); // size of a floating point number
    }



    void
    GmshReader::read_names()
    {
      // A name may contain blanks, so the rest of the line is taken between its first and last
      // quotation mark. Two names for one group, or one name for two groups of the same
      // dimension, would make the boundary conditions ambiguous.
      const char *what = "$PhysicalNames";
      for (auto left = text.number(what); left > 0; --left)
        {
          const auto        d      = text.number(what);
          const auto        number = text.number(what);
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



    /** Physical groups of the entities, by dimension. Bounding boxes and the entities of their
     * boundaries are read over. The sign of a group tells its orientation only. */
    void
    GmshReader::read_entities()
    {
      has_entities       = true;
      const char   *what = "$Entities";
      unsigned long n[4];
      for (unsigned long &count : n)
        count = text.number(what);
      for (unsigned int d = 0; d < 4; ++d)
        for (unsigned long i = 0; i < n[d]; ++i)
          {
            const auto tag = text.number(what);
            for (unsigned int b = 0; b < (d == 0 ? 3 : 6); ++b)
              text.real(what);
            std::vector<unsigned int> groups;
            for (auto left = text.number(what); left > 0; --left)
              groups.push_back(std::abs(text.signed_number(what)));
            if (!physical[d].insert({tag, groups}).second)
              text.fail("Entity " + std::to_string(tag) + " of dimension " + std::to_string(d) +
                          " appears twice.",
                        "remove one of the two from the file");
            if (d > 0)
              for (auto left = text.number(what); left > 0; --left)
                text.signed_number(what);
          }
    }



    void
    GmshReader::read_node(const unsigned long number)
    {
      mesh.vertices.push_back(text.point("$Nodes"));
      if (!node.insert({number, mesh.vertices.size() - 1}).second)
        text.fail("Node " + std::to_string(number) + " appears twice.",
                  "remove one of the two from the file, or save the mesh again");
    }



    /** Compare the total number that the head of a section announces with the entries of its
     * blocks: a damaged block would otherwise pass unnoticed. */
    void
    GmshReader::check_sum(const unsigned long found,
                          const unsigned long announced,
                          const char         *what)
    {
      if (found != announced)
        text.fail(std::string(what) + " announces " + std::to_string(announced) +
                  " entries and has " + std::to_string(found) + ".");
    }



    void
    GmshReader::read_nodes()
    {
      // Version 2 has one node per line, version 4 blocks of numbers followed by blocks of
      // coordinates. Numbers of nodes may have gaps, so vertices are found by a map.
      const char *what = "$Nodes";
      if (version < 3.)
        {
          for (auto left = text.number(what); left > 0; --left)
            read_node(text.number(what));
          return;
        }
      const auto n         = text.number(what);
      const auto announced = text.number(what);
      text.number(what); // smallest
      text.number(what); // and largest number of a node
      for (unsigned long block = 0; block < n; ++block)
        {
          text.number(what);
          text.signed_number(what);
          if (text.number(what) != 0)
            text.fail("The nodes have parametric coordinates; save the file without them.");
          std::vector<unsigned long> numbers(text.announced(what));
          for (unsigned long &number : numbers)
            number = text.number(what);
          for (const unsigned long number : numbers)
            read_node(number);
        }
      check_sum(mesh.vertices.size(), announced, what);
    }



    void
    GmshReader::new_element(const unsigned long number)
    {
      const auto [known, is_new] = element.insert({number, text.line()});
      if (!is_new)
        text.fail("Element " + std::to_string(number) + " stands in line " +
                    std::to_string(known->second) + " already.",
                  "remove one of the two from the file, or save the mesh again");
    }



    /** Version 4 lists elements in blocks of one entity and type; points and lines are read to be
     * checked, and dropped. */
    void
    GmshReader::read_elements()
    {
      const char *what = "$Elements";
      const auto  n    = text.number(what);
      if (version < 3.)
        {
          for (unsigned long i = 0; i < n; ++i)
            {
              new_element(text.number(what));
              const unsigned int        type = text.number(what);
              std::vector<unsigned int> groups;
              // The first tag is the physical group, or zero for none.
              const auto n_tags = text.number(what);
              for (unsigned long t = 0; t < n_tags; ++t)
                if (const long tag = text.signed_number(what); t == 0 && tag != 0)
                  groups.push_back(std::abs(tag));
              read_element(type, groups);
            }
          return;
        }
      const auto announced = text.number(what);
      text.number(what);
      text.number(what);
      for (unsigned long block = 0; block < n; ++block)
        {
          const auto d    = text.number(what);
          const auto tag  = text.number(what);
          const auto type = text.number(what);
          if (d > 3)
            text.fail("$Elements is damaged.");
          if (has_entities && physical[d].count(tag) == 0)
            text.fail("The elements belong to entity " + std::to_string(tag) + " of dimension " +
                      std::to_string(d) + ", which $Entities does not have.");
          for (auto left = text.number(what); left > 0; --left)
            {
              new_element(text.number(what));
              read_element(type, physical[d][tag]);
            }
        }
      check_sum(element.size(), announced, what);
    }



    void
    GmshReader::read_element(const unsigned int type, const std::vector<unsigned int> &groups)
    {
      // Elements of order one; the codes are those of the Gmsh manual.
      constexpr unsigned int                            quadrangle = 3, hexahedron = 5;
      static const std::map<unsigned int, unsigned int> n_nodes = {
        {15, 1}, {1, 2}, {2, 3}, {quadrangle, 4}, {hexahedron, 8}};
      if (type == 4 || type == 6 || type == 7)
        text.fail("It has tetrahedra, prisms or pyramids.");
      const auto known = n_nodes.find(type);
      if (known == n_nodes.end())
        text.fail("It has elements of Gmsh's type " + std::to_string(type) +
                  ", perhaps of higher order; save it with order 1.");

      std::vector<unsigned int> vertices(known->second);
      for (unsigned int &vertex : vertices)
        {
          // The nodes must end with the line: with a wrong type or a missing node, numbers of the
          // next element would be taken for those of this one.
          if (text.at_end_of_line())
            text.fail_in("$Elements");
          const auto number = text.number("$Elements");
          const auto found  = node.find(number);
          if (found == node.end())
            text.fail("An element uses node " + std::to_string(number) +
                      ", which the file does not have.");
          vertex = found->second;
        }
      if (!text.at_end_of_line())
        text.fail("An element of Gmsh's type " + std::to_string(type) + " has more than its " +
                  std::to_string(known->second) + " nodes.");

      // Quadrangles carry the boundary ids; points, lines and triangles have none here.
      const bool is_cell = type == hexahedron;
      if (is_cell)
        mesh.add_cell(vertices, text.line());
      else if (type == quadrangle)
        mesh.faces.push_back({{vertices[0], vertices[1], vertices[2], vertices[3]}});
      else
        return;
      for (const unsigned int number : groups)
        MeshFile::group(is_cell ? mesh.volumes : mesh.surfaces, number)
          .members.push_back((is_cell ? mesh.cells.size() : mesh.faces.size()) - 1);
    }
  } // namespace



  MeshFile
  read_gmsh(std::istream &in)
  {
    return GmshReader(in).read();
  }
} // namespace Touchstone
