// SPDX-License-Identifier: LGPL-2.1-or-later
// Faces of contact surfaces: shape functions, tangents against central
// differences, and the closest-point projection against a brute-force search.

#include <touchstone/contact/geometry/face_geometry.h>

#include "mesh_common.h"
#include <functional>

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** A face with nodes and displacements given by functions of xi. */
  Face
  make_face(
    const unsigned int                                   degree,
    const std::function<Point<dim>(double, double)>     &position,
    const std::function<Tensor<1, dim>(double, double)> &displacement = [](double, double) {
      return Tensor<1, dim>();
    })
  {
    Face face;
    face.degree = degree;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        const std::array<double, 2> xi = node_coordinates(face, m);
        face.nodes[m]                  = m;
        face.reference[m]              = position(xi[0], xi[1]);
        face.displacement[m]           = displacement(xi[0], xi[1]);
      }
    return face;
  }



  void
  check_evaluation(const Face &face, const AnalyticSurface *exact)
  {
    double sums = 0., nodes = 0., tangents = 0.;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        const FaceShapes shapes(face.degree, node_coordinates(face, m));
        for (unsigned int n = 0; n < face.n_nodes(); ++n)
          nodes = std::max(nodes, std::abs(shapes.value[n] - (m == n ? 1. : 0.)));
      }
    const double h = 1e-5;
    for (const double x : {-0.9, -0.35, 0.1, 0.8})
      for (const double y : {-0.7, 0.2, 0.95})
        {
          const FaceShapes shapes(face.degree, {{x, y}});
          double           sum = -1., sum_gradient[2] = {};
          for (unsigned int m = 0; m < face.n_nodes(); ++m)
            {
              sum += shapes.value[m];
              for (unsigned int a = 0; a < 2; ++a)
                sum_gradient[a] += shapes.gradient[m][a];
            }
          sums =
            std::max({sums, std::abs(sum), std::abs(sum_gradient[0]), std::abs(sum_gradient[1])});
          const FacePoint point = evaluate(face, exact, {{x, y}});
          for (unsigned int a = 0; a < 2; ++a)
            {
              std::array<double, 2> plus{{x, y}}, minus{{x, y}};
              plus[a] += h;
              minus[a] -= h;
              const Tensor<1, dim> difference =
                (evaluate(face, exact, plus).x - evaluate(face, exact, minus).x) / (2. * h);
              tangents =
                std::max(tangents,
                         (difference - point.tangents[a]).norm() / point.tangents[a].norm());
            }
          if (std::abs(point.normal().norm() - 1.) > 1e-14 ||
              std::abs(point.normal() * point.tangents[0]) > 1e-12 * point.tangents[0].norm() ||
              std::abs(point.normal() * point.tangents[1]) > 1e-12 * point.tangents[1].norm())
            std::cout << "  normal FAILED\n";
        }
    std::cout << "  shapes at nodes " << small(nodes) << ", sums " << small(sums) << ", tangents "
              << small(tangents, 1e-8) << '\n';
  }



  /** Distance by a grid over the face that closes in on its best point. */
  double
  brute_force(const Point<dim> &x, const Face &face, const AnalyticSurface *exact)
  {
    const int n        = 40;
    double    centre[] = {0., 0.}, half = 1., best = 1e300;
    for (unsigned int round = 0; round < 14; ++round)
      {
        double found[] = {centre[0], centre[1]};
        for (int i = 0; i <= n; ++i)
          for (int j = 0; j <= n; ++j)
            {
              const std::array<double, 2> xi{
                {std::clamp(centre[0] + half * (2. * i / n - 1.), -1., 1.),
                 std::clamp(centre[1] + half * (2. * j / n - 1.), -1., 1.)}};
              const double distance = x.distance(evaluate(face, exact, xi).x);
              if (distance < best)
                {
                  best     = distance;
                  found[0] = xi[0];
                  found[1] = xi[1];
                }
            }
        centre[0] = found[0];
        centre[1] = found[1];
        half *= 0.2;
      }
    return best;
  }



  void
  check_projection(const Face &face, const AnalyticSurface *exact)
  {
    double       worse = 0., inconsistent = 0., outside = 0.;
    unsigned int count = 0;
    double       size  = 1e300;
    for (unsigned int a = 0; a < 2; ++a)
      size = std::min(size, 2. * evaluate(face, exact, {{0., 0.}}).tangents[a].norm());
    // Above, below, and beyond the edges of the face. Farther from an exact surface than its radius
    // steps without its curvature diverge.
    const std::vector<double> heights =
      exact ? std::vector<double>{-0.4, -0.01, 0., 0.05, 0.5, 2.3, 3.5}
            : std::vector<double>{-0.4, -0.01, 0., 0.05, 0.5};
    for (const double a : {-1.3, -0.9, -0.4, 0., 0.55, 1., 1.2})
      for (const double b : {-1.25, -1., -0.3, 0.15, 0.7, 1.4})
        for (const double height : heights)
          {
            const FacePoint  point = evaluate(face, nullptr, {{a, b}});
            const Point<dim> x     = point.x + height * size * point.normal();
            const Projection projection =
              closest_point_projection(x, FaceGeometry(face, exact, MasterNormal::averaged));
            const double distance = std::sqrt(projection.distance_squared);
            worse = std::max(worse, (distance - brute_force(x, face, exact)) / size);
            inconsistent =
              std::max(inconsistent,
                       std::abs(distance - x.distance(evaluate(face, exact, projection.xi).x)) /
                         size);
            for (const double xi : projection.xi)
              outside = std::max(outside, std::abs(xi) - 1.);
            ++count;
          }
    std::cout << "  " << count << " points, farther than the closest point "
              << small(std::max(worse, 0.), 1e-9) << ", distance " << small(inconsistent)
              << ", outside " << small(std::max(outside, 0.)) << '\n';
  }



  void
  check(const std::string &name, const Face &face, const AnalyticSurface *exact = nullptr)
  {
    std::cout << name << '\n';
    check_evaluation(face, exact);
    check_projection(face, exact);
  }
} // namespace

