// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies that are scaled, mirrored, turned, moved and repeated: volumes, areas, centres,
// refinement, exact surfaces and their normals, and what is refused.

#include <touchstone/mesh/placed_geometry.h>

#include "mesh_common.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** A geometry with its own parameters and those of the placement. */
  std::shared_ptr<Geometry>
  make(const std::string &type, const std::string &text)
  {
    const auto       inner  = GeometryRegistry::make(type);
    const auto       placed = std::make_shared<PlacedGeometry>(inner);
    ParameterHandler prm;
    inner->declare(prm);
    placed->declare(prm);
    prm.parse_input_from_string(text);
    inner->check("Body x/Geometry");
    placed->check("Body x/Geometry");
    return placed;
  }

  /** Areas of the named boundaries, with those that share their faces. */
  double
  area(const BodyMesh                             &mesh,
       const std::map<types::boundary_id, double> &areas,
       const types::boundary_id                    named)
  {
    double sum = 0.;
    for (const auto &[id, area] : areas)
      {
        const auto shared = mesh.shared.find(id);
        if (shared == mesh.shared.end() ? id == named : shared->second.count(named) > 0)
          sum += area;
      }
    return sum;
  }

  void
  print(const std::string &title, const std::string &type, const std::string &text)
  {
    std::cout << title << '\n';
    const BodyMesh    mesh  = make(type, text)->create(1., "Body x/Geometry", "");
    const Orientation count = orientation(mesh);
    Triangulation<3>  triangulation;
    create_triangulation(mesh, triangulation);
    triangulation.refine_global(1);
    std::map<types::boundary_id, double> areas;
    double                               volume, distance;
    measure(mesh, triangulation, areas, volume, distance);
    Point<3> low = mesh.vertices[0], high = low;
    for (const Point<3> &x : mesh.vertices)
      for (unsigned int d = 0; d < 3; ++d)
        {
          low[d]  = std::min(low[d], x[d]);
          high[d] = std::max(high[d], x[d]);
        }
    for (unsigned int d = 0; d < 3; ++d)
      for (Point<3> *x : {&low, &high})
        if (std::abs((*x)[d]) < 1e-12)
          (*x)[d] = 0.;
    std::cout << "  " << mesh.cells.size() << " cells, not positive "
              << count.negative + count.distorted << ", volume " << volume << ", from " << low
              << " to " << high << '\n';
    for (const auto &[name, id] : mesh.boundary_names)
      std::cout << "  " << name << ": " << area(mesh, areas, id) << '\n';
    std::cout << "  off the exact surface " << small(distance) << '\n';

    // Normals of exact surfaces point out of the cells beside them, and the gradient is that of
    // the projection.
    const MappingQ<3> mapping(2);
    const FE_Q<3>     fe(1);
    FEFaceValues<3>   faces(mapping,
                          fe,
                          QMidpoint<2>(),
                          update_quadrature_points | update_normal_vectors);
    double            normals = 1., gradients = 0.;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && mesh.surfaces.count(cell->face(f)->boundary_id()) > 0)
          {
            const AnalyticSurface &surface = *mesh.surfaces.at(cell->face(f)->boundary_id());
            faces.reinit(cell, f);
            const Point<3>     x = faces.quadrature_point(0) + 0.1 * faces.normal_vector(0);
            const Tensor<1, 3> step({1e-5, -2e-5, 3e-5});
            std::array<Tensor<1, 3>, 2> directions = {{step, -1. * step}};
            normals   = std::min(normals, surface.normal(x) * faces.normal_vector(0));
            gradients = std::max(gradients,
                                 (surface.project(x + step) - surface.project(x - step) -
                                  2. * surface.projection_gradient(x) * step)
                                   .norm());
            gradients =
              std::max(gradients, surface.project_with(x, directions).distance(surface.project(x)));
            gradients =
              std::max(gradients, (directions[0] - surface.projection_gradient(x) * step).norm());
          }
    std::cout << "  normals point outwards: " << (normals > 0.9 ? "yes" : "no FAILED")
              << ", gradient " << small(gradients, 1e-9) << '\n';
  }
} // namespace

int
main()
{
  print("box at its place: 6", "box", "set Upper corner = 1, 2, 3\nset Cells = 2, 2, 2");
  print("box, turned about z by a quarter about its corner",
        "box",
        "set Upper corner = 1, 2, 3\nset Rotate angle = 90\nset Rotate point = 1, 2, 0");
  print("box, about an oblique axis by a third: x is y, y is z",
        "box",
        "set Upper corner = 1, 2, 3\nset Rotate axis = 2, 2, 2\nset Rotate angle = 120");
  print("box, stretched, mirrored, turned and moved: 48",
        "box",
        "set Lower corner = 1, 0, 0\nset Upper corner = 2, 2, 3\nset Scale = 2, 4, 1\n"
        "set Mirror = x\nset Rotate axis = 1, 0, 0\nset Rotate angle = -90\nset Move = 1, 1, 1");
  print("tube sector, mirrored at an oblique plane, and larger: 3.375 times 0.245437",
        "tube",
        "set Inner radius = 1\nset Outer radius = 1.5\nset End = 0.25\nset Scale = 1.5\n"
        "set Mirror = 1, 1, 0.5\nset Cells = 2, 6, 1");
  print("cone, turned: 0.245437 and more",
        "tube",
        "set Inner radius = 1\nset Inner slope = 0.2\nset Outer radius = 1.5\nset End = 0.25\n"
        "set Rotate axis = 1, -2, 0.3\nset Rotate angle = 33\nset Move = 0, 0, 7");
  print("six balls: 25.13274, surface 75.39822",
        "ball",
        "set Centre = 1, 2, 3\nset Array = 3, 1, 2\nset Array spacing = 2.5, 0, -2.5");
  print("cap, mirrored: 132.961",
        "cap",
        "set Width = 3\nset Height = 4\nset Contact width = 0.5\nset Contact cells = 3\n"
        "set Outer cells = 4\nset Contact layers = 2\nset Outer layers = 3\nset Radius = 10\n"
        "set Part = whole\nset Mirror = z");

  for (const std::string text : {"set Scale = 0",
                                 "set Scale = 1, 2",
                                 "set Mirror = w",
                                 "set Mirror = 0, 0, 0",
                                 "set Rotate axis = 0, 0, 0",
                                 "set Rotate axis = 1, 0, 0",
                                 "set Rotate point = 0, 0, 1",
                                 "set Array = 2, 1, 1",
                                 "set Array spacing = 1, 0, 0"})
    print_error([&] { make("box", text); });
  print_error([] { make("ball", "set Scale = 1, 1, 2")->create(1., "Body x/Geometry", ""); });
  print_error([] {
    make("box", "set Array = 1, 3, 1\nset Array spacing = 0, 1, 0")
      ->create(1., "Body x/Geometry", "");
  });
  return 0;
}
