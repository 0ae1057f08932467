// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/folder.h>
#include <touchstone/contact/geometry/surface.h>
#include <touchstone/contact/pairing/pairing.h>
#include <touchstone/output/preview.h>
#include <touchstone/scene/pair_input.h>
#include <touchstone/solid/solid.h>

#include <algorithm>
#include <map>
#include <sstream>

// Option --preview: what a scene looks like before it is solved, with the names that conditions and
// pairs refer to.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** An unstructured grid of VTK's XML format, in ASCII. */
    std::string
    vtu(const std::vector<Point<3>>                  &points,
        const std::vector<std::vector<unsigned int>> &cells,
        const unsigned int                            type,
        const unsigned int                            number)
    {
      std::ostringstream out;
      out.precision(10);
      const auto array = [&](const std::string &attributes, const auto &write) {
        out << "<DataArray " << attributes << " format=\"ascii\">\n";
        write();
        out << "\n</DataArray>\n";
      };
      out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
             "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
          << points.size() << "\" NumberOfCells=\"" << cells.size() << "\">\n<Points>\n";
      array("type=\"Float64\" NumberOfComponents=\"3\"", [&] {
        for (const Point<3> &x : points)
          out << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
      });
      out << "</Points>\n<Cells>\n";
      array("type=\"Int64\" Name=\"connectivity\"", [&] {
        for (const auto &cell : cells)
          for (const unsigned int v : cell)
            out << v << ' ';
      });
      array("type=\"Int64\" Name=\"offsets\"", [&] {
        std::size_t end = 0;
        for (const auto &cell : cells)
          out << (end += cell.size()) << ' ';
      });
      array("type=\"UInt8\" Name=\"types\"", [&] {
        for (std::size_t c = 0; c < cells.size(); ++c)
          out << type << ' ';
      });
      out << "</Cells>\n<CellData>\n";
      array("type=\"Int32\" Name=\"number\"", [&] {
        for (std::size_t c = 0; c < cells.size(); ++c)
          out << number << ' ';
      });
      out << "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
      return out.str();
    }



    /** Numbers of the points of a part; each once. */
    class PointNumbers
    {
    public:
      explicit PointNumbers(std::vector<Point<3>> &points)
        : points(points)
      {
      }

      unsigned int
      operator()(const Index node, const Point<3> &x)
      {
        const auto [known, is_new] = numbers.insert({node, points.size()});
        if (is_new)
          points.push_back(x);
        return known->second;
      }

    private:
      std::vector<Point<3>>        &points;
      std::map<Index, unsigned int> numbers;
    };



    /** The faces of a surface, those of degree 2 in four parts.
     * @param place Where a node with this reference position is drawn. */
    void
    add_faces(const Surface                                   &surface,
              const std::function<Point<3>(const Point<3> &)> &place,
              PreviewPart                                     &part)
    {
      PointNumbers number(part.points);
      for (const Face &face : surface.owned_faces())
        {
          const unsigned int n = face.degree;
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int i = 0; i < n; ++i)
              {
                const unsigned int          first = i + (n + 1) * j;
                std::array<unsigned int, 4> quad;
                unsigned int                v = 0;
                for (const unsigned int m : {first, first + 1, first + n + 2, first + n + 1})
                  quad[v++] = number(face.nodes[m], place(face.reference[m]));
                part.quads.push_back(quad);
              }
        }
    }



    /** All boundaries of all bodies. */
    std::vector<PreviewPart>
    boundaries_of_bodies(const Scene &scene, const Forest &forest, const Solid &solid)
    {
      std::vector<PreviewPart> parts;
      for (unsigned int body = 0; body < scene.bodies.size(); ++body)
        for (const auto &[ids, name] : forest.names_of_boundaries(body))
          {
            parts.push_back({scene.bodies[body].name, name, {}, {}, {}});
            const Surface surface(solid, forest, body, ids, /*exact=*/false);
            add_faces(
              surface, [](const Point<3> &x) { return x; }, parts.back());
            for (const ContactPairParameters &pair : scene.pairs)
              for (const bool slave : {true, false})
                {
                  const std::string &of = slave ? pair.slave_body : pair.master_body;
                  if (of != scene.bodies[body].name)
                    continue;
                  const BoundaryIds used =
                    forest.boundary_ids(body,
                                        slave ? pair.slave_boundaries : pair.master_boundaries,
                                        pair.section(),
                                        slave ? "Slave boundaries" : "Master boundaries");
                  if (std::includes(used.begin(), used.end(), ids.begin(), ids.end()))
                    parts.back().roles.push_back((slave ? "slave of " : "master of ") + pair.name);
                }
          }
      return parts;
    }



    /** The parts of obstacles that are opposite to slave faces. */
    void
    add_obstacles(const Scene              &scene,
                  const Forest             &forest,
                  const Solid              &solid,
                  std::vector<PreviewPart> &parts)
    {
      for (unsigned int p = 0; p < scene.pairs.size(); ++p)
        {
          const ContactPairInput input = pair_input(scene, forest, solid, p);
          if (input.obstacle == nullptr)
            continue;
          const Surface slave(solid,
                              forest,
                              input.slave_body,
                              forest.boundary_ids(input.slave_body,
                                                  input.parameters.slave_boundaries,
                                                  input.parameters.section(),
                                                  "Slave boundaries"),
                              /*exact=*/false);
          const auto    pairing =
            make_pairing({&input.parameters, input.obstacle, &solid, &slave, nullptr, 0.});
          parts.push_back(
            {"", input.obstacle->name, {"master of " + input.parameters.name}, {}, {}});
          add_faces(
            slave,
            [&](const Point<3> &x) { return Point<3>(x - pairing->at(x, 0.)->gap_vector); },
            parts.back());
        }
    }



    /** The cells of a body, by their vertices. */
    std::string
    cells_of_body(const Solid &solid, const unsigned int body)
    {
      std::vector<Point<3>>                  points;
      std::vector<std::vector<unsigned int>> cells;
      PointNumbers                           number(points);
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->material_id() == body)
          {
            cells.emplace_back();
            for (const unsigned int v : {0, 1, 3, 2, 4, 5, 7, 6})
              cells.back().push_back(number(cell->vertex_index(v), cell->vertex(v)));
          }
      return vtu(points, cells, 12, body);
    }
  } // namespace



  std::string
  PreviewPart::title() const
  {
    return body.empty() ? "obstacle " + name : body + "/" + name;
  }



  std::vector<std::string>
  write_preview(const Scene &scene, const std::string &folder_of_scene, const MPI_Comm communicator)
  {
    const Forest forest(scene.forest_input(), folder_of_scene, MPI_COMM_SELF);
    const Solid  solid(scene.bodies, scene.discretisation.degree, forest, MPI_COMM_SELF);
    std::vector<PreviewPart> parts = boundaries_of_bodies(scene, forest, solid);
    add_obstacles(scene, forest, solid, parts);

    const OutputFolder folder(scene.output.directory, communicator);
    unsigned int       files = 0;
    std::string        blocks;
    const auto         write = [&](const std::string &name, const std::string &text) {
      const std::string file = "preview_" + std::to_string(files) + ".vtu";
      folder.write_file_atomically(file, text);
      std::string quoted = name;
      for (std::size_t at = 0; (at = quoted.find_first_of("\"<&", at)) != std::string::npos;)
        quoted[at] = '_';
      blocks += "<DataSet index=\"" + std::to_string(files++) + "\" name=\"" + quoted +
                "\" file=\"" + file + "\"/>\n";
    };
    for (unsigned int body = 0; body < scene.bodies.size(); ++body)
      write(scene.bodies[body].name + ", cells", cells_of_body(solid, body));
    std::size_t faces = 0;
    for (unsigned int p = 0; p < parts.size(); ++p)
      {
        std::vector<std::vector<unsigned int>> quads;
        for (const auto &quad : parts[p].quads)
          quads.emplace_back(quad.begin(), quad.end());
        faces += quads.size();
        write(parts[p].title(), vtu(parts[p].points, quads, 9, p));
      }
    folder.write_file_atomically("preview.vtm",
                                 "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" "
                                 "version=\"1.0\">\n<vtkMultiBlockDataSet>\n" +
                                   blocks + "</vtkMultiBlockDataSet>\n</VTKFile>\n");
    std::vector<std::string> result = {folder.path("preview.vtm") +
                                       ": bodies, boundaries and obstacles at t = 0"};
    // With so many faces the drawing would show nothing but their edges.
    constexpr std::size_t most = 100000;
    if (faces <= most)
      {
        folder.write_file_atomically("preview.svg",
                                     draw_preview(scene.title.empty() ? "Preview" : scene.title,
                                                  parts));
        result.push_back(folder.path("preview.svg") + ": the same as a drawing");
        if (folder.rank == 0)
          result.push_back(
            draw_image(folder.path("preview.svg"), folder.path("preview.png"))
              ? folder.path("preview.png") + ": the drawing as an image"
              : "no image preview.png: this needs rsvg-convert (apt-get install librsvg2-bin)");
      }
    else
      result.push_back("no drawing of " + std::to_string(faces) + " faces; it has at most " +
                       std::to_string(most));
    return result;
  }
} // namespace Touchstone
