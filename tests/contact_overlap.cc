// SPDX-License-Identifier: LGPL-2.1-or-later
// Points on the common parts of faces: the pieces of a face that a turned grid covers add up to
// its mass matrix, whatever their number of corners; coincident edges; corners cut off. That what
// the quadrature leaves depends neither on the numbering of nodes nor on directions. And which
// faces are connected over common nodes.

#include <touchstone/contact/geometry/overlap.h>
#include <touchstone/contact/search/connected_components.h>

#include "mesh_common.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** A face with the corners a, b, c, d in the order of its nodes. */
  Face
  make_face(const std::array<Point<dim>, 4> &corners)
  {
    Face face;
    face.degree = 1;
    for (unsigned int m = 0; m < 4; ++m)
      {
        face.nodes[m]        = m;
        face.reference[m]    = corners[m];
        face.displacement[m] = Tensor<1, dim>();
      }
    return face;
  }

  /** A parallelogram seen from above, or from below. */
  Face
  parallelogram(const Point<dim>     &middle,
                const Tensor<1, dim> &along,
                const Tensor<1, dim> &across,
                const bool            from_below)
  {
    const Tensor<1, dim> a = from_below ? across : along, b = from_below ? along : across;
    return make_face({{middle - a - b, middle + a - b, middle - a + b, middle + a + b}});
  }



  /** Integrals over what masters cover of a slave face: of products of shapes, and how far the
   * points of both lie apart across the normal. */
  void
  cover(const std::string       &name,
        const Face              &slave,
        const std::vector<Face> &masters,
        const double             expected_area,
        const bool               whole)
  {
    double       mass[4][4] = {}, area = 0., apart = 0.;
    std::size_t  points = 0;
    unsigned int pieces = 0;
    for (const Face &master : masters)
      {
        const auto common = overlap(slave, master);
        points += common.size();
        pieces += !common.empty();
        for (const OverlapPoint &p : common)
          {
            const FaceShapes     shapes(1, p.slave);
            const Tensor<1, dim> offset =
              evaluate(slave, nullptr, p.slave).x - evaluate(master, nullptr, p.master).x;
            const Tensor<1, dim> normal = evaluate(slave, nullptr, p.slave).normal();
            apart = std::max(apart, (offset - (offset * normal) * normal).norm());
            area += p.weight;
            for (unsigned int j = 0; j < 4; ++j)
              for (unsigned int k = 0; k < 4; ++k)
                mass[j][k] += p.weight * shapes.value[j] * shapes.value[k];
          }
      }
    double error = 0.;
    for (unsigned int j = 0; whole && j < 4; ++j)
      for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int shared = (j % 2 == k % 2) + (j / 2 == k / 2);
          const double       exact  = (shared == 2 ? 4. : shared == 1 ? 2. : 1.) / 36.;
          error                     = std::max(error, std::abs(mass[j][k] / expected_area - exact));
        }
    std::cout << name << ": " << pieces << " pieces, " << points << " points, area "
              << small(std::abs(area - expected_area), 1e-11) << ", apart " << small(apart, 1e-7);
    if (whole)
      std::cout << ", products of shapes " << small(error, 1e-11);
    std::cout << std::endl;
  }

  /** Two masters whose common edge lies almost on the lower edge of a slave face, at @p angle:
   * where they cross runs along that edge by 1 / angle for the smallest motion across it. The
   * integral over both parts of a function that is continuous over the common edge must not: its
   * difference quotients hardly change over 1.5 angle, and are the derivatives of the points. */
  void
  edge_along_edge(const double angle)
  {
    const Face slave   = make_face({{Point<dim>(-1., 0., 0.),
                                     Point<dim>(1., 0., 0.),
                                     Point<dim>(-0.7, 1., 0.),
                                     Point<dim>(0.7, 1.1, 0.)}});
    const auto masters = [angle](const double motion) {
      const Point<dim> left(-1.3, motion - 1.3 * angle, 0.1), right(1.4, motion + 1.4 * angle, 0.2);
      return std::array<Face, 2>{
        {make_face({{right, left, Point<dim>(1.2, 1.9, 0.1), Point<dim>(-1.5, 1.4, 0.3)}}),
         make_face({{Point<dim>(1.1, -1.5, 0.2), Point<dim>(-1.2, -1.2, 0.1), right, left}})}};
    };
    // The nodes on the right and on the left of the common edge, as nodes of the two masters.
    const unsigned int nodes[2][2] = {{0, 1}, {2, 3}};
    const auto         integral    = [&](const double motion) {
      double     result = 0.;
      const auto faces  = masters(motion);
      for (unsigned int f = 0; f < 2; ++f)
        for (const OverlapPoint &p : overlap(slave, faces[f]))
          result +=
            p.weight * FaceShapes(1, p.slave).value[0] * FaceShapes(1, p.master).value[nodes[f][0]];
      return result;
    };
    const auto derivative = [&](const double motion) {
      double     result = 0.;
      const auto faces  = masters(motion);
      for (unsigned int f = 0; f < 2; ++f)
        for (const auto &p : differentiated_overlap<4>(slave, faces[f]))
          for (const unsigned int node : nodes[f])
            {
              const unsigned int v = dim * (4 + node) + 1;
              const FaceShapes   on_slave(1, p.slave), on_master(1, p.master);
              const double       a = on_slave.value[0], b = on_master.value[nodes[f][0]];
              result += p.d_weight[v] * a * b;
              for (unsigned int d = 0; d < 2; ++d)
                result += p.weight * (on_slave.gradient[0][d] * p.d_slave[d][v] * b +
                                      a * on_master.gradient[nodes[f][0]][d] * p.d_master[d][v]);
            }
      return result;
    };

    constexpr int n     = 10;
    const double  step  = 1.5 * angle / n;
    double        least = 1e300, most = -1e300, error = 0.;
    for (int i = -n; i < n; ++i)
      {
        const double change = (integral((i + 1) * step) - integral(i * step)) / step;
        least               = std::min(least, change);
        most                = std::max(most, change);
        // Not where the corner comes to an end of the edge within the step.
        const double at = (i + 0.5) * step, h = 0.1 * step;
        error =
          std::max(error,
                   std::abs((integral(at + h) - integral(at - h)) / (2. * h) - derivative(at)));
      }
    std::cout << "edge along an edge at " << angle << ": changes of the derivative "
              << small((most - least) / most, 1e-2) << ", error " << small(error, 1e-5)
              << std::endl;
  }

  /** The face with its nodes numbered from another corner, @p turns times the next one. */
  Face
  renumbered(const Face &face, const unsigned int turns)
  {
    std::array<Point<dim>, 4> x;
    for (unsigned int m = 0; m < 4; ++m)
      x[m] = face.position(m);
    for (unsigned int t = 0; t < turns; ++t)
      x = {{x[1], x[3], x[0], x[2]}};
    return make_face(x);
  }

  /** The mirror image in the plane x = 0, its normal outward as before. */
  Face
  mirrored(const Face &face)
  {
    std::array<Point<dim>, 4> x;
    for (unsigned int m = 0; m < 4; ++m)
      {
        x[m] = face.position(m);
        x[m][0] *= -1.;
      }
    return make_face({{x[1], x[0], x[3], x[2]}});
  }

  /** The integral over an overlap of what no polynomial of the face coordinates is.
   * @param sign -1 for a mirror image. */
  double
  integral(const Face &slave, const Face &master, const double sign)
  {
    double result = 0.;
    for (const OverlapPoint &p : overlap(slave, master))
      {
        const Point<dim> x = evaluate(slave, nullptr, p.slave).x;
        const Point<dim> y = evaluate(master, nullptr, p.master).x;
        result += p.weight * std::exp(sign * x[0] + 0.5 * x[1]) * (1. + y[2]);
      }
    return result;
  }

  /** Warped faces that overlap in a polygon of many corners: another first corner of either, or a
   * mirror image, leaves the integral as it is. */
  void
  compare_orders(const std::string &name, const Face &slave, const Face &master)
  {
    const double expected = integral(slave, master, 1.);
    double       error    = std::abs(integral(mirrored(slave), mirrored(master), -1.) - expected);
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < 4; ++j)
        error =
          std::max(error,
                   std::abs(integral(renumbered(slave, i), renumbered(master, j), 1.) - expected));
    std::cout << name << ": differs by " << small(error / expected, 1e-12) << std::endl;
  }

  /** Faces by the numbers of their nodes: components as numbers of their first faces. */
  void
  connect(const std::string &name, const std::vector<std::array<Index, 4>> &nodes)
  {
    std::vector<Face> faces(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      std::copy(nodes[i].begin(), nodes[i].end(), faces[i].nodes.begin());
    std::vector<const Face *> list;
    for (const Face &face : faces)
      list.push_back(&face);
    std::cout << name << ':';
    for (const unsigned int component : connected_components(list))
      std::cout << ' ' << component;
    std::cout << (is_connected(list) ? ", connected" : ", not connected") << std::endl;
  }
} // namespace

