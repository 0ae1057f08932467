// SPDX-License-Identifier: LGPL-2.1-or-later
// Analytic surfaces: closest point, its derivative against central differences,
// normals, and what happens on the axis and in the centre.

#include <touchstone/mesh/obstacle_shape.h>

#include "mesh_common.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  void
  print(const std::string           &title,
        const AnalyticSurface       &surface,
        const std::vector<Point<3>> &points)
  {
    std::cout << title << '\n';
    for (const Point<3> &x : points)
      {
        const Point<3>     p        = surface.project(x);
        const Tensor<1, 3> n        = surface.normal(x);
        const Tensor<2, 3> gradient = surface.projection_gradient(x);

        const double h = 1e-5;
        Tensor<2, 3> difference;
        for (unsigned int d = 0; d < 3; ++d)
          {
            Tensor<1, 3> step;
            step[d]               = h;
            const Tensor<1, 3> dp = surface.project(x + step) - surface.project(x - step);
            for (unsigned int c = 0; c < 3; ++c)
              difference[c][d] = dp[c] / (2. * h);
          }
        const Tensor<1, 3> d = x - p;
        std::cout << "  " << x << " -> " << p << ", normal " << n << '\n'
                  << "    normal length " << small(n.norm() - 1.) << ", foot "
                  << small((d - (d * n) * n).norm()) << ", stays "
                  << small(surface.project(p).distance(p)) << ", gradient "
                  << small((gradient - difference).norm(), 1e-7) << ", symmetric "
                  << small((gradient - transpose(gradient)).norm()) << '\n';
      }
  }

  /** The surface of an obstacle with these keys. */
  std::shared_ptr<const AnalyticSurface>
  obstacle(const std::string &shape, const std::string &text)
  {
    const auto       result = ObstacleShapeRegistry::make(shape);
    ParameterHandler prm;
    result->declare(prm);
    prm.parse_input_from_string(text);
    result->check("Obstacle x");
    return result->surface();
  }



  /** Tools with other radii of curvature than bodies have, outside, inside and at their tips. */
  void
  print_tools(const std::vector<Point<3>> &points)
  {
    const std::string cone = "set Tip = 0.1, 0, 0\nset Direction = 1, 1, 0\nset Half angle = ";
    print("sharp cone", *obstacle("cone", cone + "70"), points);
    print("blunt cone", *obstacle("cone", cone + "20\nset Tip radius = 0.5"), points);
    print("hollow cone", *obstacle("cone", cone + "40\nset Side = inside"), points);
    const std::string torus = "set Centre = 0.1, 0, 0\nset Direction = 1, 0, 1\nset Radius = 2\n"
                              "set Tube radius = ";
    print("torus", *obstacle("torus", torus + "0.5"), points);
    print("within a torus", *obstacle("torus", torus + "1.5\nset Side = inside"), points);

    for (const char *radius : {"0", "0.25"})
      {
        const auto tip = obstacle("cone", std::string("set Tip radius = ") + radius);
        for (const double z : {-1., 0., 0.125})
          std::cout << "tip of radius " << radius << ", axis at " << z << " -> "
                    << tip->project({0., 0., z}) << ", normal " << tip->normal({0., 0., z}) << '\n';
      }
    for (const char *keys :
         {"set Half angle = 90", "set Direction = 0, 0, 0", "set Tip radius = -1"})
      print_error([keys] { obstacle("cone", keys); });
    for (const char *keys : {"set Radius = 0.25", "set Tube radius = 0", "set Direction = 0, 0, 0"})
      print_error([keys] { obstacle("torus", keys); });
  }
} // namespace

int
main()
{
  const std::vector<Point<3>> points = {{1., 2., 3.},
                                        {-0.5, 0.25, 0.125},
                                        {0.5, 3., -2.},
                                        {2., -1., 0.3}};

  print("plane", *make_plane({0., 0., 1.}, Tensor<1, 3>({1., 2., 2.})), points);
  print("sphere", *make_sphere({0.5, 0., 0.}, 2., true), points);
  print("hollow sphere", *make_sphere({0.5, 0., 0.}, 2., false), points);
  print("cylinder", *make_cone({0.1, 0., 0.}, Tensor<1, 3>({0., 0., 2.}), 1.5, 0., true), points);
  print("bore", *make_cone({0.1, 0., 0.}, Tensor<1, 3>({0., 0., 1.}), 1.5, 0., false), points);
  print("cone", *make_cone({0.1, 0., 0.}, Tensor<1, 3>({1., 1., 0.}), 2., 0.2, true), points);
  print("conical bore",
        *make_cone({0., 0., 0.}, Tensor<1, 3>({1., 0., 0.}), 8., 0.01, false),
        points);

  const auto sphere = make_sphere({1., 2., 3.}, 2., true);
  const auto cone   = make_cone({0., 0., 0.}, Tensor<1, 3>({1., 0., 0.}), 2., 0., true);
  std::cout << "centre of the sphere -> " << sphere->project({1., 2., 3.}) << '\n'
            << "axis of the cylinder -> " << cone->project({3., 0., 0.}) << ", normal "
            << cone->normal({3., 0., 0.}) << '\n';
  print_tools(points);
  return 0;
}
