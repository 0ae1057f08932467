#include <touchstone/mesh/mesh_file.h>

#include <algorithm>
#include <istream>
#include <stdexcept>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    template <typename Number>
    Number
    next(std::istream &in, const std::string &what)
    {
      Number value;
      if (!(in >> value))
        throw std::runtime_error("The file ends, or is damaged, in " + what + ".");
      return value;
    }

    struct VtkCell
    {
      std::vector<unsigned int> vertices;
      unsigned int              type   = 0;
      int                       number = 0;
    };

    /** How many points or cells follow. Each takes two bytes and more: a damaged file
     * must not make the program ask for memory without end. */
    unsigned int
    announced(std::istream &in, const std::string &what)
    {
      const auto n = next<unsigned int>(in, what);
      if (n > MeshFile::bytes_left(in) / 2)
        throw std::runtime_error("The file ends, or is damaged, in " + what + ".");
      return n;
    }

    /** Numbers of the cells: the field MaterialID or CellEntityIds, as deal.II
     * and Gmsh write it, or else the last one. */
    void
    read_cell_data(std::istream &in, std::vector<VtkCell> &cells)
    {
      for (std::string word; in >> word;)
        if (word == "SCALARS")
          {
            const auto name = next<std::string>(in, "SCALARS");
            next<std::string>(in, "SCALARS");
            while (next<std::string>(in, "SCALARS") != "LOOKUP_TABLE")
              ;
            next<std::string>(in, "SCALARS");
            for (VtkCell &cell : cells)
              cell.number = std::max(0., next<double>(in, "SCALARS " + name));
            if (name == "MaterialID" || name == "CellEntityIds")
              return;
          }
        else if (word == "POINT_DATA")
          return;
    }
  } // namespace



  MeshFile
  read_vtk(std::istream &in)
  {
    std::string line;
    std::getline(in, line);
    if (line.find("vtk DataFile") == std::string::npos)
      throw std::runtime_error("The first line does not say 'vtk DataFile'.");
    std::getline(in, line); // title
    if (next<std::string>(in, "the header") != "ASCII")
      throw std::runtime_error("The file is binary; save it as ASCII.");
    next<std::string>(in, "the header");
    if (next<std::string>(in, "the header") != "UNSTRUCTURED_GRID")
      throw std::runtime_error("The file does not hold an UNSTRUCTURED_GRID.");

    MeshFile             mesh;
    std::vector<VtkCell> cells;
    for (std::string word; in >> word;)
      if (word == "POINTS")
        {
          mesh.vertices.resize(announced(in, word));
          next<std::string>(in, word);
          for (Point<3> &x : mesh.vertices)
            for (unsigned int d = 0; d < 3; ++d)
              x[d] = next<double>(in, word);
        }
      else if (word == "CELLS")
        {
          cells.resize(announced(in, word));
          next<unsigned int>(in, word);
          if ((in >> std::ws).peek() == 'O')
            throw std::runtime_error("CELLS has OFFSETS; save the file as version 4.2 or "
                                     "earlier.");
          for (VtkCell &cell : cells)
            {
              const auto n = next<unsigned int>(in, word);
              for (unsigned int v = 0; v < n; ++v)
                {
                  cell.vertices.push_back(next<unsigned int>(in, word));
                  if (cell.vertices.back() >= mesh.vertices.size())
                    throw std::runtime_error("A cell uses a point that the file does not "
                                             "have.");
                }
            }
        }
      else if (word == "CELL_TYPES")
        {
          next<unsigned int>(in, word);
          for (VtkCell &cell : cells)
            cell.type = next<unsigned int>(in, word);
        }
      else if (word == "CELL_DATA")
        {
          next<unsigned int>(in, word);
          read_cell_data(in, cells);
        }

    constexpr unsigned int quad = 9, hexahedron = 12, first_solid = 10;
    for (const VtkCell &cell : cells)
      if (cell.type == hexahedron && cell.vertices.size() == 8)
        {
          MeshFile::group(mesh.volumes, cell.number).members.push_back(mesh.cells.size());
          mesh.add_cell(cell.vertices);
        }
      else if (cell.type == quad && cell.vertices.size() == 4)
        {
          const auto &v = cell.vertices;
          MeshFile::group(mesh.surfaces, cell.number).members.push_back(mesh.faces.size());
          mesh.faces.push_back({{v[0], v[1], v[2], v[3]}});
        }
      else if (cell.type >= first_solid || cell.type == 0)
        throw std::runtime_error("It has cells of VTK's type " + std::to_string(cell.type) + ".");
    return mesh;
  }
} // namespace Touchstone
