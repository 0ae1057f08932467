// SPDX-License-Identifier: LGPL-2.1-or-later
// Surfaces of facets: signed distances and normals by faces, edges and corners of a cube, gradient
// of the projection, and surfaces that have no inside; the walls of the inside of a cube.

#include <touchstone/mesh/facet_walls.h>

#include "mesh_common.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** The cube from 0 to 1 with two triangles for each side. */
  std::vector<FacetCorners>
  cube()
  {
    const unsigned int sides[6][4] = {
      {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    const auto corner = [](const unsigned int v) {
      return Point<3>(v & 1U, v >> 1U & 1U, v >> 2U & 1U);
    };
    std::vector<FacetCorners> facets;
    for (const auto &s : sides)
      {
        facets.push_back({{corner(s[0]), corner(s[1]), corner(s[2])}});
        facets.push_back({{corner(s[0]), corner(s[2]), corner(s[3])}});
      }
    return facets;
  }

  /** Signed distance from the cube, exact. */
  double
  exact(const Point<3> &x)
  {
    double       inside = -1.;
    Tensor<1, 3> beyond;
    for (unsigned int d = 0; d < 3; ++d)
      {
        const double far = std::abs(x[d] - 0.5) - 0.5;
        inside           = std::max(inside, far);
        beyond[d]        = std::max(far, 0.);
      }
    return inside > 0. ? beyond.norm() : inside;
  }

  void
  refuse(const std::string &what, const std::vector<FacetCorners> &facets)
  {
    try
      {
        std::make_shared<FacetSurface>(facets, true);
        std::cout << what << ": accepted FAILED\n";
      }
    catch (const std::runtime_error &error)
      {
        std::cout << what << ": " << error.what() << '\n';
      }
  }

  /** The walls of the inside of the cube: each has the smaller one of the distances from two
   * opposite planes, which go on beyond the edges; and none can be touched from where another one
   * is closest and no corner is near. */
  void
  walls_of_hole(const std::shared_ptr<const FacetSurface> &hole)
  {
    const auto walls     = make_walls(hole);
    double     distances = 0., gradients = 0.;
    int        touched = 0;
    for (unsigned int i = 0; i < 1000; ++i)
      {
        const Point<3>        x(-0.1 + 0.1403 * (i % 10),
                         -0.09 + 0.1305 * (i / 10 % 10),
                         -0.08 + 0.1207 * (i / 100));
        std::array<double, 3> found, wanted;
        for (unsigned int d = 0; d < 3; ++d)
          {
            wanted[d] = std::min(x[d], 1. - x[d]);
            found[d]  = 1e9;
          }
        for (const auto &wall : walls)
          {
            touched += wall->can_be_touched(x);
            const Tensor<1, 3> n = wall->normal(x);
            for (unsigned int d = 0; d < 3; ++d)
              if (std::abs(n[d]) > 0.999)
                {
                  found[d]  = (x - wall->project(x)) * n;
                  gradients = std::max(gradients, std::abs(wall->projection_gradient(x)[d][d]));
                }
          }
        for (unsigned int d = 0; d < 3; ++d)
          distances = std::max(distances, std::abs(found[d] - wanted[d]));
      }
    std::cout << walls.size() << " walls, " << touched << " of 3000 touched, signed distance "
              << small(distances) << ", gradient " << small(gradients) << '\n';
  }
} // namespace

int
main()
{
  const auto surface = std::make_shared<FacetSurface>(cube(), true),
             hole    = std::make_shared<FacetSurface>(cube(), false);
  double distances = 0., normals = 0., gradients = 0., sides = 0.;
  for (unsigned int i = 0; i < 1000; ++i)
    {
      // No point is at the same distance from two places, or on a diagonal of a side.
      const Point<3>     x(-0.6 + 0.2203 * (i % 10),
                       -0.59 + 0.2205 * (i / 10 % 10),
                       -0.58 + 0.2207 * (i / 100));
      const Point<3>     p        = surface->project(x);
      const Tensor<1, 3> n        = surface->normal(x);
      distances                   = std::max(distances, std::abs((x - p) * n - exact(x)));
      normals                     = std::max(normals, std::abs(n.norm() - 1.));
      sides                       = std::max(sides, (n + hole->normal(x)).norm());
      const Tensor<2, 3> gradient = surface->projection_gradient(x);
      for (unsigned int d = 0; d < 3; ++d)
        {
          Tensor<1, 3> step;
          step[d] = 1e-6;
          const Tensor<1, 3> change =
            (surface->project(x + step) - surface->project(x - step)) / 2e-6;
          for (unsigned int c = 0; c < 3; ++c)
            gradients = std::max(gradients, std::abs(change[c] - gradient[c][d]));
        }
    }
  std::cout << "signed distance " << small(distances) << ", normals " << small(normals)
            << ", other side " << small(sides) << ", gradient " << small(gradients, 1e-8) << '\n';
  for (const Point<3> &x : {Point<3>(0.3, 0.2, 1.), Point<3>(0.3, 0., 1.), Point<3>(1., 1., 1.)})
    std::cout << "on the surface at " << x << ": normal " << surface->normal(x) << '\n';

  walls_of_hole(hole);
  std::cout << "walls outside: " << make_walls(surface).size() << '\n';

  auto facets = cube();
  facets.pop_back();
  refuse("a facet is missing", facets);
  facets = cube();
  std::swap(facets[3][0], facets[3][1]);
  refuse("a facet looks inwards", facets);
  facets = cube();
  for (auto &facet : facets)
    std::swap(facet[0], facet[1]);
  refuse("all look inwards", facets);
  facets = cube();
  facets.push_back({{Point<3>(0, 0, 0), Point<3>(1, 0, 0), Point<3>(2, 0, 0)}});
  refuse("a facet without area", facets);
  facets = cube();
  facets.push_back(facets[0]);
  refuse("a facet twice", facets);
  refuse("none", {});
  facets = cube();
  facets.push_back({{Point<3>(0, 0, 0), Point<3>(1, 0, 0), Point<3>(1, 0, 0)}});
  std::cout << "a facet with two corners in one place: distance "
            << std::make_shared<FacetSurface>(facets, true)->project(Point<3>(0.5, 0.4, 3.))
            << '\n';
  return 0;
}