int
main()
{
  check("square", make_face(1, [](double a, double b) { return Point<dim>(a, b, 0.); }));
  check("parallelogram in space", make_face(1, [](double a, double b) {
          return Point<dim>(a + 0.4 * b, b - 0.3 * a, 0.5 * a + 0.2 * b);
        }));
  check("trapezium", make_face(1, [](double a, double b) {
          return Point<dim>(a * (1. - 0.4 * b), b + 0.2 * a * b, 0.);
        }));
  check("warped", make_face(1, [](double a, double b) {
          return Point<dim>(a, b + 0.1 * a * b, 0.3 * a * b);
        }));
  check("warped by displacement",
        make_face(
          1,
          [](double a, double b) { return Point<dim>(a, b, 0.); },
          [](double a, double b) {
            return Tensor<1, dim>({0.1 * a * b, 0.02 * b, -0.25 * a * b});
          }));
  check("aspect ratio 100", make_face(1, [](double a, double b) {
          return Point<dim>(100. * a, b + 0.05 * a * b, 0.02 * a * b);
        }));
  check("aspect ratio 1/100",
        make_face(1, [](double a, double b) { return Point<dim>(0.01 * a, b, 0.); }));
  check("biquadratic, plane",
        make_face(2, [](double a, double b) { return Point<dim>(a, b, 0.); }));
  check("biquadratic, curved", make_face(2, [](double a, double b) {
          return Point<dim>(a + 0.05 * b * b, b, 0.15 * a * a - 0.1 * b * b + 0.05 * a * b);
        }));

  const auto cylinder = make_cone({0., 0., 0.}, Tensor<1, dim>({0., 0., 1.}), 2., 0., true);
  const auto cone     = make_cone({0., 0., 0.}, Tensor<1, dim>({0., 0., 1.}), 2., 0.1, true);
  const auto sphere   = make_sphere({0., 0., 0.}, 2., true);
  const auto on       = [](const AnalyticSurface &surface) {
    return [&surface](double a, double b) {
      return surface.project(Point<dim>(2. * std::cos(0.25 * a), 2. * std::sin(0.25 * a), 0.4 * b));
    };
  };
  const auto bend = [](double a, double b) {
    return Tensor<1, dim>({0.02 * a, 0.03 * b, 0.01 * a * b});
  };
  for (const unsigned int degree : {1, 2})
    {
      const std::string kind = (degree == 1 ? ", bilinear" : ", biquadratic");
      check("exact cylinder" + kind, make_face(degree, on(*cylinder), bend), cylinder.get());
      check("exact cone" + kind, make_face(degree, on(*cone), bend), cone.get());
      check("exact sphere" + kind, make_face(degree, on(*sphere), bend), sphere.get());
    }

  // How far beyond the edge: in fractions of the face, outer and inner edges apart.
  Face square        = make_face(1, [](double a, double b) { return Point<dim>(a, b, 0.); });
  square.outer_edges = 1u << 1; // xi_1 = 1
  for (const Point<dim> &x : {Point<dim>(1.2, 0., 0.1),
                              Point<dim>(-1.4, 0., 0.1),
                              Point<dim>(1.1, -1.3, 0.),
                              Point<dim>(0.5, 0.5, 0.3)})
    {
      const Projection projection =
        closest_point_projection(x, FaceGeometry(square, nullptr, MasterNormal::averaged));
      std::cout << x << ": xi " << projection.xi[0] << ' ' << projection.xi[1] << ", beyond outer "
                << projection.beyond_outer << ", inner " << projection.beyond_inner << '\n';
    }
  return 0;
}
