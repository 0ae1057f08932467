// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/file_geometry.h>
#include <touchstone/mesh/mesh_text.h>

#include <deal.II/grid/grid_tools.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <new>
#include <numeric>
#include <utility>

// The cells of a body from a mesh file: read, those of one volume selected, checked and oriented.
// The formats are read elsewhere (read_gmsh.cc, read_abaqus.cc, read_vtk.cc, read_vtu.cc) into the
// common MeshFile.
namespace Touchstone
{
  using namespace dealii;

  MeshFile
  FileGeometry::read(const std::string &section, const std::string &folder) const
  {
    const std::filesystem::path path = std::filesystem::path(folder) / file;
    std::ifstream               in(path, std::ios::binary);
    if (!in || std::filesystem::is_directory(path))
      throw InputError(section,
                       "File",
                       file,
                       "the mesh file '" + path.string() + "' cannot be opened",
                       "check the name; it is relative to the folder of the scene file");
    try
      {
        const std::string extension = path.extension();
        MeshFile          mesh      = extension == ".msh"   ? read_gmsh(in)
                                      : extension == ".inp" ? read_abaqus(in)
                                      : extension == ".vtu" ? read_vtu(in, boundary_arrays)
                                                            : read_vtk(in, boundary_arrays);
        if (mesh.cells.empty())
          throw MeshFileError("The file has no hexahedra.");
        mesh.check_faces();
        return mesh;
      }
    // A damaged number of entries can ask for any amount of memory; that is an error of the
    // file, not of the program.
    catch (const std::bad_alloc &)
      {
        throw InputError(section,
                         "File",
                         file,
                         "the mesh file announces more nodes or cells than memory can hold",
                         "save the mesh again; the file may be damaged");
      }
    catch (const MeshFileError &error)
      {
        throw InputError(section,
                         "File",
                         file,
                         std::string("the mesh file cannot be used. ") + error.what(),
                         error.remedy);
      }
  }



  /** Only vertices that the selected cells use are taken, in the order of their first use: a
   * vertex without a cell would be invalid in deal.II. */
  BodyMesh
  FileGeometry::select(const MeshFile                       &mesh_file,
                       std::map<unsigned int, unsigned int> &vertex_numbers,
                       std::vector<unsigned int>            &cell_numbers,
                       const std::string                    &section) const
  {
    // A volume can be called by its name or by its number; if several groups match, all of them
    // are taken.
    if (volume.empty())
      {
        cell_numbers.resize(mesh_file.cells.size());
        std::iota(cell_numbers.begin(), cell_numbers.end(), 0);
      }
    else
      {
        std::string available;
        for (const MeshFile::Group &group : mesh_file.volumes)
          {
            if (group.name == volume || std::to_string(group.number) == volume)
              cell_numbers.insert(cell_numbers.end(), group.members.begin(), group.members.end());
            available +=
              (available.empty() ? "" : ", ") +
              (group.name.empty() ? std::to_string(group.number) : "'" + group.name + "'");
          }
        if (cell_numbers.empty())
          throw InputError(section,
                           "Volume",
                           volume,
                           "the file '" + file + "' has no cells of this name or number",
                           available.empty() ? "leave it empty; the file does not name its volumes."
                                             : "the file has " + available + ".");
      }

    BodyMesh mesh;
    for (const unsigned int c : cell_numbers)
      mesh.cells.push_back(mesh_file.cells[c]);
    for (CellData<3> &cell : mesh.cells)
      for (unsigned int &v : cell.vertices)
        {
          const auto [where, is_new] = vertex_numbers.insert({v, mesh.vertices.size()});
          if (is_new)
            mesh.vertices.push_back(mesh_file.vertices[v]);
          v = where->second;
        }
    return mesh;
  }



  void
  FileGeometry::orient(BodyMesh &mesh, const std::string &section) const
  {
    // If all are numbered the wrong way round, it is the file's convention. If
    // some are, the mesh is folded, and turning them would only hide it.
    if (orientation(mesh).negative == mesh.cells.size())
      for (CellData<3> &cell : mesh.cells)
        for (unsigned int v = 0; v < 4; ++v)
          std::swap(cell.vertices[v], cell.vertices[v + 4]);

    const Orientation count = orientation(mesh);
    const unsigned    bad   = count.negative + count.distorted;
    if (bad > 0)
      throw InputError(section,
                       "File",
                       file,
                       std::to_string(bad) + " of " + std::to_string(mesh.cells.size()) +
                         (bad == 1 ? " cells is" : " cells are") +
                         " inverted or distorted: the Jacobian is not positive at each "
                         "corner",
                       "repair the mesh in the program that made it");
    // deal.II needs edges whose directions agree between neighbouring cells, which files do not
    // guarantee.
    GridTools::consistently_order_cells(mesh.cells);
  }
} // namespace Touchstone
