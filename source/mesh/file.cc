// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/exact_surface.h>
#include <touchstone/mesh/file_geometry.h>

#include <array>
#include <boost/crc.hpp>
#include <filesystem>
#include <fstream>

// A body from a mesh file: its input, and the order in which it is made. Its cells are made in
// file_cells.cc, its boundaries in file_boundaries.cc.
namespace Touchstone
{
  using namespace dealii;

  void
  FileGeometry::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "File",
      file,
      "Mesh file, relative to the folder of the scene file: Gmsh .msh "
      "(version 2.2, or 4.1 in ASCII or binary), Abaqus .inp, legacy .vtk in ASCII, "
      "or .vtu, with hexahedra of 8, 20 or 27 nodes. Nodes in the middle of edges "
      "and faces give curved cells, which elements of degree 2 have and new nodes "
      "of refinement lie on.");
    prm.add_parameter("Volume",
                      volume,
                      "Which cells of the file are this body: the name or number of a "
                      "physical volume (Gmsh), the name of an ELSET (Abaqus), the number "
                      "of a material (VTK field MaterialID). Empty: all.");
    prm.add_parameter("Boundary names",
                      extra_names,
                      "Names for boundaries that have only numbers in the file: 'contact: "
                      "1, bottom: 2'. Faces that the file does not mark are number 0.");
    prm.add_parameter(
      "Boundary arrays",
      boundary_arrays,
      "Boundaries of a .vtk or .vtu file by arrays of one component that have these "
      "names: 'contact, bottom'. A face belongs to each whose value is not zero "
      "in it, if it is a cell of the file, or at all of its corners. An "
      "array that marks points but no whole face names a set of nodes.");
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
    if (extension != ".msh" && extension != ".inp" && extension != ".vtk" && extension != ".vtu")
      throw InputError(section,
                       "File",
                       file,
                       file.empty() ? "there is no file name."
                                    : "the name does not end in .msh, .inp, .vtk or .vtu",
                       "name a mesh file of Gmsh (.msh), Abaqus (.inp) or VTK (.vtk, .vtu)");
    if (!boundary_arrays.empty() && extension != ".vtu" && extension != ".vtk")
      throw InputError(section,
                       "Boundary arrays",
                       Patterns::Tools::to_string(boundary_arrays),
                       "the file '" + file + "' has no arrays of boundaries",
                       "leave it empty; only .vtk and .vtu files have such arrays");
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
    std::vector<unsigned int>            cell_numbers;
    BodyMesh mesh = select(mesh_file, vertex_numbers, cell_numbers, section);
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
    take_sets(mesh, mesh_file, vertex_numbers, cell_numbers, section);
    curve(mesh, mesh_file, vertex_numbers, cell_numbers, section);
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



  namespace
  {
    const GeometryRegistry::Entry<FileGeometry>
      file_entry("file",
                 "A mesh file of Gmsh, Abaqus or VTK, or one of the volumes in it, with the "
                 "boundaries that the file names.");
  } // namespace
} // namespace Touchstone
