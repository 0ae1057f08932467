// SPDX-License-Identifier: LGPL-2.1-or-later
// The search alone, on a wavy surface against a finer and turned grid of slave nodes. As a
// test it looks at what is found. With arguments, the numbers of slave nodes, it prints
// times and the exponents of their growth; contrib/search_scaling.sh calls it so.

#include <touchstone/contact/search/facing_faces.h>

#include <deal.II/base/timer.h>

#include "contact_support.h"
#include <cstdio>
#include <cstdlib>

using namespace Touchstone;
using namespace dealii;

namespace
{
  double
  height(const double x, const double y)
  {
    return 0.03 * std::sin(9. * x) * std::cos(7. * y);
  }

  /** A point of the slave grid: within the master surface, turned by 0.2. */
  Point<dim>
  slave_point(const unsigned int i, const unsigned int j, const unsigned int n, const double gap)
  {
    const double s = 0.7 * (double(i) / n - 0.5), t = 0.7 * (double(j) / n - 0.5);
    const double x = 0.5 + std::cos(0.2) * s - std::sin(0.2) * t,
                 y = 0.5 + std::sin(0.2) * s + std::cos(0.2) * t;
    return {x, y, 1. + height(x, y) + gap};
  }

  struct Result
  {
    double nodes, update, pointwise, averaged;
  };

  Result
  measure(const unsigned int n_slave, const bool report)
  {
    const unsigned int n = std::lround(0.9 * n_slave);
    const PairOfScene  pair(master_only(
      "set Cells = " + std::to_string(n) + ", " + std::to_string(n) + ", 1", "top", ""));
    Touchstone::Vector ghosted(pair.solid.owned, pair.solid.relevant, MPI_COMM_WORLD);
    ghosted = pair.displacement([](const Point<dim> &x, unsigned int) {
      return Tensor<1, dim>({0., 0., x[2] * height(x[0], x[1])});
    });
    pair.move_surfaces(ghosted);

    const double            gap = 1e-3 / n;
    std::vector<Point<dim>> points;
    for (unsigned int j = 0; j <= n_slave; ++j)
      for (unsigned int i = 0; i <= n_slave; ++i)
        points.push_back(slave_point(i, j, n_slave, gap));
    Search search(*pair.master, 4. / n, 0.01, MasterNormal::averaged, MPI_COMM_WORLD);
    search.commit(nullptr);

    Timer timer;
    search.update(points);
    const double         update = timer.wall_time();
    const Tensor<1, dim> down({0., 0., -1.});
    unsigned int         found   = 0;
    double               largest = 0.;
    timer.restart();
    for (const Point<dim> &x : points)
      if (const auto partner = search.find({x, x, down, false, {}}))
        {
          ++found;
          largest = std::max(largest, std::abs((x - partner->x) * partner->normal));
        }
    const double pointwise = timer.wall_time();

    FacingFaces facing(search, 0.);
    double      covered = 0., whole = 0.;
    timer.restart();
    for (unsigned int j = 0; j < n_slave; ++j)
      for (unsigned int i = 0; i < n_slave; ++i)
        {
          Face face;
          face.key = i + n_slave * j;
          // It looks downwards.
          for (unsigned int m = 0; m < 4; ++m)
            face.reference[m] = points[i + m / 2 + (n_slave + 1) * (j + m % 2)];
          for (const FacingFace &master : facing.find(face))
            for (const OverlapPoint &point : master.points)
              covered += point.weight;
          whole += cross_product_3d(face.reference[3] - face.reference[0],
                                    face.reference[2] - face.reference[1])
                     .norm() /
                   2.;
        }
    const double averaged = timer.wall_time();
    if (report)
      std::cout << points.size() << " nodes: " << found << " found, gaps "
                << (largest < 0.05 / n ? "small" : "not small FAILED") << ", faces covered to "
                << small(covered / whole - 1., 1e-3) << std::endl;
    return {double(points.size()), update, pointwise, averaged};
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc == 1)
    {
      measure(20, true);
      measure(45, true);
      return 0;
    }
  std::printf("%10s %12s %12s %12s   seconds\n", "nodes", "update", "pointwise", "averaged");
  Result last{};
  for (int a = 1; a < argc; ++a)
    {
      const Result r = measure(std::lround(std::sqrt(std::atof(argv[a]))) - 1, false);
      std::printf("%10.0f %12.3f %12.3f %12.3f", r.nodes, r.update, r.pointwise, r.averaged);
      if (last.nodes > 0.)
        {
          const double by = std::log(r.nodes / last.nodes);
          std::printf("   exponents %.2f %.2f %.2f",
                      std::log(r.update / last.update) / by,
                      std::log(r.pointwise / last.pointwise) / by,
                      std::log(r.averaged / last.averaged) / by);
        }
      std::printf("\n");
      std::fflush(stdout);
      last = r;
    }
  return 0;
}
