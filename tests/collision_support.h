// SPDX-License-Identifier: LGPL-2.1-or-later
// Boxes for tests of global search, and what it costs: collision_searches --costs [FACES ...]
// prints a table for all methods; contrib/search_costs.sh calls it so.

#ifndef touchstone_tests_collision_support_h
#define touchstone_tests_collision_support_h

#include <touchstone/collision/broad_phase.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <malloc.h>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace Touchstone
{
  /** Numbers that are the same with each standard library. */
  class RandomNumbers
  {
    std::mt19937 engine;

  public:
    double
    operator()(const double lower, const double upper)
    {
      return lower + (upper - lower) * (engine() / 4294967296.);
    }
  };

  inline dealii::BoundingBox<dim>
  box(const dealii::Point<dim> &centre, const dealii::Tensor<1, dim> &half)
  {
    return dealii::BoundingBox<dim>(std::make_pair(centre - half, centre + half));
  }

  inline void
  translate(dealii::BoundingBox<dim> &box, const dealii::Tensor<1, dim> &by)
  {
    box.get_boundary_points().first += by;
    box.get_boundary_points().second += by;
  }

  /** A wave with sharp folds, of period 4 between -1 and 1. */
  inline double
  fold(const double x)
  {
    const double t = x - 4. * std::floor(x / 4.);
    return t < 2. ? t - 1. : 3. - t;
  }

  /** A point of a sheet that lies in folds in all directions. */
  inline dealii::Point<dim>
  crumpled(const double u, const double v)
  {
    return {fold(7. * u + 2.1 * v) + 0.13 * fold(13. * v + 3. * u),
            fold(6. * v - 3.3 * u) + 0.11 * fold(15. * u - 5. * v),
            fold(4.1 * u + 4.7 * v + 0.6) + 0.12 * fold(9. * u + 11. * v)};
  }

  /** Give boxes in the unit cube that are near near numbers, as faces of meshes have. */
  inline void
  number_by_place(std::vector<dealii::BoundingBox<dim>> &boxes)
  {
    const double n_blocks = std::ceil(std::cbrt(boxes.size() / 8.));
    const auto   block    = [&](const dealii::BoundingBox<dim> &b) {
      const auto &[lower, upper] = b.get_boundary_points();
      std::array<double, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = std::floor(n_blocks * (lower[d] + upper[d]) / 2.);
      return result;
    };
    std::stable_sort(boxes.begin(), boxes.end(), [&](const auto &a, const auto &b) {
      return block(a) < block(b);
    });
  }

  /** About @p n faces. 'uniform': two square sheets of equal faces, one on the other; 'sizes':
   * cubes of sizes 1 : 1000 in space; 'scattered': the same, numbered at random; 'crumpled': one
   * sheet, crumpled to a ball. Boxes of sheets are larger than the faces by a tenth on each side.
   */
  inline std::vector<dealii::BoundingBox<dim>>
  scene_of_costs(const std::string &kind, const unsigned int n)
  {
    std::vector<dealii::BoundingBox<dim>> boxes;
    RandomNumbers                         random;
    if (kind == "sizes" || kind == "scattered")
      {
        const double scale = 1.5 / std::cbrt(n);
        for (unsigned int k = 0; k < n; ++k)
          {
            const double             half = scale * std::pow(1000., random(-1., 0.));
            const dealii::Point<dim> x(random(0., 1.), random(0., 1.), random(0., 1.));
            boxes.push_back(box(x, dealii::Tensor<1, dim>({half, half, half})));
          }
        if (kind == "sizes")
          number_by_place(boxes);
        return boxes;
      }
    const unsigned int n_sheets = kind == "uniform" ? 2 : 1;
    const unsigned int m        = std::lround(std::sqrt(double(n) / n_sheets));
    const double       h        = 1. / m;
    for (unsigned int s = 0; s < n_sheets; ++s)
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int i = 0; i < m; ++i)
          {
            std::vector<dealii::Point<dim>> corners;
            for (unsigned int c = 0; c < 4; ++c)
              {
                const double u = (i + c % 2) * h, v = (j + c / 2) * h;
                corners.push_back(
                  kind == "crumpled"
                    ? crumpled(u, v)
                    : dealii::Point<dim>(u + 0.3 * s * h, v + 0.4 * s * h, 0.1 * s * h));
              }
            dealii::BoundingBox<dim>     face(corners);
            auto                        &points = face.get_boundary_points();
            const dealii::Tensor<1, dim> sides  = points.second - points.first;
            const double                 margin = 0.1 * std::max({sides[0], sides[1], sides[2]});
            for (unsigned int d = 0; d < dim; ++d)
              {
                points.first[d] -= margin;
                points.second[d] += margin;
              }
            boxes.push_back(face);
          }
    return boxes;
  }

  /** The next position of boxes that drift in a smooth field, by up to 0.073 of @p size. */
  inline void
  drift(std::vector<dealii::BoundingBox<dim>> &boxes, const double size)
  {
    for (dealii::BoundingBox<dim> &b : boxes)
      {
        const dealii::Point<dim> x = b.get_boundary_points().first;
        translate(b,
                  0.03 * size *
                    dealii::Tensor<1, dim>(
                      {1. + std::sin(5. * x[1]), std::cos(4. * x[2]), std::sin(6. * x[0])}));
      }
  }

  inline const std::vector<std::string> scenes_of_costs = {"uniform",
                                                           "sizes",
                                                           "scattered",
                                                           "crumpled"};

  struct SearchCost
  {
    /** Nanoseconds per face of the first call, and of one after boxes have moved. */
    double first, next;
    /** Pairs per face. */
    double pairs;
  };

  inline SearchCost
  measure_search(const std::string &method, std::vector<dealii::BoundingBox<dim>> boxes)
  {
    const double n          = boxes.size();
    const auto   seconds_of = [](const auto &action) {
      // Of the processor: what else the machine does hardly counts.
      const std::clock_t start = std::clock();
      action();
      return double(std::clock() - start) / CLOCKS_PER_SEC;
    };
    std::vector<double> sizes;
    for (const auto &b : boxes)
      sizes.push_back(b.side_length(0));
    std::nth_element(sizes.begin(), sizes.begin() + sizes.size() / 2, sizes.end());
    const double size = sizes[sizes.size() / 2];

    SearchCost cost{};
    // The first call of an object, thrice; and ten further ones of the last, of which the mean
    // counts: what is renewed in some of them must be paid for.
    std::shared_ptr<BroadPhase> search;
    for (unsigned int k = 0; k < 3; ++k)
      {
        search = BroadPhaseRegistry::make(method);
        const double ns =
          1e9 / n * seconds_of([&] { cost.pairs = search->find(boxes).size() / n; });
        cost.first = k == 0 ? ns : std::min(cost.first, ns);
      }
    for (unsigned int k = 0; k < 10; ++k)
      {
        drift(boxes, size);
        cost.next += 1e8 / n * seconds_of([&] { search->find(boxes); });
      }
    return cost;
  }

  /** A value of this process in bytes, from Linux's /proc/self/status. */
  inline double
  memory_status(const std::string &key)
  {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
      if (line.compare(0, key.size(), key) == 0)
        return 1024. * std::atof(line.c_str() + key.size());
    return 0.;
  }

  /** Bytes per face at the peak of two calls, without the boxes of the caller. */
  inline double
  memory_of_search(const std::string &method, std::vector<dealii::BoundingBox<dim>> boxes)
  {
    // What is freed goes back to the system.
    mallopt(M_MMAP_THRESHOLD, 1 << 16);
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";
    const double before = memory_status("VmRSS:");
    const auto   search = BroadPhaseRegistry::make(method);
    search->find(boxes);
    drift(boxes, boxes[0].side_length(0));
    search->find(boxes);
    return (memory_status("VmHWM:") - before) / boxes.size();
  }

  /** @param argv Numbers of faces from the second on; 5 to 320 thousand if there are none. */
  inline void
  print_costs(const int argc, char **argv)
  {
    std::vector<unsigned int> numbers;
    for (int a = 2; a < argc; ++a)
      numbers.push_back(std::lround(std::atof(argv[a])));
    if (numbers.empty())
      numbers = {5000, 20000, 80000, 320000};
    std::printf(
      "%-9s %-20s %8s %7s %8s %8s\n", "scene", "method", "faces", "pairs", "first ns", "next ns");
    for (const std::string &kind : scenes_of_costs)
      for (const std::string &method : BroadPhaseRegistry::names())
        {
          if (method == "every pair")
            continue;
          SearchCost smallest{}, last{};
          for (const unsigned int n : numbers)
            {
              last = measure_search(method, scene_of_costs(kind, n));
              if (n == numbers[0])
                smallest = last;
              std::printf("%-9s %-20s %8u %7.1f %8.0f %8.0f\n",
                          kind.c_str(),
                          method.c_str(),
                          n,
                          last.pairs,
                          last.first,
                          last.next);
              std::fflush(stdout);
            }
          if (numbers.size() > 1)
            {
              const double by = std::log(double(numbers.back()) / numbers[0]);
              std::printf("%-9s %-20s growth of the whole: first N^%.2f, next N^%.2f\n",
                          kind.c_str(),
                          method.c_str(),
                          1. + std::log(last.first / smallest.first) / by,
                          1. + std::log(last.next / smallest.next) / by);
            }
        }
    std::printf("bytes per face, %u faces\n", numbers.back());
    for (const std::string &kind : scenes_of_costs)
      for (const std::string &method : BroadPhaseRegistry::names())
        if (method != "every pair")
          std::printf("%-9s %-20s %8.0f\n",
                      kind.c_str(),
                      method.c_str(),
                      memory_of_search(method, scene_of_costs(kind, numbers.back())));
  }
} // namespace Touchstone

#endif