int
main()
{
  const Tensor<1, dim> x({1., 0., 0.}), y({0., 1., 0.});
  const Point<dim>     origin;
  const Face           square = parallelogram(origin, x, y, false);
  const Face           slanted =
    parallelogram(origin, Tensor<1, dim>({1., 0.2, 0.}), Tensor<1, dim>({0.4, 0.9, 0.}), false);

  for (const double angle : {0., 0.3, numbers::PI_4})
    for (const double size : {0.15, 0.35, 2.})
      {
        const Tensor<1, dim> along({std::cos(angle), std::sin(angle), 0.}),
          across({-std::sin(angle), std::cos(angle), 0.});
        std::vector<Face> grid;
        const int         n = static_cast<int>(1.6 / size) + 2;
        for (int i = -n; i <= n; ++i)
          for (int j = -n; j <= n; ++j)
            grid.push_back(
              parallelogram(Point<dim>(0.013, -0.021, 0.1) + 2. * size * (i * along + j * across),
                            size * along,
                            size * across,
                            true));
        const std::string name =
          "turned by " + std::to_string(angle) + ", size " + std::to_string(size);
        cover("square, " + name, square, grid, 4., true);
        cover("slanted, " + name, slanted, grid, 4. * (1. * 0.9 - 0.2 * 0.4), true);
      }

  // The same face but for round-off, in which edges cross anywhere along them.
  for (const double angle : {0., 1e-15, -1e-14, 1e-12})
    {
      const Tensor<1, dim> along({std::cos(angle), std::sin(angle), 0.}),
        across({-std::sin(angle), std::cos(angle), 0.});
      cover("same face turned by " + std::to_string(angle * 1e15) + "e-15",
            square,
            {parallelogram(origin, along, across, true)},
            4.,
            true);
    }

  // Corners that are left: a triangle, and five corners.
  const auto diamond = [&](const double shift) {
    return parallelogram(Point<dim>(shift, shift, 0.), x + y, y - x, true);
  };
  cover("corner cut off", square, {diamond(1.75)}, 0.5 * 0.5 * 0.5, false);
  cover("corner left out", square, {diamond(-0.25)}, 4. - 0.5 * 0.5 * 0.5, false);
  cover("beside", square, {parallelogram(Point<dim>(2., 0., 0.), x, y, true)}, 0., false);

  // Corners of the overlaps: 8, 5 and 3.
  const Face warped      = make_face({{Point<dim>(-1., -0.9, 0.),
                                       Point<dim>(1.1, -1., 0.1),
                                       Point<dim>(-0.9, 1., 0.05),
                                       Point<dim>(0.8, 1.1, -0.1)}});
  const auto warped_over = [](const double shift) {
    return make_face({{Point<dim>(shift, shift - 1.3, 0.2),
                       Point<dim>(shift - 1.3, shift, 0.15),
                       Point<dim>(shift + 1.4, shift, 0.25),
                       Point<dim>(shift, shift + 1.35, 0.2)}});
  };
  compare_orders("eight corners", warped, warped_over(0.));
  compare_orders("five corners", warped, warped_over(-0.5));
  compare_orders("three corners", warped, warped_over(1.4));

  for (const double angle : {1e-3, 1e-4, 1e-6, 1e-8})
    edge_along_edge(angle);

  connect("no face", {});
  connect("a strip", {{{0, 1, 2, 3}}, {{2, 3, 4, 5}}, {{4, 5, 6, 7}}});
  connect("over a corner", {{{0, 1, 2, 3}}, {{3, 10, 11, 12}}});
  connect("two strips in turn",
          {{{0, 1, 2, 3}}, {{20, 21, 22, 23}}, {{2, 3, 4, 5}}, {{22, 23, 24, 25}}});
  connect("joined by the last", {{{0, 1, 2, 3}}, {{20, 21, 22, 23}}, {{3, 30, 31, 20}}});
  return 0;
}
