// SPDX-License-Identifier: LGPL-2.1-or-later
// Hexahedra of 20 and 27 nodes of all formats: a quarter of a ring whose middle nodes lie on its
// circles has the same volume and areas from each file, and the same on any refinement; a body
// with straight edges is one without middle nodes. Binary Gmsh and encodings of .vtu. What is wrong
// with a file is said.

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/numerics/data_out.h>

#include "mesh_common.h"
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** Nodes of two cells, one over the other in angle, by the coordinates of a lattice. */
  struct Ring
  {
    std::vector<Point<3>>                  points;
    std::vector<std::vector<unsigned int>> cells; // 27 nodes in the order of .vtu
    double                                 bend = 1.;

    /** Places of the nodes of a cell in VTK's order: corners, edges, faces, cell. */
    static constexpr int places[27][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2},
                                          {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 0}, {2, 1, 0},
                                          {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2},
                                          {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1},
                                          {0, 1, 1}, {2, 1, 1}, {1, 0, 1}, {1, 2, 1}, {1, 1, 0},
                                          {1, 1, 2}, {1, 1, 1}};

    explicit Ring(const bool round = true)
    {
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 5; ++j)
          for (int i = 0; i < 3; ++i)
            {
              const double r = 1. + 0.5 * i, angle = numbers::PI / 8. * j;
              Point<3>     x(r * std::cos(angle), r * std::sin(angle), 0.5 * k);
              if (!round && j % 2 == 1)
                {
                  const double a = angle - numbers::PI / 8., b = angle + numbers::PI / 8.;
                  x = Point<3>(r * (std::cos(a) + std::cos(b)) / 2.,
                               r * (std::sin(a) + std::sin(b)) / 2.,
                               0.5 * k);
                }
              points.push_back(x);
            }
      for (int c = 0; c < 2; ++c)
        {
          cells.emplace_back();
          for (const auto &p : places)
            cells.back().push_back(p[0] + 3 * (p[1] + 2 * c) + 15 * p[2]);
        }
    }

    /** Corners of the inner face of a cell. */
    std::vector<unsigned int>
    inner_face(const unsigned int c, const unsigned int n) const
    {
      std::vector<unsigned int> face;
      for (const unsigned int v : {0, 3, 7, 4, 11, 19, 15, 16, 20})
        if (face.size() < n)
          face.push_back(cells[c][v]);
      return face;
    }
  };



  /** Abaqus numbers the middle of the cell before those of its faces. */
  void
  write_abaqus(const std::string &name, const Ring &ring, const unsigned int n)
  {
    std::ofstream out(name);
    out.precision(16);
    out << "*NODE\n";
    for (unsigned int p = 0; p < ring.points.size(); ++p)
      out << p + 1 << ", " << ring.points[p][0] << ", " << ring.points[p][1] << ", "
          << ring.points[p][2] << '\n';
    out << "*ELEMENT, TYPE=C3D" << n << (n == 20 ? "R" : "") << ", ELSET=ALL\n";
    for (unsigned int c = 0; c < 2; ++c)
      {
        out << c + 1;
        std::vector<unsigned int> order = ring.cells[c];
        std::rotate(order.begin() + 20, order.begin() + 26, order.end());
        for (unsigned int v = 0; v < n; ++v)
          out << ", " << (v % 8 == 7 ? "\n" : "") << order[v] + 1;
        out << '\n';
      }
    out << "*SURFACE, NAME=INNER\nALL, S6\n";
  }



  /** Gmsh numbers edges from each node to later ones. */
  std::vector<unsigned int>
  gmsh_order(const std::vector<unsigned int> &cell, const unsigned int n)
  {
    static const int          edges[12][2] = {{0, 1},
                                              {0, 3},
                                              {0, 4},
                                              {1, 2},
                                              {1, 5},
                                              {2, 3},
                                              {2, 6},
                                              {3, 7},
                                              {4, 5},
                                              {4, 7},
                                              {5, 6},
                                              {6, 7}};
    static const int          vtk[12][2]   = {{0, 1},
                                              {1, 2},
                                              {2, 3},
                                              {3, 0},
                                              {4, 5},
                                              {5, 6},
                                              {6, 7},
                                              {7, 4},
                                              {0, 4},
                                              {1, 5},
                                              {2, 6},
                                              {3, 7}};
    std::vector<unsigned int> result(cell.begin(), cell.begin() + 8);
    for (const auto &edge : edges)
      for (unsigned int e = 0; e < 12; ++e)
        if (std::minmax(edge[0], edge[1]) == std::minmax(vtk[e][0], vtk[e][1]))
          result.push_back(cell[8 + e]);
    // Faces: bottom, front, left, right, back, top.
    for (const unsigned int f : {24, 22, 20, 21, 23, 25, 26})
      if (n == 27)
        result.push_back(cell[f]);
    return result;
  }



  void
  write_gmsh_v2(const std::string &name, const Ring &ring, const unsigned int n)
  {
    std::ofstream out(name);
    out.precision(16);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 5 \"INNER\"\n"
        << "$EndPhysicalNames\n$Nodes\n"
        << ring.points.size() << '\n';
    for (unsigned int p = 0; p < ring.points.size(); ++p)
      out << p + 1 << ' ' << ring.points[p] << '\n';
    out << "$EndNodes\n$Elements\n4\n";
    for (unsigned int c = 0; c < 2; ++c)
      {
        out << c + 1 << (n == 20 ? " 17" : " 12") << " 2 1 1";
        for (const unsigned int v : gmsh_order(ring.cells[c], n))
          out << ' ' << v + 1;
        out << '\n' << c + 3 << (n == 20 ? " 16" : " 10") << " 2 5 5";
        for (const unsigned int v : ring.inner_face(c, n == 20 ? 8 : 9))
          out << ' ' << v + 1;
        out << '\n';
      }
    out << "$EndElements\n";
  }



  template <typename Number>
  void
  put(std::string &bytes, const std::vector<Number> &numbers)
  {
    bytes.append(reinterpret_cast<const char *>(numbers.data()), numbers.size() * sizeof(Number));
  }



  /** Binary, version 4.1, with entities: a surface of physical group 5, a volume of group 1. */
  std::string
  gmsh_binary(const Ring &ring, const unsigned int n)
  {
    using Size = std::uint64_t;
    using Int  = std::int32_t;
    std::string out("$MeshFormat\n4.1 1 8\n");
    put<Int>(out, {1});
    out += "\n$EndMeshFormat\n$PhysicalNames\n2\n2 5 \"INNER\"\n3 1 \"ALL\"\n$EndPhysicalNames\n";
    out += "$Entities\n";
    put<Size>(out, {1, 0, 1, 1});
    put<Int>(out, {1}); // a point
    put<double>(out, {0., 0., 0.});
    put<Size>(out, {0});
    for (const Int d : {2, 3})
      {
        put<Int>(out, {7});
        put<double>(out, {0., 0., 0., 2., 2., 1.});
        put<Size>(out, {1});
        put<Int>(out, {d == 2 ? -5 : 1});
        put<Size>(out, {d == 2 ? 0ul : 1ul});
        if (d == 3)
          put<Int>(out, {-7});
      }
    out += "\n$EndEntities\n$Nodes\n";
    put<Size>(out, {1, ring.points.size(), 1, ring.points.size()});
    put<Int>(out, {3, 7, 0});
    put<Size>(out, {ring.points.size()});
    for (Size p = 0; p < ring.points.size(); ++p)
      put<Size>(out, {p + 1});
    for (const Point<3> &x : ring.points)
      put<double>(out, {x[0], x[1], x[2]});
    out += "\n$EndNodes\n$Elements\n";
    put<Size>(out, {2, 4, 1, 4});
    for (const Int d : {2, 3})
      {
        put<Int>(out, {d, 7, n == 20 ? (d == 2 ? 16 : 17) : (d == 2 ? 10 : 12)});
        put<Size>(out, {2});
        for (unsigned int c = 0; c < 2; ++c)
          {
            put<Size>(out, {c + (d == 2 ? 1ul : 3ul)});
            for (const Size v :
                 d == 2 ? ring.inner_face(c, n == 20 ? 8 : 9) : gmsh_order(ring.cells[c], n))
              put<Size>(out, {v + 1});
          }
      }
    return out + "\n$EndElements\n";
  }



  std::string
  base64(const std::string &bytes)
  {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string       result;
    for (std::size_t i = 0; i < bytes.size(); i += 3)
      {
        std::uint32_t group = 0;
        for (std::size_t j = i; j < i + 3; ++j)
          group = group << 8 | (j < bytes.size() ? static_cast<unsigned char>(bytes[j]) : 0u);
        for (unsigned int j = 0; j < 4; ++j)
          result += i + j > bytes.size() ? '=' : digits[group >> (18 - 6 * j) & 63];
      }
    return result;
  }



  /** @param format ascii, binary (base64), or appended: raw or encoded. */
  void
  write_vtu(const std::string &name,
            const Ring        &ring,
            const unsigned int n,
            const std::string &format,
            const std::string &encoding = "raw")
  {
    std::string   appended;
    std::ofstream out(name, std::ios::binary);
    out.precision(16);
    const auto array = [&](const std::string &attributes, const std::string &type, const auto &x) {
      out << "<DataArray type=\"" << type << "\" " << attributes << " format=\"" << format << "\"";
      std::string bytes;
      put(bytes, std::vector<std::uint64_t>{x.size() * sizeof(x[0])});
      put(bytes, x);
      if (format == "appended")
        {
          out << " offset=\"" << appended.size() << "\"/>\n";
          appended += encoding == "raw" ? bytes : base64(bytes);
          return;
        }
      out << ">\n";
      if (format == "ascii")
        for (const auto number : x)
          out << number << ' ';
      else
        out << base64(bytes);
      out << "\n</DataArray>\n";
    };
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
        << "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece "
        << "NumberOfPoints=\"" << ring.points.size() << "\" NumberOfCells=\"2\">\n<Points>\n";
    std::vector<double> x, inner;
    for (const Point<3> &point : ring.points)
      {
        for (unsigned int d = 0; d < 3; ++d)
          x.push_back(point[d]);
        inner.push_back(std::hypot(point[0], point[1]) < 1.25 ? 1. : 0.);
      }
    array("Name=\"Points\" NumberOfComponents=\"3\"", "Float64", x);
    out << "</Points>\n<Cells>\n";
    std::vector<std::int64_t> connectivity, offsets;
    for (const auto &cell : ring.cells)
      {
        connectivity.insert(connectivity.end(), cell.begin(), cell.begin() + n);
        offsets.push_back(connectivity.size());
      }
    array("Name=\"connectivity\"", "Int64", connectivity);
    array("Name=\"offsets\"", "Int64", offsets);
    array("Name=\"types\"", "Int32", std::vector<std::int32_t>(2, n == 20 ? 25 : 29));
    out << "</Cells>\n<PointData>\n";
    array("Name=\"INNER\" NumberOfComponents=\"1\"", "Float64", inner);
    out << "</PointData>\n</Piece>\n</UnstructuredGrid>\n";
    if (format == "appended")
      out << "<AppendedData encoding=\"" << encoding << "\">\n_" << appended
          << "\n</AppendedData>\n";
    out << "</VTKFile>\n";
  }



  BodyMesh
  read(const std::string &text)
  {
    return make_geometry("file", text)->create(1., "Body x/Geometry", ".");
  }



  /** Volume and area of the inner boundary, and that they do not change by refinement. */
  void
  print(const std::string &text)
  {
    const BodyMesh   mesh = read(text);
    Triangulation<3> triangulation;
    create_triangulation(mesh, triangulation);
    std::map<types::boundary_id, double> areas;
    double                               volume, distance, volume_before = 0., area_before = 0.;
    for (unsigned int level = 0; level < 3; ++level)
      {
        measure(mesh, triangulation, areas, volume, distance);
        const double area = areas[mesh.boundary_names.at("INNER")];
        if (level == 0)
          std::cout << text.substr(0, text.find('\n')) << ": " << mesh.manifolds.size()
                    << " manifolds, bulge " << mesh.bulge << ", volume " << volume << ", inner "
                    << area << '\n';
        else
          // Areas are no polynomials: quadrature is more accurate on finer meshes.
          std::cout << "  refined: volume " << small(volume - volume_before) << ", inner "
                    << small(area - area_before, 1e-4) << '\n';
        volume_before = volume;
        area_before   = area;
        triangulation.refine_global(1);
      }
  }



  void
  print_exact()
  {
    // The exact surface has the nodes of the boundary, the file those inside.
    const BodyMesh   mesh = read("set File = ring20.inp\nset Exact surfaces = INNER: cylinder "
                                 "radius 1 inside");
    Triangulation<3> triangulation;
    create_triangulation(mesh, triangulation);
    triangulation.refine_global(2);
    std::map<types::boundary_id, double> areas;
    double                               volume, distance;
    measure(mesh, triangulation, areas, volume, distance);
    std::cout << "with exact surface: off it " << small(distance) << ", volume " << volume << '\n';
  }



  /** One cell from deal.II, compressed and in base64. */
  void
  print_compressed()
  {
    Triangulation<3> triangulation;
    GridGenerator::hyper_rectangle(triangulation, Point<3>(), Point<3>(1., 2., 3.));
    DataOut<3> data_out;
    data_out.attach_triangulation(triangulation);
    dealii::Vector<float> material(1);
    material[0] = 3;
    data_out.add_data_vector(material, "MaterialID");
    data_out.build_patches();
    std::ofstream out("compressed.vtu");
    data_out.write_vtu(out);
    out.close();
    const BodyMesh   mesh = read("set File = compressed.vtu\nset Boundary arrays = MaterialID");
    Triangulation<3> read_back;
    create_triangulation(mesh, read_back);
    std::cout << "compressed: volume " << GridTools::volume(read_back) << ", "
              << mesh.subcells.boundary_quads.size() << " faces of boundary "
              << mesh.boundary_names.begin()->first << '\n';
  }



  /** The file @p name with another text in one place, or cut there. */
  void
  print_damaged(const std::string &name,
                const std::string &old,
                const std::string &changed,
                const std::string &keys = "")
  {
    std::ifstream     in(name, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    std::string       content = text.str();
    const std::size_t at      = content.find(old);
    if (at == std::string::npos)
      std::cout << "there is no '" << old << "' FAILED\n";
    else if (changed == "CUT")
      content.resize(at + old.size());
    else
      content.replace(at, old.size(), changed);
    std::ofstream out("damaged_" + name, std::ios::binary);
    out << content;
    out.close();
    print_error([&] { read("set File = damaged_" + name + "\n" + keys); });
  }



  void
  print_errors()
  {
    // Nodes that fold the cell, and that two cells do not have in common.
    Ring folded;
    folded.points[folded.cells[0][8]] = Point<3>(2.2, 0., 0.);
    write_abaqus("folded20.inp", folded, 20);
    print_error([] { read("set File = folded20.inp"); });
    Ring apart;
    apart.points.emplace_back(0.9, 0.9, 0.);
    apart.cells[1][8] = apart.points.size() - 1;
    write_abaqus("apart20.inp", apart, 20);
    print_error([] { read("set File = apart20.inp"); });
    Ring misplaced;
    std::swap(misplaced.points[misplaced.cells[0][20]], misplaced.points[misplaced.cells[0][26]]);
    misplaced.points[misplaced.cells[0][26]] = misplaced.points[misplaced.cells[0][21]];
    write_vtu("misplaced27.vtu", misplaced, 27, "ascii");
    print_error([] { read("set File = misplaced27.vtu"); });

    print_damaged("ring20.inp", "C3D20R", "C3D27");
    print_damaged("ring27.inp", "C3D27", "C3D10");
    print_damaged("binary20.msh", "4.1 1 8", "2.2 1 8");
    print_damaged("binary20.msh", "4.1 1 8\n\1", "4.1 1 8\n\2");
    print_damaged("binary20.msh", "$Elements\n", "CUT");
    print_damaged("binary20.msh", "$EndNodes", "CUT");
    print_damaged("ring20.vtu", "UnstructuredGrid", "ImageData");
    print_damaged("ring20.vtu", "offsets", "offset");
    print_damaged("ring20.vtu", "25 25", "25.5 25");
    print_damaged("ring20.vtu", "20 40", "20 nan");
    print_damaged("ring20.vtu", "NumberOfComponents=\"3\"", "NumberOfComponents=\"2\"");
    print_damaged("ring20.vtu", "</Cells>", "");
    print_damaged("ring20.vtu", "type=\"Int64\"", "type=\"Int6\"");
    print_damaged("ring20.vtu", "</Piece>", "</Piece><Piece NumberOfPoints=\"0\">");
    print_damaged("base64.vtu", "Name=\"connectivity\"", "CUT");
    print_damaged("appended.vtu", "_", "CUT");
    print_damaged("ring20.vtu", "Name=\"INNER\"", "Name=\"OUTER\"", "set Boundary arrays = INNER");
    print_damaged("compressed.vtu", "vtkZLibDataCompressor", "vtkLZ4DataCompressor");
    print_error([] { make_geometry("file", "set File = a.msh\nset Boundary arrays = inner"); });
    print_error([] { make_geometry("file", "set File = a.unv"); });
  }
} // namespace

int
main()
{
  const Ring ring;
  for (const unsigned int n : {20, 27})
    {
      const std::string nodes = std::to_string(n);
      write_abaqus("ring" + nodes + ".inp", ring, n);
      print("set File = ring" + nodes + ".inp");
      write_gmsh_v2("ring" + nodes + ".msh", ring, n);
      print("set File = ring" + nodes + ".msh");
      std::ofstream("binary" + nodes + ".msh", std::ios::binary) << gmsh_binary(ring, n);
      print("set File = binary" + nodes + ".msh\nset Volume = ALL");
      write_vtu("ring" + nodes + ".vtu", ring, n, "ascii");
      print("set File = ring" + nodes + ".vtu\nset Boundary arrays = INNER");
    }
  write_vtu("base64.vtu", ring, 27, "binary");
  print("set File = base64.vtu\nset Boundary arrays = INNER");
  for (const char *encoding : {"raw", "base64"})
    {
      write_vtu("appended.vtu", ring, 27, "appended", encoding);
      print("set File = appended.vtu\nset Boundary arrays = INNER");
    }
  write_abaqus("straight20.inp", Ring(false), 20);
  print("set File = straight20.inp");
  print_exact();
  print_compressed();
  print_errors();
  return 0;
}
