// SPDX-License-Identifier: LGPL-2.1-or-later
// First crossings of node and triangle and of two edges, and segments that intersect triangles,
// against exact arithmetic: random and degenerate motions. With the argument --all a million
// random motions and a hundred thousand degenerate ones, and times (doc/first_crossing.md).

#include <touchstone/base/non_convergence.h>
#include <touchstone/collision/first_crossing.h>
#include <touchstone/collision/segment_triangle.h>

#include "brute_force_crossings.h"
#include <ctime>
#include <iostream>
#include <limits>
#include <random>
#include <string>

using namespace Touchstone;
using dealii::Point;

namespace
{
  struct Motion
  {
    FourPoints start, end;
  };

  std::mt19937_64 generator;

  /** Print what may depend on the machine, too. */
  bool show = false;

  /** Whole number from -most to most. */
  int
  whole(const int most)
  {
    return int(generator() % (2 * most + 1)) - most;
  }

  /** In (-1, 1). */
  double
  real()
  {
    return 2. * double(generator() >> 11) * 0x1p-53 - 1.;
  }

  /** Points in a cube of the size 2, moved by less than @p way, around a point. */
  Motion
  random_motion(const double way, const double centre)
  {
    Motion motion;
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double x     = real();
          motion.start[i][d] = centre + x;
          motion.end[i][d]   = centre + x + way * real();
        }
    return motion;
  }

  /** Few whole numbers, so that points meet, lie in a plane or on a line, and move within it. */
  Motion
  degenerate_motion()
  {
    const int    most   = 1 + generator() % 3;
    const auto   kind   = generator() % 8;
    const double centre = generator() % 4 == 0 ? 1e6 : 0.;
    Motion       motion;
    int          rigid[dim];
    for (int &x : rigid)
      x = whole(most);
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double start = kind == 1 && d == 2 ? 0. : whole(most);
          double       end   = kind == 1 && d == 2 ? 0. : whole(most);
          if (kind == 2 || (kind == 3 && i > 0) || (kind == 4 && i > 1))
            end = start; // all at rest, all but the first point or edge
          if (kind == 5)
            end = start + rigid[d]; // together
          if (kind == 6)
            end = -start; // through a point
          motion.start[i][d] = centre + start;
          motion.end[i][d]   = centre + end;
        }
    if (kind == 7) // a quarter turn
      for (unsigned int i = 0; i < 4; ++i)
        motion.end[i] = Point<dim>(centre - (motion.start[i][1] - centre),
                                   motion.start[i][0],
                                   motion.start[i][2]);
    return motion;
  }

  /** The same in another unit and in other directions: rounded, so that points that met do not,
   * or do by chance, and lie nearly in a plane. */
  Motion
  rounded_motion()
  {
    Motion motion = degenerate_motion();
    for (FourPoints *points : {&motion.start, &motion.end})
      for (Point<dim> &x : *points)
        x = Point<dim>(0.1 * (x[0] - x[1]) / 3., 0.1 * (x[0] + x[2]) / 3., 0.7 * x[1] + x[2] / 7.);
    return motion;
  }

  /** The first point is on the triangle of the others, and so are both edges: a bit above or below
   * after rounding. This is so at the start, from where some or all move on, or at the end. */
  Motion
  touching_motion()
  {
    Motion       motion = random_motion(generator() % 2 == 0 ? 0.1 : 1., 0.);
    const double s = 0.5 + 0.5 * real(), t = 0.5 + 0.5 * real();
    auto &[a, b, c, d]        = motion.start;
    const Point<dim> together = motion.end[0];
    a                         = Point<dim>((1. - s) * (1. - t) * b + s * (1. - t) * c + t * d);
    switch (generator() % 3)
      {
        case 0: // the line of a and b through the edge of c and d
          b = a + (c + t * (d - c) - a) / s;
          break;
        case 1:
          motion.end = motion.start;
          break;
        default:
          for (unsigned int i = 0; i < 4; ++i)
            motion.end[i] = motion.start[i] + (together - a);
      }
    if (generator() % 2 == 0)
      std::swap(motion.start, motion.end);
    return motion;
  }

  std::optional<Crossing>
  first_crossing(const Motion &motion, const unsigned int n_of_first)
  {
    return n_of_first == 1 ? first_crossing_node_triangle(motion.start, motion.end)
                           : first_crossing_edge_edge(motion.start, motion.end);
  }

  /** Distance of the points at the weights of a crossing, relative to the largest difference. */
  double
  distance(const Motion &motion, const Crossing &crossing, const unsigned int n_of_first)
  {
    const auto [x, y, z]                = crossing.weights;
    const std::array<double, 4> weights = n_of_first == 1
                                            ? std::array<double, 4>{{-1., x, y, z}}
                                            : std::array<double, 4>{{x - 1., -x, 1. - y, y}};
    dealii::Tensor<1, dim>      sum;
    double                      size = 0.;
    for (unsigned int i = 0; i < 4; ++i)
      {
        const auto start = motion.start[i] - motion.start[0], end = motion.end[i] - motion.end[0];
        sum += weights[i] * ((1. - crossing.time) * start + crossing.time * end);
        size = std::max({size, start.norm(), end.norm()});
      }
    return size > 0. ? sum.norm() / size : 0.;
  }

  struct Counts
  {
    unsigned int motions = 0, boxes = 0, crossings = 0, missed = 0;
    /** False alarms in all, and where the points are farther apart than round-off. */
    unsigned int false_alarms = 0, apart = 0;
    /** Times that differ by more than 1e-6, though the points are farther apart than round-off;
     * weights of other points; results that change with the unit. */
    unsigned int times = 0, weights = 0, units = 0;
  };

  bool
  same(const std::optional<Crossing> &a, const std::optional<Crossing> &b)
  {
    return a.has_value() == b.has_value() &&
           (!a || (a->time == b->time && a->weights == b->weights));
  }

  void
  compare(const Motion &motion, const unsigned int n_of_first, Counts &counts)
  {
    const auto exact = BruteForce::first_time(motion.start, motion.end, n_of_first);
    const auto found = first_crossing(motion, n_of_first);
    ++counts.motions;
    counts.boxes += !BruteForce::boxes_apart(motion.start, motion.end, n_of_first);
    counts.crossings += exact.has_value();
    counts.missed += exact && !found;
    counts.false_alarms += found && !exact;
    if (found)
      {
        const double gap = distance(motion, *found, n_of_first);
        counts.apart += !exact && gap > 1e-12;
        counts.times += exact && std::abs(found->time - *exact) > 1e-6 && gap > 1e-13;
        counts.weights += gap > 1e-11;
      }
    // Another unit, some of them at the ends of the range of numbers.
    const std::array<double, 4> units  = {{0x1p-50, 0x1p40, 0x1p-900, 0x1p980}};
    Motion                      scaled = motion;
    for (FourPoints *points : {&scaled.start, &scaled.end})
      for (Point<dim> &x : *points)
        x *= units[counts.motions % 4];
    counts.units += !same(found, first_crossing(scaled, n_of_first));
  }

  /** @param exact No false alarm is expected at all. */
  template <class Make>
  void
  compare_all(const std::string &name,
              const unsigned int n,
              const Make        &make,
              const bool         exact = true)
  {
    for (const unsigned int n_of_first : {1, 2})
      {
        generator.seed(n_of_first);
        Counts counts;
        for (unsigned int i = 0; i < n; ++i)
          compare(make(), n_of_first, counts);
        if (!exact && show)
          std::cout << "false alarms within round-off: " << counts.false_alarms << '\n';
        std::cout << name << (n_of_first == 1 ? ", node and triangle: " : ", two edges: ")
                  << counts.motions << " motions, boxes meet in " << counts.boxes
                  << ", crossings: " << counts.crossings << "; missed: " << counts.missed
                  << ", false alarms: " << (exact ? counts.false_alarms : counts.apart)
                  << (exact ? "" : " but for round-off") << ", wrong times: " << counts.times
                  << ", wrong weights: " << counts.weights
                  << ", changed by the unit: " << counts.units << std::endl;
      }
  }

  /** A segment is the path of a node. */
  void
  compare_segments(const unsigned int n)
  {
    generator.seed(3);
    unsigned int wrong = 0, count = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        Motion motion = i % 3 == 0   ? random_motion(2., 0.)
                        : i % 3 == 1 ? degenerate_motion()
                                     : rounded_motion();
        for (unsigned int j = 1; j < 4; ++j)
          motion.end[j] = motion.start[j];
        const bool exact = BruteForce::first_time(motion.start, motion.end, 1).has_value();
        count += exact;
        wrong += exact != intersects({{motion.start[0], motion.end[0]}},
                                     {{motion.start[1], motion.start[2], motion.start[3]}});
      }
    std::cout << "segments and triangles: " << n << ", intersect: " << count << ", wrong: " << wrong
              << std::endl;
  }

  void
  not_finite()
  {
    unsigned int thrown = 0;
    for (const double x : {std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()})
      for (const unsigned int n_of_first : {1, 2, 3})
        try
          {
            Motion motion    = random_motion(1., 100.);
            motion.end[0][1] = x;
            if (n_of_first < 3)
              first_crossing(motion, n_of_first);
            else
              intersects({{motion.start[0], motion.end[0]}},
                         {{motion.start[1], motion.start[2], motion.start[3]}});
          }
        catch (const NonConvergence &)
          {
            ++thrown;
          }
    std::cout << "not finite: " << thrown << " of 9 refused\n";
  }

  /** Nanoseconds of processor time for each motion whose boxes meet. */
  template <class Make>
  void
  measure(const std::string &name, const Make &make)
  {
    for (const unsigned int n_of_first : {1, 2})
      {
        std::vector<Motion> motions;
        while (motions.size() < 20000)
          {
            const Motion motion = make();
            if (!BruteForce::boxes_apart(motion.start, motion.end, n_of_first))
              motions.push_back(motion);
          }
        unsigned int crossings = 0;
        const auto   begin     = std::clock();
        for (const Motion &motion : motions)
          crossings += first_crossing(motion, n_of_first).has_value();
        std::cout << name << (n_of_first == 1 ? ", node and triangle: " : ", two edges: ")
                  << 1e9 * double(std::clock() - begin) / CLOCKS_PER_SEC / motions.size()
                  << " ns, crossings " << double(crossings) / motions.size() << std::endl;
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  const bool         all    = argc > 1 && std::string(argv[1]) == "--all";
  const unsigned int factor = all ? 250 : 1;
  show                      = all;
  const auto short_way      = [] { return random_motion(0.5, 0.); };
  const auto long_way       = [] { return random_motion(2., 0.); };
  const auto far_away       = [] { return random_motion(0.5, 1e6); };
  compare_all("random", 1000 * factor, short_way);
  compare_all("random, long way", 500 * factor, long_way);
  compare_all("random, around 1e6", 500 * factor, far_away);
  compare_all("degenerate", 200 * factor, degenerate_motion);
  compare_all("degenerate, rounded", 200 * factor, rounded_motion, false);
  compare_all("touching, rounded", 200 * factor, touching_motion, false);
  compare_segments(1000 * factor);
  not_finite();
  if (all)
    {
      measure("random", short_way);
      measure("random, long way", long_way);
      measure("degenerate", degenerate_motion);
    }
  return 0;
}
