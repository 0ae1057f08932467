// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/mesh_file.h>
#include <touchstone/mesh/mesh_text.h>
#include <touchstone/mesh/named_arrays.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

// Meshes from legacy VTK files: hexahedra become cells and quadrilaterals faces; a scalar field
// of the cells numbers volumes and boundaries, and arrays that are asked for name boundaries and
// sets of nodes. CELLS, CELL_TYPES and CELL_DATA come one after the other in the file, so cells are
// kept as they are and translated at the end.
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

    /** Whether a field of the cells gives the numbers of volumes and boundaries, as deal.II and
     * Gmsh name them. */
    bool
    is_number(const std::string &name)
    {
      return name == "MaterialID" || name == "CellEntityIds";
    }



    /** One pass through a legacy .vtk file, keyword by keyword. */
    class VtkReader
    {
    public:
      VtkReader(std::istream &in, const std::vector<std::string> &boundary_arrays)
        : text(in)
        , boundary_arrays(boundary_arrays)
      {
      }

      MeshFile
      read();

    private:
      MeshText                       text;
      const std::vector<std::string> boundary_arrays;
      MeshFile                       mesh;
      std::vector<VtkCell>           cells;
      NamedArrays                    named;
      /** Which of CELL_DATA and POINT_DATA rules, and whether the numbers of cells have been found.
       */
      bool has_cell_data = false, has_point_data = false, has_numbers = false;

      void
      read_header();
      void
      read_points();
      void
      read_cells();
      void
      read_types();
      void
      read_data(bool of_cells);
      /** @return whether the numbers were read, not skipped */
      bool
      read_scalars();
      void
      read_fields();
      bool
      wanted(const std::string &name);
      /** The values of an array of one component. */
      void
      read_array(const std::string &name, const char *what);
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



    /** The head of CELL_DATA or POINT_DATA. */
    void
    VtkReader::read_data(const bool of_cells)
    {
      const char *const what  = of_cells ? "CELL_DATA" : "POINT_DATA";
      const std::size_t there = of_cells ? cells.size() : mesh.vertices.size();
      if (const unsigned long n = text.number(what); n != there)
        text.fail(std::string(what) + " announces " + std::to_string(n) +
                  (of_cells ? " cells, CELLS " : " points, POINTS ") + std::to_string(there) + ".");
      has_cell_data  = of_cells;
      has_point_data = !of_cells;
    }



    /** Whether an array is asked for, or numbers the cells. Others are skipped, whatever they hold.
     */
    bool
    VtkReader::wanted(const std::string &name)
    {
      named.known += (named.known.empty() ? "'" : ", '") + name + "'";
      return (has_cell_data && is_number(name)) ||
             std::count(boundary_arrays.begin(), boundary_arrays.end(), name) > 0;
    }



    void
    VtkReader::read_array(const std::string &name, const char *const what)
    {
      std::vector<double> values(has_cell_data ? cells.size() : mesh.vertices.size());
      for (double &value : values)
        value = text.real(what);
      if (has_cell_data && is_number(name))
        {
          // Ids have no sign: negative numbers count as 0.
          for (std::size_t c = 0; c < cells.size(); ++c)
            cells[c].number = std::max(0., values[c]);
          has_numbers = true;
        }
      (has_cell_data ? named.of_cells : named.of_points)[name] = std::move(values);
    }



    /** Arrays of cells or points, as ParaView and other programs write them. */
    void
    VtkReader::read_fields()
    {
      text.text("FIELD"); // its name
      const unsigned long n_arrays = text.number("FIELD");
      const std::size_t   size     = has_cell_data ? cells.size() : mesh.vertices.size();
      for (unsigned long k = 0; k < n_arrays; ++k)
        {
          std::string name = text.text("FIELD");
          // Behind an array, up to an empty line, there may be names of its components.
          if (name == "METADATA")
            {
              do
                text.next_line();
              while (!text.at_end_of_line());
              name = text.text("FIELD");
            }
          const unsigned long n_components = text.number("FIELD"), n = text.number("FIELD");
          text.text("FIELD"); // type
          if (n_components == 1 && n == size && wanted(name))
            read_array(name, "FIELD");
          else
            for (unsigned long i = 0; i < n_components * n; ++i)
              text.text("FIELD");
        }
    }



    /** An array of one component; where no field numbers the cells, the last one does. */
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
      if (one_component && (has_cell_data || has_point_data) && wanted(name))
        {
          read_array(name, "SCALARS");
          return true;
        }
      if (!has_cell_data || has_numbers || !one_component)
        return false;
      for (VtkCell &cell : cells)
        // Ids have no sign: negative numbers count as 0.
        cell.number = std::max(0., text.real("SCALARS"));
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
              read_data(true);
              section = word;
            }
          else if (word == "POINT_DATA")
            read_data(false);
          else if (word == "SCALARS" && read_scalars())
            section = word;
          else if (word == "FIELD" && (has_cell_data || has_point_data))
            read_fields();
        }
      for (const char *needed : {"POINTS", "CELLS", "CELL_TYPES"})
        if (sections.count(needed) == 0)
          throw MeshFileError(std::string("The file has no ") + needed + ".");
      for (unsigned int c = 0; c < cells.size(); ++c)
        {
          const VtkCell &cell = cells[c];
          add_vtk_cell(mesh, cell.type, cell.vertices, cell.number, cell.line);
          named.cell_of_face.resize(mesh.faces.size(), c);
        }
      named.add_boundaries(mesh, boundary_arrays);
      mesh.join_copies(false);
      return std::move(mesh);
    }
  } // namespace



  MeshFile
  read_vtk(std::istream &in, const std::vector<std::string> &boundary_arrays)
  {
    return VtkReader(in, boundary_arrays).read();
  }
} // namespace Touchstone
