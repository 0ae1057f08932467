// SPDX-License-Identifier: LGPL-2.1-or-later
// Exact surfaces whose faces turn by different angles are continuous over the edges between them
// (equation (8) of doc/theory.md 4), keep their shape when all turns as a whole, and have the
// derivatives that they say, by face coordinates, positions and nodal normals.

#include <touchstone/contact/geometry/face_derivative.h>

#include "mesh_common.h"
#include <functional>

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** A face of 36 degrees on a cylinder or sphere of radius 2 about the origin, above or below the
   * equator, moved by some strain and rotation. */
  Face
  make_face(const unsigned int degree, const AnalyticSurface &surface, const double middle)
  {
    Face             face;
    constexpr double half = 0.314159265358979;
    face.degree           = degree;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        const auto   xi = node_coordinates(face, m);
        const double a = half * xi[0], b = middle + half * xi[1];
        face.nodes[m]       = m;
        face.reference[m]   = surface.project(Point<dim>(2. * std::cos(b) * std::cos(a),
                                                       2. * std::cos(b) * std::sin(a),
                                                       2. * std::sin(b)));
        const Point<dim> &x = face.reference[m];
        face.displacement[m] =
          Tensor<1, dim>({0.2 * x[2] * x[2] + 0.05 * x[1], 0.1 * x[0], -0.1 * x[1]});
      }
    return face;
  }



  /** A new largest deviation; one that is no number counts. */
  void
  add(double &worst, const double deviation)
  {
    if (!(deviation <= worst))
      worst = deviation;
  }



  /** Normals of the face alone at its nodes. */
  std::array<Tensor<1, dim>, Face::max_nodes>
  normals_of(const Face &face, const AnalyticSurface &exact)
  {
    std::array<Tensor<1, dim>, Face::max_nodes> result;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      result[m] = evaluate(face, &exact, node_coordinates(face, m)).normal();
    return result;
  }



  /** Set the normals of both faces to the means on their common edge, of nodes that coincide. */
  void
  average(Face &one, Face &other, const AnalyticSurface &exact)
  {
    for (Face *const face : {&one, &other})
      {
        Face before         = *face;
        before.displacement = {};
        face->made_normals  = normals_of(before, exact);
        face->own_normals = face->normals = normals_of(*face, exact);
      }
    for (unsigned int m = 0; m < one.n_nodes(); ++m)
      for (unsigned int l = 0; l < other.n_nodes(); ++l)
        if (one.reference[m].distance(other.reference[l]) < 1e-12)
          {
            const Tensor<1, dim> sum = one.normals[m] + other.normals[l];
            one.normals[m] = other.normals[l] = sum / sum.norm();
          }
  }



  FaceGeometry
  geometry(const Face &face, const AnalyticSurface &exact, const Arch arch = Arch::with_normals)
  {
    return {face, &exact, MasterNormal::averaged, arch};
  }



  /** Distance of the two surfaces along their common edge, the side 3 of one and 2 of the other. */
  double
  jump(const Face &one, const Face &other, const AnalyticSurface &exact, const Arch arch)
  {
    double result = 0.;
    for (const double x : {-0.9, -0.4, 0.1, 0.7})
      add(result,
          geometry(one, exact, arch)
            .evaluate({{x, 1.}})
            .x.distance(geometry(other, exact, arch).evaluate({{x, -1.}}).x));
    return result;
  }



  /** The largest deviation of derivatives of a vector from central differences.
   * @param move Moves what it depends on by a number along a component.
   * @param value The vector. @param expected Its derivative by the component d. */
  double
  deviation(const std::function<void(unsigned int, double)>           &move,
            const std::function<Tensor<1, dim>()>                     &value,
            const std::function<Tensor<1, dim>(const unsigned int d)> &expected,
            const unsigned int                                         n = dim)
  {
    constexpr double h      = 1e-5;
    double           result = 0.;
    for (unsigned int d = 0; d < n; ++d)
      {
        move(d, h);
        const Tensor<1, dim> plus = value();
        move(d, -2. * h);
        const Tensor<1, dim> difference = (plus - value()) / (2. * h);
        move(d, h);
        add(result, (difference - expected(d)).norm());
      }
    return result;
  }



  Tensor<1, dim>
  column(const Tensor<2, dim> &matrix, const unsigned int d)
  {
    return Tensor<1, dim>({matrix[0][d], matrix[1][d], matrix[2][d]});
  }



  void
  check_derivatives(Face face, const AnalyticSurface &exact)
  {
    double position = 0., tangents = 0., normal = 0., second = 0.;
    for (std::array<double, 2> xi :
         {std::array<double, 2>{{0.3, -0.6}}, {{-0.8, 0.95}}, {{1., 0.2}}})
      {
        const FaceGeometry   of       = geometry(face, exact);
        const FaceDerivative expected = FaceDifferentiator(of).at(xi);
        const auto x = [&]() { return Tensor<1, dim>(geometry(face, exact).evaluate(xi).x); };
        const auto n = [&]() { return geometry(face, exact).normal(xi); };
        const auto t = [&](const unsigned int a) {
          return
            [&face, &exact, &xi, a]() { return geometry(face, exact).evaluate(xi).tangents[a]; };
        };
        const auto along = [&](const unsigned int a, const double h) { xi[a] += h; };
        const auto by_xi = [&](const auto &value, const auto &derivative, double &worst) {
          add(worst, deviation(along, value, derivative, 2));
        };
        by_xi(
          x, [&](const unsigned int a) { return expected.point.tangents[a]; }, position);
        by_xi(
          n, [&](const unsigned int a) { return expected.normal_xi[a]; }, normal);
        const auto twice = of.second_derivatives(xi);
        for (unsigned int b = 0; b < 2; ++b)
          by_xi(
            t(b), [&](const unsigned int a) { return twice[a + b]; }, second);
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          {
            const auto node = [&](const unsigned int d, const double h) {
              face.displacement[m][d] += h;
            };
            const auto turned = [&](const unsigned int d, const double h) {
              face.normals[m][d] += h;
            };
            const auto check = [&](const auto           &value,
                                   const Tensor<2, dim> &by_position,
                                   const Tensor<2, dim> &by_normal,
                                   double               &worst) {
              add(worst, deviation(node, value, [&](const unsigned int d) {
                    return column(by_position, d);
                  }));
              add(worst, deviation(turned, value, [&](const unsigned int d) {
                    return column(by_normal, d);
                  }));
            };
            check(x, expected.x_position[m], expected.x_normal[m], position);
            check(n, expected.normal_position[m], expected.normal_normal[m], normal);
            for (unsigned int a = 0; a < 2; ++a)
              check(t(a), expected.tangent_position[a][m], expected.tangent_normal[a][m], tangents);
            const FacePosition alone = FaceDifferentiator(of).position(xi);
            add(position, (alone.x_position[m] - expected.x_position[m]).norm());
            add(position, (alone.x_normal[m] - expected.x_normal[m]).norm());
          }
      }
    std::cout << "  differences: position " << small(position, 1e-8) << ", tangents "
              << small(tangents, 1e-8) << ", normal " << small(normal, 1e-8) << ", second "
              << small(second, 1e-6) << '\n';
  }



  void
  check(const std::string &name, const unsigned int degree, const AnalyticSurface &exact)
  {
    Face one   = make_face(degree, exact, -0.314159265358979),
         other = make_face(degree, exact, 0.314159265358979);
    average(one, other, exact);
    std::cout << name << "\n  over the edge "
              << small(jump(one, other, exact, Arch::with_normals), 1e-14)
              << ", turned with the facets " << jump(one, other, exact, Arch::with_facet) << '\n';
    check_derivatives(one, exact);
    // A hanging node lies on the straight edge of a larger face.
    Face hanging         = one;
    hanging.reference[1] = 0.5 * (one.reference[1] + one.reference[degree == 1 ? 3 : 8]);
    check_derivatives(hanging, exact);

    // Turned as a whole, and not at all.
    const Tensor<1, dim> axis  = Tensor<1, dim>({1., 2., -1.}) / std::sqrt(6.);
    const double         angle = 1.1;
    const auto           turn  = [&](const Tensor<1, dim> &v) {
      return std::cos(angle) * v + std::sin(angle) * cross_product_3d(axis, v) +
             (1. - std::cos(angle)) * (axis * v) * axis;
    };
    Face rigid = one;
    for (unsigned int m = 0; m < one.n_nodes(); ++m)
      {
        rigid.displacement[m] = turn(one.reference[m]) - one.reference[m];
        rigid.normals[m]      = turn(one.made_normals[m]);
      }
    double strays = 0.;
    for (const double x : {-0.9, 0.1, 0.7})
      for (const double y : {-0.5, 0.9})
        {
          Face at_rest         = one;
          at_rest.displacement = {};
          at_rest.normals      = one.made_normals;
          strays               = std::max(strays,
                            geometry(rigid, exact)
                              .evaluate({{x, y}})
                              .x.distance(
                                Point<dim>(turn(geometry(at_rest, exact).evaluate({{x, y}}).x))));
        }
    std::cout << "  strays from a rigid rotation " << small(strays, 1e-14) << '\n';
  }
} // namespace

int
main()
{
  const auto cylinder = make_cone({0., 0., 0.}, Tensor<1, dim>({0., 0., 1.}), 2., 0., true);
  const auto sphere   = make_sphere({0., 0., 0.}, 2., true);
  for (const unsigned int degree : {1, 2})
    {
      const std::string kind = (degree == 1 ? ", bilinear" : ", biquadratic");
      check("cylinder" + kind, degree, *cylinder);
      check("sphere" + kind, degree, *sphere);
    }
  return 0;
}
