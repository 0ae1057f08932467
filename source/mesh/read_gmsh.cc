// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/gmsh_groups.h>
#include <touchstone/mesh/gmsh_numbers.h>
#include <touchstone/mesh/mesh_file.h>
#include <touchstone/mesh/mesh_text.h>

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
    /** Points, lines, triangles, quadrangles and hexahedra of order 1 and 2. */
    enum class Shape
    {
      point,
      line,
      triangle,
      face,
      cell
    };

    struct ElementType
    {
      Shape        shape;
      unsigned int n_nodes;
    };

    /** By the codes of the Gmsh manual. */
    const std::map<unsigned int, ElementType> element_types = {{15, {Shape::point, 1}},
                                                               {1, {Shape::line, 2}},
                                                               {8, {Shape::line, 3}},
                                                               {2, {Shape::triangle, 3}},
                                                               {9, {Shape::triangle, 6}},
                                                               {3, {Shape::face, 4}},
                                                               {10, {Shape::face, 9}},
                                                               {16, {Shape::face, 8}},
                                                               {5, {Shape::cell, 8}},
                                                               {12, {Shape::cell, 27}},
                                                               {17, {Shape::cell, 20}}};



    /** One pass through a .msh file, section by section. */
    class GmshReader
    {
    public:
      explicit GmshReader(std::istream &in)
        : text(in)
        , numbers(text)
      {
      }

      MeshFile
      read();

    private:
      MeshText    text;
      GmshNumbers numbers;
      GmshGroups  groups;
      MeshFile    mesh;

      /** Index of a node's number. */
      std::map<unsigned long, unsigned int> node;
      /** Line of an element's number. */
      std::map<unsigned long, unsigned int> element;

      /** @return whether this section is one that is read */
      bool
      read_section(const std::string &section);
      void
      read_nodes();
      void
      read_blocks_of_nodes();
      void
      read_node(unsigned long number);
      void
      read_elements();
      void
      read_blocks_of_elements();
      void
      read_element(unsigned long number, unsigned int type, const std::vector<unsigned int> &of);
      std::vector<unsigned int>
      read_vertices(unsigned int type, unsigned int n_nodes);
      void
      check_sum(unsigned long found, unsigned long announced, const char *section);
    };



    MeshFile
    GmshReader::read()
    {
      // The sections can be in any order, except that the format comes first, as it decides how
      // the others are read.
      std::set<std::string> sections;
      std::string           word;
      while (text.word(word))
        {
          const std::string section = word, end = "$End" + word.substr(1);
          if (word[0] != '$')
            text.fail("The word '" + word + "' stands where a section like $Nodes should begin.");
          if (word != "$MeshFormat" && numbers.version() == 0.)
            text.fail("$MeshFormat should stand before " + word + ".");
          if (sections.count(word) > 0)
            text.fail("The file has a second " + word + ".");
          const bool is_known = read_section(section);
          if (is_known)
            sections.insert(section);
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
      mesh.join_copies(numbers.version() < 3.);
      groups.name_groups(mesh);
      return std::move(mesh);
    }



    bool
    GmshReader::read_section(const std::string &section)
    {
      if (numbers.binary() && section != "$PhysicalNames")
        text.next_line(); // the bytes begin there
      if (section == "$MeshFormat")
        {
          numbers.read_format();
          if (numbers.binary())
            mesh.place = "element";
        }
      else if (section == "$PhysicalNames")
        groups.read_names(text);
      else if (section == "$Entities")
        groups.read_entities(text, numbers);
      else if (section == "$PartitionedEntities")
        groups.read_partitioned_entities(text, numbers);
      else if (section == "$Nodes")
        numbers.version() < 3. ? read_nodes() : read_blocks_of_nodes();
      else if (section == "$Elements")
        numbers.version() < 3. ? read_elements() : read_blocks_of_elements();
      else
        return false;
      return true;
    }



    /** Version 2 has one node per line. */
    void
    GmshReader::read_nodes()
    {
      for (auto left = text.number("$Nodes"); left > 0; --left)
        read_node(text.number("$Nodes"));
    }



    /** Version 4 has blocks of numbers followed by blocks of coordinates. */
    void
    GmshReader::read_blocks_of_nodes()
    {
      const char *section   = "$Nodes";
      const auto  n         = numbers.size(section);
      const auto  announced = numbers.size(section);
      numbers.size(section); // smallest
      numbers.size(section); // and largest number of a node
      for (unsigned long block = 0; block < n; ++block)
        {
          numbers.tag(section);
          numbers.integer(section);
          if (numbers.tag(section) != 0)
            text.fail("The nodes have parametric coordinates; save the file without them.");
          std::vector<unsigned long> of_block(text.announced(section, numbers.size(section)));
          for (unsigned long &number : of_block)
            number = numbers.size(section);
          for (const unsigned long number : of_block)
            read_node(number);
        }
      check_sum(mesh.vertices.size(), announced, section);
    }



    /** Numbers of nodes may have gaps, so vertices are found by a map. */
    void
    GmshReader::read_node(const unsigned long number)
    {
      Point<3> x;
      for (unsigned int d = 0; d < 3; ++d)
        x[d] = numbers.real("$Nodes");
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
                          const char         *section)
    {
      if (found != announced)
        text.fail(std::string(section) + " announces " + std::to_string(announced) +
                  " entries and has " + std::to_string(found) + ".");
    }



    /** Version 2: each element names its type and tags, of which the first is its physical group,
     * or zero for none. */
    void
    GmshReader::read_elements()
    {
      const char *section = "$Elements";
      for (auto left = text.number(section); left > 0; --left)
        {
          const auto                number = text.number(section);
          const unsigned int        type   = text.number(section);
          std::vector<unsigned int> of;
          const auto                n_tags = text.number(section);
          for (unsigned long t = 0; t < n_tags; ++t)
            if (const long tag = text.signed_number(section); t == 0 && tag != 0)
              of.push_back(std::abs(tag));
          read_element(number, type, of);
        }
    }



    /** Version 4: blocks of one entity and type. */
    void
    GmshReader::read_blocks_of_elements()
    {
      const char *section   = "$Elements";
      const auto  n         = numbers.size(section);
      const auto  announced = numbers.size(section);
      numbers.size(section);
      numbers.size(section);
      for (unsigned long block = 0; block < n; ++block)
        {
          const auto                      d      = numbers.tag(section);
          const auto                      entity = numbers.tag(section);
          const auto                      type   = numbers.tag(section);
          const std::vector<unsigned int> of     = groups.of_entity(text, d, entity);
          for (auto left = numbers.size(section); left > 0; --left)
            read_element(numbers.size(section), type, of);
        }
      check_sum(element.size(), announced, section);
    }



    std::vector<unsigned int>
    GmshReader::read_vertices(const unsigned int type, const unsigned int n_nodes)
    {
      std::vector<unsigned int> vertices(n_nodes);
      for (unsigned int &vertex : vertices)
        {
          // The nodes must end with the line: with a wrong type or a missing node, numbers of the
          // next element would be taken for those of this one.
          if (!numbers.binary() && text.at_end_of_line())
            text.fail_in("$Elements");
          const auto number = numbers.size("$Elements");
          const auto found  = node.find(number);
          if (found == node.end())
            text.fail("An element uses node " + std::to_string(number) +
                      ", which the file does not have.");
          vertex = found->second;
        }
      if (!numbers.binary() && !text.at_end_of_line())
        text.fail("An element of Gmsh's type " + std::to_string(type) + " has more than its " +
                  std::to_string(n_nodes) + " nodes.");
      return vertices;
    }



    /** Points and lines make sets of nodes, lines by their ends; quadrangles carry the boundary
     * ids. */
    void
    GmshReader::read_element(const unsigned long              number,
                             const unsigned int               type,
                             const std::vector<unsigned int> &of)
    {
      const auto [known, is_new] = element.insert({number, text.line()});
      if (!is_new)
        text.fail("Element " + std::to_string(number) +
                    (numbers.binary()
                       ? " stands twice in the file."
                       : " stands in line " + std::to_string(known->second) + " already."),
                  "remove one of the two from the file, or save the mesh again");
      for (const unsigned int other : {4, 6, 7, 11, 13, 14, 18, 19})
        if (type == other)
          text.fail("It has tetrahedra, prisms or pyramids.");
      const auto element_type = element_types.find(type);
      if (element_type == element_types.end())
        text.fail("It has elements of Gmsh's type " + std::to_string(type) +
                  ", perhaps of higher order; save it with order 1 or 2.");
      const Shape shape = element_type->second.shape;
      if (shape == Shape::triangle)
        {
          const MeshFileError error = surface_error("Element " + std::to_string(number) +
                                                    " of Gmsh's type " + std::to_string(type));
          text.fail(error.what(), error.remedy);
        }
      std::vector<unsigned int> vertices = read_vertices(type, element_type->second.n_nodes);
      if (shape == Shape::point || shape == Shape::line)
        {
          vertices.resize(shape == Shape::point ? 1 : 2);
          groups.add_nodes(shape == Shape::point ? 0 : 1, of, vertices);
        }
      else if (shape == Shape::cell)
        {
          // Gmsh numbers edges by their ends, others go around the bottom and the top.
          static constexpr unsigned int edges[12] = {8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15};
          const std::vector<unsigned int> nodes   = vertices;
          for (unsigned int e = 0; e < 12 && nodes.size() > 8; ++e)
            vertices[8 + e] = nodes[edges[e]];
          mesh.add_cell(vertices, numbers.binary() ? number : text.line());
          for (const unsigned int group : of)
            MeshFile::group(mesh.volumes, group).members.push_back(mesh.cells.size() - 1);
        }
      else if (shape == Shape::face)
        {
          mesh.add_face({{vertices[0], vertices[1], vertices[2], vertices[3]}},
                        numbers.binary() ? number : text.line());
          for (const unsigned int group : of)
            MeshFile::group(mesh.surfaces, group).members.push_back(mesh.faces.size() - 1);
        }
    }
  } // namespace



  MeshFile
  read_gmsh(std::istream &in)
  {
    return GmshReader(in).read();
  }
} // namespace Touchstone
