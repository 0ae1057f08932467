// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/mesh_file.h>
#include <touchstone/mesh/mesh_text.h>
#include <touchstone/mesh/named_arrays.h>
#include <touchstone/mesh/vtu_arrays.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <map>
#include <set>
#include <sstream>

// Meshes from VTK's XML files (.vtu): hexahedra become cells and quadrilaterals faces, numbered by
// a field of the cells as in legacy files. Boundaries may be named by arrays instead: of the faces,
// or of the points of files that have hexahedra alone.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Refuse an array of numbers that are no whole ones, which would be cut to some. */
    void
    check_whole(const std::vector<double> &values, const std::string &name)
    {
      // Beyond this there are no nodes, cells or boundaries.
      constexpr double most = 4294967295.;
      for (std::size_t k = 0; k < values.size(); ++k)
        if (!(std::abs(values[k]) <= most && values[k] == std::floor(values[k])))
          {
            std::ostringstream value;
            value << values[k];
            throw MeshFileError("Number " + std::to_string(k) + " of the array '" + name +
                                "', counted from 0, is " + value.str() + ": no whole number.");
          }
    }



    /** One piece of the grid, the arrays of the file by section and name. */
    class VtuReader
    {
    public:
      VtuReader(std::istream &in, const std::vector<std::string> &boundary_arrays)
        : arrays(in)
        , boundary_arrays(boundary_arrays)
      {
      }

      MeshFile
      read();

    private:
      const VtuArrays                arrays;
      const std::vector<std::string> boundary_arrays;
      MeshFile                       mesh;

      /** An array that must be there and have so many numbers. */
      std::vector<double>
      get(const std::string &section, const std::string &name, std::size_t n) const;
      void
      add_points();
      void
      add_cells();
      void
      add_named_boundaries();
    };



    std::vector<double>
    VtuReader::get(const std::string &section, const std::string &name, const std::size_t n) const
    {
      const std::vector<double> *values = arrays.find(section, name);
      if (values == nullptr)
        throw MeshFileError("The file has no array '" + name + "' in " + section + ".");
      if (values->size() != n)
        throw MeshFileError("The array '" + name + "' of " + section + " has " +
                            std::to_string(values->size()) + " numbers, not " + std::to_string(n) +
                            ".");
      return *values;
    }



    void
    VtuReader::add_points()
    {
      const std::vector<double> x = get("Points", "", 3 * arrays.n_points());
      for (std::size_t p = 0; p < arrays.n_points(); ++p)
        {
          mesh.vertices.emplace_back(x[3 * p], x[3 * p + 1], x[3 * p + 2]);
          if (!std::isfinite(mesh.vertices.back().norm_square()))
            throw MeshFileError("Point " + std::to_string(p) + " is not finite.");
        }
    }



    void
    VtuReader::add_cells()
    {
      const std::size_t         n       = arrays.n_cells();
      const std::vector<double> types   = get("Cells", "types", n),
                                offsets = get("Cells", "offsets", n);
      check_whole(types, "types");
      check_whole(offsets, "offsets");
      const std::vector<double> points =
        get("Cells", "connectivity", n == 0 ? 0 : std::lround(offsets.back()));
      check_whole(points, "connectivity");
      // Numbers of volumes and boundaries, as deal.II and Gmsh name them.
      std::vector<double> number(n, 0.);
      for (const char *name : {"CellEntityIds", "MaterialID"})
        if (arrays.find("CellData", name) != nullptr)
          {
            number = get("CellData", name, n);
            check_whole(number, name);
          }

      std::size_t begin = 0;
      for (std::size_t c = 0; c < n; ++c)
        {
          const double end = offsets[c];
          if (!(end >= begin && end <= points.size()))
            throw MeshFileError("The array 'offsets' of Cells does not ascend at cell " +
                                std::to_string(c) + ", counted from 0.");
          std::vector<unsigned int> nodes;
          for (; begin < end; ++begin)
            {
              if (!(points[begin] >= 0. && points[begin] < mesh.vertices.size()))
                throw MeshFileError("Cell " + std::to_string(c) + " uses point " +
                                    std::to_string(std::lround(points[begin])) + " of " +
                                    std::to_string(mesh.vertices.size()) + ", counted from 0.");
              nodes.push_back(points[begin]);
            }
          // Ids have no sign: negative numbers count as 0.
          add_vtk_cell(mesh, types[c], nodes, std::max(0., number[c]), c);
        }
    }



    // Only those that are asked for; get() refuses a wrong number of values.
    void
    VtuReader::add_named_boundaries()
    {
      NamedArrays named;
      named.known        = arrays.names();
      named.cell_of_face = mesh.face_lines;
      for (const std::string &name : boundary_arrays)
        if (arrays.find("PointData", name) != nullptr)
          named.of_points[name] = get("PointData", name, arrays.n_points());
        else if (arrays.find("CellData", name) != nullptr)
          named.of_cells[name] = get("CellData", name, arrays.n_cells());
      named.add_boundaries(mesh, boundary_arrays);
    }



    MeshFile
    VtuReader::read()
    {
      mesh.place = "cell";
      add_points();
      add_cells();
      add_named_boundaries();
      mesh.join_copies(false);
      return std::move(mesh);
    }
  } // namespace



  void
  add_vtk_cell(MeshFile                        &mesh,
               const double                     type,
               const std::vector<unsigned int> &nodes,
               const unsigned int               number,
               const unsigned int               line)
  {
    // Codes of the VTK manual. Points and lines are dropped. Other solids are an error, for the
    // body would have holes without them, and so are triangles, polygons and pixels.
    static const std::map<int, unsigned int> quads     = {{9, 4}, {23, 8}, {28, 9}},
                                             hexahedra = {{12, 8}, {25, 20}, {29, 27}};
    static const std::set<int> lines = {1, 2, 3, 4, 21, 35}, surfaces = {5, 6, 7, 8, 22, 34};

    const int         code    = static_cast<int>(type);
    const bool        is_quad = quads.count(code) > 0, is_hexahedron = hexahedra.count(code) > 0;
    const std::string of_type = "VTK's type " + std::to_string(code);
    const auto        fail    = [&](const std::string &problem,
                          const std::string &remedy = MeshFileError::default_remedy) {
      if (mesh.place == "line")
        throw MeshFileError(line, problem, remedy);
      throw MeshFileError("Cell " + std::to_string(line) + ", counted from 0: " + problem, remedy);
    };
    if (is_quad || is_hexahedron)
      {
        const unsigned int n = (is_quad ? quads : hexahedra).at(code);
        if (nodes.size() != n)
          fail("A cell of " + of_type + " has " + std::to_string(nodes.size()) + " points, not " +
               std::to_string(n) + ".");
      }
    else if (surfaces.count(code) > 0)
      {
        const MeshFileError error = surface_error("A cell of " + of_type);
        fail(error.what(), error.remedy);
      }
    else if (lines.count(code) == 0)
      fail("It has cells of " + of_type + ".");

    if (is_hexahedron)
      {
        MeshFile::group(mesh.volumes, number).members.push_back(mesh.cells.size());
        mesh.add_cell(nodes, line);
      }
    else if (is_quad)
      {
        MeshFile::group(mesh.surfaces, number).members.push_back(mesh.faces.size());
        mesh.add_face({{nodes[0], nodes[1], nodes[2], nodes[3]}}, line);
      }
  }



  MeshFile
  read_vtu(std::istream &in, const std::vector<std::string> &boundary_arrays)
  {
    return VtuReader(in, boundary_arrays).read();
  }
} // namespace Touchstone
