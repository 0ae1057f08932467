// SPDX-License-Identifier: LGPL-2.1-or-later
// Geometry of the local searches beside the projection: the point in which a line along a slave
// normal meets a bilinear face from outside, against Newton's method from many starts, and where
// the balls of a cell are.

#include <touchstone/contact/pairing/balls_in_cell.h>
#include <touchstone/contact/pairing/line_and_face.h>

#include "mesh_common.h"
#include <random>

using namespace Touchstone;
using namespace dealii;

namespace
{
  std::mt19937 generator(5);

  /** Between -1 and 1, the same on all systems. */
  double
  any()
  {
    return generator() / (0.5 * std::mt19937::max()) - 1.;
  }

  Tensor<1, dim>
  any_vector()
  {
    return Point<dim>(any(), any(), any());
  }

  /** A unit square with corners moved by up to @p warp in each direction. */
  Face
  make_square(const double warp)
  {
    Face face;
    for (unsigned int m = 0; m < 4; ++m)
      face.reference[m] = Point<dim>(m % 2, m / 2, 0.) + warp * any_vector();
    return face;
  }

  /** The coordinates within the face at which the line meets it from outside, by Newton's method
   * from 25 starts; how many different ones there are is counted. */
  unsigned int
  by_newton(const Point<dim>      &x,
            const Tensor<1, dim>  &n,
            const FaceGeometry    &geometry,
            std::array<double, 2> &result)
  {
    unsigned int count = 0;
    for (unsigned int start = 0; start < 25; ++start)
      {
        std::array<double, 2> xi{{-1. + 0.5 * (start % 5), -1. + 0.5 * (start / 5)}};
        double                determinant = 0., step = 1.;
        for (unsigned int i = 0; i < 30 && step < 1e3; ++i)
          {
            const FacePoint      point = geometry.evaluate(xi);
            const auto          &t     = point.tangents;
            const Tensor<1, dim> left  = x - point.x;
            determinant                = cross_product_3d(t[0], t[1]) * n;
            const double d[2]          = {cross_product_3d(t[1], n) * left / determinant,
                                          cross_product_3d(n, t[0]) * left / determinant};
            xi[0] += d[0];
            xi[1] += d[1];
            step = std::abs(d[0]) + std::abs(d[1]);
          }
        if (!(step < 1e-12) || !(determinant < 0.) || std::abs(xi[0]) > 1. || std::abs(xi[1]) > 1.)
          continue;
        if (count == 0 || std::abs(xi[0] - result[0]) + std::abs(xi[1] - result[1]) > 1e-6)
          ++count;
        result = xi;
      }
    return count;
  }



  void
  check_lines(const std::string &name, const double warp, const double tilt)
  {
    unsigned int met = 0, missed = 0, wrong = 0, several = 0, behind = 0;
    double       off_line = 0., off_newton = 0.;
    for (unsigned int i = 0; i < 2000; ++i)
      {
        const Face         face = make_square(warp);
        const FaceGeometry geometry(face, nullptr, MasterNormal::face);
        const Point<dim>   x(0.5 + 0.7 * any(), 0.5 + 0.7 * any(), 0.4 * any());
        Tensor<1, dim>     n = Point<dim>(0., 0., -1.) + tilt * any_vector();
        n /= n.norm();
        const auto            found = meet_from_outside(x, n, geometry);
        std::array<double, 2> newton{};
        const unsigned int    roots = by_newton(x, n, geometry, newton);
        several += (roots > 1);
        const bool inside = found && std::abs(found->xi[0]) <= 1. && std::abs(found->xi[1]) <= 1.;
        if (inside != (roots > 0))
          ++wrong;
        else if (inside)
          {
            ++met;
            off_line = std::max(off_line, (found->point.x - x - found->along * n).norm());
            off_newton =
              std::max(off_newton,
                       std::abs(found->xi[0] - newton[0]) + std::abs(found->xi[1] - newton[1]));
            const BeyondEdges beyond(face, found->xi);
            wrong += (beyond.inner > 0. || beyond.outer > 0.);
          }
        else
          ++missed;
        // The other side of the face is not seen, unless the line runs along it.
        if (const auto back = meet_from_outside(x, -1. * n, geometry))
          behind += (back->point.normal() * n < 0.);
      }
    std::cout << name << ": " << met << " lines meet the face, " << missed << " do not, " << wrong
              << " wrong, " << several << " with several points, " << behind
              << " from behind\n  off the line " << small(off_line) << ", from Newton's method "
              << small(off_newton, 1e-10) << std::endl;
  }



  void
  check_edges()
  {
    Face face           = make_square(0.);
    face.outer_edges    = 1u << 1; // xi_1 = 1
    const auto distance = [&](const double a, const double b) {
      const BeyondEdges beyond(face, {{a, b}});
      std::cout << "  at " << a << ", " << b << ": inner " << beyond.inner << ", outer "
                << beyond.outer << '\n';
    };
    std::cout << "beyond edges\n";
    distance(1.2, 0.);
    distance(-1.2, 0.);
    distance(0.5, -1.4);
  }



  void
  check_balls(const unsigned int splittings)
  {
    const BallsInCell balls(splittings);
    double            sum = 0., off = 0., depth = 0.;
    unsigned int      wrong = 0;
    for (unsigned int b = 0; b < balls.size(); ++b)
      {
        double         all = 0.;
        Tensor<1, dim> centre;
        for (unsigned int i = 0; i < BallsInCell::n_nodes; ++i)
          {
            all += balls.weight(b, i);
            centre += balls.weight(b, i) * Point<dim>(i % 2, (i / 2) % 2, i / 4);
          }
        sum = std::max(sum, std::abs(all - 1.));
        for (unsigned int a = 0; a < 2; ++a)
          off = std::max(off, std::abs(2. * centre[a] - 1. - balls.above(b)[a]));
        depth = std::max(depth, centre[2]);
        wrong += balls.below(balls.above(b)) != b;
        for (unsigned int m = 0; m < 4; ++m)
          wrong += balls.weight(b, m) > balls.weight(b, balls.closest_node(b));
      }
    std::cout << balls.size() << " balls at depth " << depth << ": sums " << small(sum)
              << ", centres " << small(off) << ", " << wrong << " wrong, beyond the corners "
              << balls.below({{-1.1, -1.1}}) << " to " << balls.below({{1.1, 1.1}}) << std::endl;
  }
} // namespace

int
main()
{
  check_lines("plane", 0., 0.3);
  check_lines("warped", 0.2, 0.3);
  check_lines("much warped", 0.4, 0.8);
  check_edges();
  for (const unsigned int splittings : {0, 1, 2})
    check_balls(splittings);
  return 0;
}
