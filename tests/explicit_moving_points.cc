// SPDX-License-Identifier: LGPL-2.1-or-later
// Groups of points on straight paths that a turning direction tells apart do not cross, by exact
// arithmetic; and what moves together is told apart however much it turns.

#include <touchstone/collision/first_crossing.h>
#include <touchstone/explicit/general/moving_faces.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

using namespace Touchstone;
using dealii::Point;
using dealii::Tensor;

namespace
{
  constexpr double margin = 1e-5;

  std::mt19937_64 generator;

  /** In (-1, 1). */
  double
  real()
  {
    return 2. * double(generator() >> 11) * 0x1p-53 - 1.;
  }

  Point<dim>
  random_point()
  {
    return {real(), real(), real()};
  }

  /** Directions at both ends of random motions: no crossing may be passed over. */
  template <std::size_t m, class FirstCrossing>
  void
  never_miss(const std::string &what, const FirstCrossing &first_crossing)
  {
    unsigned int told_apart = 0, missed = 0;
    for (unsigned int i = 0; i < 20000; ++i)
      {
        FourPoints   from, to;
        const double way = std::pow(10., -1.5 + 1.5 * real());
        for (unsigned int k = 0; k < 4; ++k)
          {
            from[k] = random_point();
            to[k]   = from[k] + way * random_point();
          }
        const TurningDirection direction{shortest_difference(from.data(), m, 4),
                                         shortest_difference(to.data(), m, 4)};
        if (distance_in_front<m>(from, to, direction, margin) > 0.)
          {
            ++told_apart;
            missed += first_crossing(from, to).has_value();
          }
      }
    std::cout << what << ": more than half are told apart: " << (told_apart > 10000)
              << ", missed crossings: " << missed << std::endl;
  }

  /** Two faces, one in front of the other by 1e-4, that turn by a tenth. */
  void
  turn_together()
  {
    unsigned int told_apart = 0, at_rest = 0;
    for (unsigned int i = 0; i < 1000; ++i)
      {
        std::array<Point<dim>, 8> from, to;
        for (unsigned int k = 0; k < 8; ++k)
          {
            const double x = (k + 1) % 4 > 1 ? 1. : -1., y = k % 4 > 1 ? 1. : -1.;
            const bool   in_front = k < 4;
            const double shift    = in_front ? real() : 0.;
            Point<dim>   p(x + shift, y + shift, in_front ? 1e-4 : 0.);
            // The same turn of all of them, about an axis that lies askew.
            const double     angle = 0.1, c = std::cos(angle), s = std::sin(angle);
            const Point<dim> turned(c * p[0] - s * p[2], p[1], s * p[0] + c * p[2]);
            from[k] = p;
            to[k]   = turned;
          }
        const TurningFrame   frame(from.data(), to.data());
        const Tensor<1, dim> up = shortest_difference(from.data(), 4, 8);
        const double         distance =
          distance_in_front<4>(from, to, frame.turning(frame.components(up)), margin);
        told_apart += distance > 0.9e-4 && distance < 1.000001e-4;
        at_rest += distance_in_front<4>(from, to, {up, up}, margin) > 0.;
      }
    std::cout << "faces that turn together: told apart " << told_apart
              << " of 1000, by a direction at rest " << at_rest << std::endl;
  }

  /** Four corners of a face that is not quite plane, and where they go. */
  MovingCorners
  random_face(const double way)
  {
    std::array<Point<dim>, 4> from, to;
    for (unsigned int a = 0; a < 4; ++a)
      {
        const Point<dim> corner((a + 1) % 4 > 1 ? 1. : -1., a > 1 ? 1. : -1., 0.);
        from[a] = corner + 0.3 * random_point();
        to[a]   = from[a] + way * random_point();
      }
    MovingCorners face;
    face.set(from, to, 1.);
    return face;
  }

  /** No triangle of a face that a node crosses is out of reach. */
  void
  triangles()
  {
    unsigned int n_apart = 0, missed = 0;
    for (unsigned int i = 0; i < 20000; ++i)
      {
        const double        way  = std::pow(10., -1.5 + 1.5 * real());
        const MovingCorners face = random_face(way);
        Point<dim>          from(real(), real(), 0.5 * way * real());
        const Point<dim>    to = from + way * random_point();
        Point<dim>          middle[2];
        for (unsigned int a = 0; a < 4; ++a)
          for (const bool at_end : {false, true})
            middle[at_end] += 0.25 * dealii::Tensor<1, dim>(face.corner(a, at_end));
        const unsigned int in_reach =
          NodeAndFace{from, to, face}.triangles_in_reach(middle[0], middle[1], margin);
        for (unsigned int t = 0; t < 4; ++t)
          if (!(in_reach >> t & 1U))
            {
              ++n_apart;
              const unsigned int next = (t + 1) % 4;
              missed += first_crossing_node_triangle(
                          {{from, face.corner(t, false), face.corner(next, false), middle[0]}},
                          {{to, face.corner(t, true), face.corner(next, true), middle[1]}})
                          .has_value();
            }
      }
    std::cout << "triangles of a face: more than four fifths are out of reach: "
              << (n_apart > 64000) << ", missed crossings: " << missed << std::endl;
  }

  /** Of faces the same distances as of groups of points. */
  void
  same_distances()
  {
    unsigned int differ = 0;
    for (unsigned int i = 0; i < 2000; ++i)
      {
        const MovingCorners       one = random_face(0.1), other = random_face(0.1);
        std::array<Point<dim>, 8> from, to;
        std::array<Point<dim>, 5> node_from, node_to;
        for (unsigned int k = 0; k < 8; ++k)
          {
            const MovingCorners &face = k < 4 ? one : other;
            from[k]                   = face.corner(k % 4, false);
            to[k]                     = face.corner(k % 4, true);
          }
        std::copy_n(from.begin() + 3, 5, node_from.begin());
        std::copy_n(to.begin() + 3, 5, node_to.begin());
        const TurningDirection direction{random_point(), random_point()};
        const auto             same = [&](const double a, const double b) {
          return std::abs(a - b) < 1e-12 && (a > 0.) == (b > 0.);
        };
        differ += !same(TwoFaces{one, other}.distance_in_front(direction, margin),
                        distance_in_front<4>(from, to, direction, margin));
        differ += !same(NodeAndFace{from[3], to[3], other}.distance_in_front(direction, margin),
                        distance_in_front<1>(node_from, node_to, direction, margin));
      }
    std::cout << "distances of faces that differ from those of their points: " << differ
              << std::endl;
  }
} // namespace

int
main()
{
  never_miss<1>("node and triangle", first_crossing_node_triangle);
  never_miss<2>("two edges", first_crossing_edge_edge);
  turn_together();
  triangles();
  same_distances();
  return 0;
}
