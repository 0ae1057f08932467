// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/exact_surface.h>
#include <touchstone/mesh/mesh_file.h>
#include <touchstone/mesh/mesh_text.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

// A body from a mesh file: cells of one volume of the file are selected, checked and oriented,
// their boundary faces get ids from the surfaces that the file marks, and exact surfaces are
// attached. The formats are read elsewhere (read_gmsh.cc, read_abaqus.cc, read_vtk.cc) into the
// common MeshFile.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Boundary id of faces that the file does not mark. */
    constexpr types::boundary_id unmarked = 0;

    /** @brief A body, or one of several, from a mesh file. */
    class FileGeometry : public Geometry
    {
    public:
      void
      declare(ParameterHandler &prm) override;
      void
      check(const std::string &section) const override;
      BodyMesh
      create(double factor, const std::string &section, const std::string &folder) const override;
      std::string
      fingerprint(const std::string &folder) const override;

    private:
      std::string                               file, volume, exact;
      std::map<std::string, types::boundary_id> extra_names;

      MeshFile
      read(const std::string &section, const std::string &folder) const;
      /** Vertices and cells of the body, and the body's numbers of the file's
       * vertices. */
      BodyMesh
      select(const MeshFile                       &mesh_file,
             std::map<unsigned int, unsigned int> &vertex_numbers,
             const std::string                    &section) const;
      void
      orient(BodyMesh &mesh, const std::string &section) const;
      void
      mark(BodyMesh                                   &mesh,
           const MeshFile                             &mesh_file,
           const std::map<unsigned int, unsigned int> &vertex_numbers,
           const std::string                          &section) const;
      void
      attach_exact_surfaces(BodyMesh &mesh, const std::string &section) const;
    };



    void
    FileGeometry::declare(ParameterHandler &prm)
    {
      prm.add_parameter("File",
                        file,
                        "Mesh file, relative to the folder of the scene file: Gmsh .msh "
                        "(version 2.2 or 4.1), Abaqus .inp or legacy .vtk, in ASCII, with "
                        "hexahedra of order one.");
      prm.add_parameter("Volume",
                        volume,
                        "Which cells of the file are this body: the name or number of a "
                        "physical volume (Gmsh), the name of an ELSET (Abaqus), the number "
                        "of a material (VTK field MaterialID). Empty: all.");
      prm.add_parameter("Boundary names",
                        extra_names,
                        "Names for boundaries that have only numbers in the file: 'contact: "
                        "1, bottom: 2'. Faces that the file does not mark are number 0.");
      prm.add_parameter("Exact surfaces",
                        exact,
                        std::string("The shapes that boundaries of the mesh stand for; "
                                    "contact then takes gaps and normals from them. ") +
                          exact_surface_documentation);
    }



    void
    FileGeometry::check(const std::string &section) const
    {
      // The file itself is opened only when the mesh is made; here are checks of what the input
      // says.
      const std::string extension = std::filesystem::path(file).extension();
      if (extension != ".msh" && extension != ".inp" && extension != ".vtk")
        throw InputError(section,
                         "File",
                         file,
                         file.empty() ? "there is no file name."
                                      : "the name does not end in .msh, .inp or .vtk",
                         "name a mesh file of Gmsh (.msh), Abaqus (.inp) or VTK (.vtk)");
      try
        {
          parse_exact_surfaces(exact);
        }
      catch (const std::runtime_error &error)
        {
          throw InputError(section,
                           "Exact surfaces",
                           exact,
                           error.what(),
                           "write it like 'bore: cylinder axis z radius 1 inside'");
        }
    }



    BodyMesh
    FileGeometry::create(const double       factor,
                         const std::string &section,
                         const std::string &folder) const
    {
      // Powers of two were taken out of the factor before (Forest::make): what is left cannot be
      // had from given cells.
      if (factor != 1.)
        throw InputError("Discretisation",
                         "Refinement factor",
                         "",
                         "the body of '" + section +
                           "' takes its mesh from a file, which can only be refined as a "
                           "whole",
                         "use 1, 2, 4 or another power of two");

      const MeshFile mesh_file = read(section, folder);

      std::map<unsigned int, unsigned int> vertex_numbers;
      BodyMesh                             mesh = select(mesh_file, vertex_numbers, section);
      orient(mesh, section);
      try
        {
          mark(mesh, mesh_file, vertex_numbers, section);
        }
      // An InputError of mark() already names section and key; other errors come from the mesh
      // itself.
      catch (const InputError &)
        {
          throw;
        }
      catch (const std::runtime_error &error)
        {
          throw InputError(section,
                           "File",
                           file,
                           std::string("the mesh is not a body: ") + error.what() + ".",
                           "remove duplicate cells from the mesh");
        }
      attach_exact_surfaces(mesh, section);
      return mesh;
    }



    /** Size and checksum of the file, by which a run that resumes from a checkpoint notices that
     * the mesh has changed. */
    std::string
    FileGeometry::fingerprint(const std::string &folder) const
    {
      std::ifstream      in(std::filesystem::path(folder) / file, std::ios::binary);
      boost::crc_32_type checksum;
      std::size_t        size = 0;
      for (std::array<char, 65536> part; in.read(part.data(), part.size()), in.gcount() > 0;)
        {
          checksum.process_bytes(part.data(), in.gcount());
          size += in.gcount();
        }
      return std::to_string(size) + " bytes, checksum " + std::to_string(checksum.checksum());
    }



    MeshFile
    FileGeometry::read(const std::string &section, const std::string &folder) const
    {
      const std::filesystem::path path = std::filesystem::path(folder) / file;
      std::ifstream               in(path);
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
                                                              : read_vtk(in);
          if (mesh.cells.empty())
            throw MeshFileError("The file has no hexahedra.");
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
                         const std::string                    &section) const
    {
      // A volume can be called by its name or by its number; if several groups match, all of them
      // are taken.
      std::vector<CellData<3>> cells;
      if (volume.empty())
        cells = mesh_file.cells;
      else
        {
          std::string available;
          for (const MeshFile::Group &group : mesh_file.volumes)
            {
              if (group.name == volume || std::to_string(group.number) == volume)
                for (const unsigned int c : group.members)
                  cells.push_back(mesh_file.cells[c]);
              available +=
                (available.empty() ? "" : ", ") +
                (group.name.empty() ? std::to_string(group.number) : "'" + group.name + "'");
            }
          if (cells.empty())
            throw InputError(section,
                             "Volume",
                             volume,
                             "the file '" + file + "' has no cells of this name or number",
                             available.empty()
                               ? "leave it empty; the file does not name its volumes."
                               : "the file has " + available + ".");
        }

      BodyMesh mesh;
      mesh.cells = cells;
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



    /** Give each boundary face the id of the surface of the file to which it belongs. Faces are
     * compared by sorted vertices. Faces of the file between two cells, or of other volumes, are
     * ignored. */
    void
    FileGeometry::mark(BodyMesh                                   &mesh,
                       const MeshFile                             &mesh_file,
                       const std::map<unsigned int, unsigned int> &vertex_numbers,
                       const std::string                          &section) const
    {
      std::map<FaceVertices, std::set<types::boundary_id>> marks;
      types::boundary_id                                   next = unmarked + 1;
      for (const MeshFile::Group &group : mesh_file.surfaces)
        {
          // Ids for shared faces begin behind the highest number of the file.
          next = std::max(next, group.number + 1);
          for (const unsigned int f : group.members)
            {
              FaceVertices face{};
              bool         belongs = true;
              for (unsigned int v = 0; v < 4 && belongs; ++v)
                {
                  const auto found = vertex_numbers.find(mesh_file.faces[f][v]);
                  belongs          = found != vertex_numbers.end();
                  if (belongs)
                    face[v] = found->second;
                }
              std::sort(face.begin(), face.end());
              if (belongs)
                marks[face].insert(group.number);
            }
        }

      std::set<types::boundary_id>                               used;
      std::map<std::set<types::boundary_id>, types::boundary_id> shared_ids;
      add_boundary_faces(mesh, [&](FaceVertices face) {
        std::sort(face.begin(), face.end());
        const auto found = marks.find(face);
        const auto of =
          found != marks.end() ? found->second : std::set<types::boundary_id>{unmarked};
        used.insert(of.begin(), of.end());
        if (of.size() == 1)
          return std::make_pair(*of.begin(), numbers::flat_manifold_id);
        // A face of several boundaries gets an id of its own, which all of them have.
        const auto [id, is_new] = shared_ids.insert({of, next});
        if (is_new)
          mesh.shared[next++] = of;
        return std::make_pair(id->second, numbers::flat_manifold_id);
      });

      if (used.count(unmarked) > 0)
        mesh.boundary_names["unmarked"] = unmarked;
      for (const MeshFile::Group &group : mesh_file.surfaces)
        if (used.count(group.number) > 0 && !group.name.empty())
          mesh.boundary_names[group.name] = group.number;
      // Names from the input for formats that have numbers only, checked like those of the file:
      // they must exist, and must not rename another boundary.
      for (const auto &[name, number] : extra_names)
        {
          if (used.count(number) == 0)
            throw InputError(section,
                             "Boundary names",
                             name + ": " + std::to_string(number),
                             "the body has no boundary of this number",
                             "its numbers are " +
                               Patterns::Tools::to_string(
                                 std::vector<unsigned int>(used.begin(), used.end())) +
                               ".");
          const auto [known, is_new] = mesh.boundary_names.insert({name, number});
          if (!is_new && known->second != number)
            throw InputError(section,
                             "Boundary names",
                             name + ": " + std::to_string(number),
                             "the file calls boundary " + std::to_string(known->second) +
                               " by this name",
                             "take another name");
        }
    }



    void
    FileGeometry::attach_exact_surfaces(BodyMesh &mesh, const std::string &section) const
    {
      // Each exact surface becomes the manifold of its faces, for refinement, and the surface
      // from which contact takes gaps. Vertices are moved to it; a vertex farther away than 1e-3
      // of the size of a face tells of wrong parameters, not of rounding in the file.
      types::manifold_id next = 0;
      for (const auto &[name, shape] : parse_exact_surfaces(exact))
        {
          mesh.manifolds[next] = shape.manifold;
          if (name == "cells")
            for (CellData<3> &cell : mesh.cells)
              cell.manifold_id = next;
          else
            {
              const auto found = mesh.boundary_names.find(name);
              if (found == mesh.boundary_names.end())
                throw InputError(section,
                                 "Exact surfaces",
                                 name,
                                 "the body has no boundary of this name",
                                 "use a name from the file or from 'Boundary names'");
              // With the faces that it shares with others.
              std::set<types::boundary_id> ids{found->second};
              for (const auto &[id, of] : mesh.shared)
                if (of.count(found->second) > 0)
                  ids.insert(id);
              for (const types::boundary_id id : ids)
                mesh.surfaces[id] = shape.surface;

              double farthest = 0., size = 0.;
              for (CellData<2> &face : mesh.subcells.boundary_quads)
                if (ids.count(face.boundary_id) > 0)
                  {
                    face.manifold_id = next;
                    for (const unsigned int v : face.vertices)
                      {
                        // Files round coordinates to few digits; the formula is exact.
                        Point<3>      &x     = mesh.vertices[v];
                        const Point<3> exact = shape.surface->project(x);
                        farthest             = std::max(farthest, exact.distance(x));
                        x                    = exact;
                      }
                    size = std::max(size,
                                    mesh.vertices[face.vertices[0]].distance(
                                      mesh.vertices[face.vertices[3]]));
                  }
              if (farthest > 1e-3 * size)
                throw InputError(section,
                                 "Exact surfaces",
                                 name,
                                 "the surface is " + Patterns::Tools::to_string(farthest) +
                                   " away from a vertex of the boundary",
                                 "check axis, point, radius and slope");
            }
          ++next;
        }
    }

    const GeometryRegistry::Entry<FileGeometry>
      file_entry("file",
                 "A mesh file of Gmsh, Abaqus or VTK, or one of the volumes in it, with the "
                 "boundaries that the file names.");
  } // namespace
} // namespace Touchstone
