// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/mesh_file.h>
#include <touchstone/mesh/mesh_text.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

// Meshes from legacy VTK files: hexahedra become cells and quadrilaterals faces; a scalar field
// of the cells numbers volumes and boundaries. CELLS, CELL_TYPES and CELL_DATA come one after the
// other in the file, so cells are kept as they are and translated at the end.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    struct VtkCell
    {
      std::vector<unsigned int> vertices;
      unsigned int              type = 0, line = 0;
      int                       number = 0;
    };

    /** One pass through a legacy .vtk file, keyword by keyword. */
    class VtkReader
    {
    public:
      explicit VtkReader(std::istream &in)
        : text(in)
      {
      }

      MeshFile
      read();

    private:
      MeshText             text;
      MeshFile             mesh;
      std::vector<VtkCell> cells;
      /** Whether CELL_DATA, not POINT_DATA, rules, and its numbers have been found. */
      bool has_cell_data = false, has_numbers = false;

      void
      read_header();
      void
      read_points();
      void
      read_cells();
      void
      read_types();
      /** @return whether the numbers were read, not skipped */
      bool
      read_scalars();
    };



    void
    VtkReader::read_header()
    {
      // Line 1 tells the format, line 2 is a free title, line 3 the encoding, line 4 the kind of
      // data.
      if (text.rest_of_line().find("vtk DataFile") == std::string::npos)
        throw MeshFileError("The first line does not say 'vtk DataFile'.");
      text.next_line();
      text.rest_of_line(); // title
      if (text.text("the header") != "ASCII")
        text.fail("The file is binary; save it as ASCII.");
      text.text("the header");
      if (text.text("the header") != "UNSTRUCTURED_GRID")
        text.fail("The file does not hold an UNSTRUCTURED_GRID.");
    }



    void
    VtkReader::read_points()
    {
      mesh.vertices.resize(text.announced("POINTS"));
      text.text("POINTS"); // type of the numbers
      for (Point<3> &x : mesh.vertices)
        x = text.point("POINTS");
    }



    void
    VtkReader::read_cells()
    {
      // CELLS announces the number of cells and the sum of numbers that follow, one more per cell
      // than its points; the second is checked against what was read.
      cells.resize(text.announced("CELLS"));
      const unsigned long announced = text.number("CELLS");
      const unsigned int  head      = text.line();
      unsigned long       found     = 0;
      // Version 5 of the format has another layout of CELLS, with offsets.
      if (text.next_character() == 'O')
        text.fail("CELLS has OFFSETS; save the file as version 4.2 or earlier.");
      for (VtkCell &cell : cells)
        {
          const unsigned long n = text.number("CELLS");
          cell.line             = text.line();
          for (unsigned long v = 0; v < n; ++v)
            {
              const unsigned long vertex = text.number("CELLS");
              if (vertex >= mesh.vertices.size())
                text.fail("A cell uses point " + std::to_string(vertex) + " of " +
                          std::to_string(mesh.vertices.size()) + ", counted from 0.");
              cell.vertices.push_back(vertex);
            }
          found += n + 1;
        }
      if (found != announced)
        throw MeshFileError(head,
                            "CELLS announces " + std::to_string(announced) + " numbers, its " +
                              std::to_string(cells.size()) + " cells have " +
                              std::to_string(found) + ".",
                            MeshFileError::default_remedy);
    }



    void
    VtkReader::read_types()
    {
      if (const unsigned long n = text.number("CELL_TYPES"); n != cells.size())
        text.fail("CELL_TYPES announces " + std::to_string(n) + " cells, CELLS " +
                  std::to_string(cells.size()) + ".");
      for (VtkCell &cell : cells)
        cell.type = text.number("CELL_TYPES");
    }



    /** Numbers of the cells: the field MaterialID or CellEntityIds, as deal.II
     * and Gmsh write it, or else the last one. */
    bool
    VtkReader::read_scalars()
    {
      const std::string name = text.text("SCALARS");
      text.text("SCALARS"); // type
      // The number of components is optional, and one if it is missing.
      const bool one_component = text.at_end_of_line() || text.number("SCALARS") == 1;
      if (text.text("SCALARS") != "LOOKUP_TABLE")
        text.fail_in("SCALARS");
      text.text("SCALARS"); // its name
      if (!has_cell_data || has_numbers || !one_component)
        return false;
      for (VtkCell &cell : cells)
        // Ids have no sign: negative numbers count as 0.
        cell.number = std::max(0., text.real("SCALARS"));
      has_numbers = name == "MaterialID" || name == "CellEntityIds";
      return true;
    }



    MeshFile
    VtkReader::read()
    {
      // Keywords are read one after the other; unknown ones and their numbers are skipped word by
      // word. Only after a section whose length is known must the next word be a keyword, i.e.
      // begin with a letter.
      read_header();
      std::set<std::string> sections;
      // The section whose numbers have all been read.
      std::string section;
      for (std::string word; text.word(word);)
        {
          if (!section.empty() && !std::isalpha(word[0]))
            text.fail("'" + word + "' stands where " + section + " should end: it has more " +
                        "entries than it announces, or is damaged.",
                      "save the mesh again, or correct the number at the head of " + section +
                        " if you know all of its lines to be right");
          section.clear();
          if (word == "POINTS" || word == "CELLS" || word == "CELL_TYPES")
            {
              if (!sections.insert(word).second)
                text.fail("The file has a second " + word + ".");
              if (word == "POINTS")
                read_points();
              else if (word == "CELLS")
                read_cells();
              else
                read_types();
              section = word;
            }
          else if (word == "CELL_DATA")
            {
              if (const unsigned long n = text.number("CELL_DATA"); n != cells.size())
                text.fail("CELL_DATA announces " + std::to_string(n) + " cells, CELLS " +
                          std::to_string(cells.size()) + ".");
              has_cell_data = true;
              section       = word;
            }
          else if (word == "POINT_DATA")
            has_cell_data = false;
          else if (word == "SCALARS" && read_scalars())
            section = word;
        }
      for (const char *needed : {"POINTS", "CELLS", "CELL_TYPES"})
        if (sections.count(needed) == 0)
          throw MeshFileError(std::string("The file has no ") + needed + ".");
      for (const VtkCell &cell : cells)
        add_vtk_cell(mesh, cell.type, cell.vertices, cell.number, cell.line);
      mesh.join_copies(false);
      return std::move(mesh);
    }
  } // namespace



  MeshFile
  read_vtk(std::istream &in)
  {
    return VtkReader(in).read();
  }
} // namespace Touchstone
