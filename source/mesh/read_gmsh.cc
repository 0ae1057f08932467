// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/mesh_file.h>
#include <touchstone/mesh/mesh_text.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>

// Meshes of Gmsh (.msh), versions 2.2 and 4.1, the latter in ASCII or binary. In version 2 elements
// name their physical groups themselves; in version 4 they name an entity, whose groups are listed
// in $Entities. Each section is checked to end where it should, for a wrong number of entries
// shifts all that follows.
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
      /** Numbers are bytes: size_t, int and double of this machine. */
      bool binary = false;

      /** Index of a node's number. */
      std::map<unsigned long, unsigned int> node;
      /** Line of an element's number. */
      std::map<unsigned long, unsigned int> element;
      /** Physical groups of each surface (2) and volume (3) of version 4. */
      std::map<unsigned long, std::vector<unsigned int>> physical[4];
      /** Vertices of physical points and curves, by dimension and number. */
      std::map<unsigned int, std::set<unsigned int>> of_group[2];
      /** Names of physical groups, by dimension. */
      std::map<unsigned int, std::string> names[4];

      template <class T>
      T
      binary_value(const char *what);
      /** Numbers of sections that are binary in binary files. @{ */
      unsigned long
      size(const char *what);
      long
      integer(const char *what);
      double
      real(const char *what);
      unsigned long
      tag(const char *what);
      /** @} */
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
      read_element(unsigned int                     element_number,
                   unsigned int                     type,
                   const std::vector<unsigned int> &groups);
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
          if (binary && word != "$PhysicalNames")
            text.next_line(); // the bytes begin there
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
      for (const unsigned int d : {0, 1})
        for (const auto &[number, members] : of_group[d])
          if (const auto name = names[d].find(number); name != names[d].end())
            mesh.node_sets[name->second].insert(members.begin(), members.end());
      return std::move(mesh);
    }



    void
    GmshReader::read_format()
    {
      // Version 4.0 has another layout of entities and nodes than 4.1 and is an error.
      const char *what = "$MeshFormat";
      version          = text.real(what);
      binary           = text.number(what) != 0;
      if (!((version >= 2. && version < 3.) || (version >= 4.1 && version < 5.)))
        text.fail("The format is version " + std::to_string(version) +
                  "; save it as version 2.2 or 4.1.");
      const auto size_of_real = text.number(what);
      if (!binary)
        return;
      if (version < 3.)
        text.fail("The file is binary and of version 2.",
                  "save it in binary as version 4.1, or as ASCII");
      if (size_of_real != sizeof(double))
        text.fail("The file is binary with numbers of " + std::to_string(size_of_real) +
                    " bytes, not 8.",
                  "save the mesh again on a machine of 64 bits");
      text.next_line();
      int one = 0;
      text.bytes(&one, sizeof(one), what);
      if (one != 1)
        text.fail("The file is binary, with bytes in another order than this machine has.",
                  "save the mesh as ASCII");
      mesh.place = "element";
    }



    template <class T>
    T
    GmshReader::binary_value(const char *what)
    {
      T value = 0;
      text.bytes(&value, sizeof(value), what);
      return value;
    }



    unsigned long
    GmshReader::size(const char *what)
    {
      return binary ? binary_value<std::uint64_t>(what) : text.number(what);
    }



    long
    GmshReader::integer(const char *what)
    {
      return binary ? binary_value<std::int32_t>(what) : text.signed_number(what);
    }



    double
    GmshReader::real(const char *what)
    {
      const double value = binary ? binary_value<double>(what) : text.real(what);
      if (!std::isfinite(value))
        text.fail(std::string("A number in ") + what + " is not finite.");
      return value;
    }



    /** Numbers of entities and types, which have a sign in the format only. */
    unsigned long
    GmshReader::tag(const char *what)
    {
      if (!binary)
        return text.number(what);
      const long value = integer(what);
      if (value < 0)
        text.fail(std::string("A number in ") + what + " is negative.");
      return value;
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
        count = size(what);
      for (unsigned int d = 0; d < 4; ++d)
        for (unsigned long i = 0; i < n[d]; ++i)
          {
            const auto number = tag(what);
            for (unsigned int b = 0; b < (d == 0 ? 3 : 6); ++b)
              real(what);
            std::vector<unsigned int> groups;
            for (auto left = size(what); left > 0; --left)
              groups.push_back(std::abs(integer(what)));
            if (!physical[d].insert({number, groups}).second)
              text.fail("Entity " + std::to_string(number) + " of dimension " + std::to_string(d) +
                          " appears twice.",
                        "remove one of the two from the file");
            if (d > 0)
              for (auto left = size(what); left > 0; --left)
                integer(what);
          }
    }



    void
    GmshReader::read_node(const unsigned long number)
    {
      Point<3> x;
      for (unsigned int d = 0; d < 3; ++d)
        x[d] = real("$Nodes");
      mesh.vertices.push_back(x);
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
      const auto n         = size(what);
      const auto announced = size(what);
      size(what); // smallest
      size(what); // and largest number of a node
      for (unsigned long block = 0; block < n; ++block)
        {
          tag(what);
          integer(what);
          if (tag(what) != 0)
            text.fail("The nodes have parametric coordinates; save the file without them.");
          std::vector<unsigned long> numbers(text.announced(what, size(what)));
          for (unsigned long &number : numbers)
            number = size(what);
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
        text.fail("Element " + std::to_string(number) +
                    (binary ? " stands twice in the file."
                            : " stands in line " + std::to_string(known->second) + " already."),
                  "remove one of the two from the file, or save the mesh again");
    }



    /** Version 4 lists elements in blocks of one entity and type; points and lines are read to be
     * checked, and make sets of nodes. */
    void
    GmshReader::read_elements()
    {
      const char *what = "$Elements";
      const auto  n    = size(what);
      if (version < 3.)
        {
          for (unsigned long i = 0; i < n; ++i)
            {
              const auto number = text.number(what);
              new_element(number);
              const unsigned int        type = text.number(what);
              std::vector<unsigned int> groups;
              // The first tag is the physical group, or zero for none.
              const auto n_tags = text.number(what);
              for (unsigned long t = 0; t < n_tags; ++t)
                if (const long tag = text.signed_number(what); t == 0 && tag != 0)
                  groups.push_back(std::abs(tag));
              read_element(number, type, groups);
            }
          return;
        }
      const auto announced = size(what);
      size(what);
      size(what);
      for (unsigned long block = 0; block < n; ++block)
        {
          const auto d      = tag(what);
          const auto entity = tag(what);
          const auto type   = tag(what);
          if (d > 3)
            text.fail("$Elements is damaged.");
          if (has_entities && physical[d].count(entity) == 0)
            text.fail("The elements belong to entity " + std::to_string(entity) + " of dimension " +
                      std::to_string(d) + ", which $Entities does not have.");
          for (auto left = size(what); left > 0; --left)
            {
              const auto number = size(what);
              new_element(number);
              read_element(number, type, physical[d][entity]);
            }
        }
      check_sum(element.size(), announced, what);
    }



    void
    GmshReader::read_element(const unsigned int               element_number,
                             const unsigned int               type,
                             const std::vector<unsigned int> &groups)
    {
      // Points, lines, triangles, quadrangles and hexahedra of order 1 and 2; the codes are those
      // of the Gmsh manual.
      static const std::map<unsigned int, unsigned int> n_nodes = {{15, 1},
                                                                   {1, 2},
                                                                   {8, 3},
                                                                   {2, 3},
                                                                   {9, 6},
                                                                   {3, 4},
                                                                   {10, 9},
                                                                   {16, 8},
                                                                   {5, 8},
                                                                   {12, 27},
                                                                   {17, 20}};
      const bool is_face = type == 3 || type == 10 || type == 16;
      const bool is_cell = type == 5 || type == 12 || type == 17;
      for (const unsigned int other : {4, 6, 7, 11, 13, 14, 18, 19})
        if (type == other)
          text.fail("It has tetrahedra, prisms or pyramids.");
      const auto known = n_nodes.find(type);
      if (known == n_nodes.end())
        text.fail("It has elements of Gmsh's type " + std::to_string(type) +
                  ", perhaps of higher order; save it with order 1 or 2.");

      std::vector<unsigned int> vertices(known->second);
      for (unsigned int &vertex : vertices)
        {
          // The nodes must end with the line: with a wrong type or a missing node, numbers of the
          // next element would be taken for those of this one.
          if (!binary && text.at_end_of_line())
            text.fail_in("$Elements");
          const auto number = size("$Elements");
          const auto found  = node.find(number);
          if (found == node.end())
            text.fail("An element uses node " + std::to_string(number) +
                      ", which the file does not have.");
          vertex = found->second;
        }
      if (!binary && !text.at_end_of_line())
        text.fail("An element of Gmsh's type " + std::to_string(type) + " has more than its " +
                  std::to_string(known->second) + " nodes.");

      // Points and lines make sets of nodes, lines by their ends; quadrangles carry the boundary
      // ids, triangles have none here.
      if (const bool is_line = type == 1 || type == 8; is_line || type == 15)
        for (const unsigned int number : groups)
          of_group[is_line ? 1 : 0][number].insert(vertices.begin(),
                                                   vertices.begin() + (is_line ? 2 : 1));
      if (is_cell)
        {
          // Gmsh numbers edges by their ends, others go around the bottom and the top.
          static constexpr unsigned int edges[12] = {8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15};
          const std::vector<unsigned int> nodes   = vertices;
          for (unsigned int e = 0; e < 12 && nodes.size() > 8; ++e)
            vertices[8 + e] = nodes[edges[e]];
          mesh.add_cell(vertices, binary ? element_number : text.line());
        }
      else if (is_face)
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
