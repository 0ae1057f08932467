// SPDX-License-Identifier: LGPL-2.1-or-later
// Every method of global search finds the pairs that a comparison of each box with each other
// finds: in scenes of all kinds, and again after boxes have moved or their number has changed.
// What is not finite is refused. With --costs it measures instead: tests/collision_support.h.

#include <touchstone/base/non_convergence.h>
#include <touchstone/collision/box_tree.h>
#include <touchstone/collision/broad_phase.h>

#include "collision_support.h"
#include <iostream>
#include <limits>
#include <map>
#include <string>
#include <vector>

using namespace Touchstone;
using namespace dealii;

namespace
{
  using Boxes = std::vector<BoundingBox<dim>>;

  const std::vector<std::string> kinds = {"equal sizes",
                                          "sizes 1 : 1000",
                                          "flat",
                                          "long",
                                          "clusters",
                                          "far apart",
                                          "shifted by 1e6",
                                          "all the same",
                                          "touching",
                                          "tenths",
                                          "points"};

  Boxes
  scene(const std::string &kind, const unsigned int n, RandomNumbers &random)
  {
    const double shift = kind == "shifted by 1e6" ? 1e6 : 0.;
    Boxes        boxes;
    for (unsigned int k = 0; k < n; ++k)
      {
        Point<dim>     x;
        Tensor<1, dim> half;
        for (unsigned int d = 0; d < dim; ++d)
          {
            x[d]    = shift + random(-1., 1.);
            half[d] = random(0., 0.15);
          }
        if (kind == "sizes 1 : 1000")
          half *= 6. * std::pow(1000., random(-1., 0.));
        else if (kind == "flat")
          half[k % 3] = 0.;
        else if (kind == "long")
          half[k % 3] *= 20.;
        else if (kind == "clusters")
          x = Point<dim>(0.01 * x + Tensor<1, dim>({k % 3 - 1., k % 2 - 0.5, 0.1 * (k % 5)}));
        else if (kind == "far apart")
          x[0] += 1e9 * (k % 3);
        else if (kind == "all the same")
          {
            x    = Point<dim>(0.1, 0.2, 0.3);
            half = Tensor<1, dim>({0.5, 0.25, 0.});
          }
        else if (kind == "touching" || kind == "points")
          // Multiples of 1/4: faces, edges and corners coincide without round-off.
          for (unsigned int d = 0; d < dim; ++d)
            {
              x[d]    = std::floor(random(0., 12.)) / 4.;
              half[d] = kind == "points" ? 0. : std::floor(random(0., 3.)) / 8.;
            }
        boxes.push_back(box(x, half));
        if (kind == "tenths")
          {
            // They touch, and round-off decides in which cells their corners are.
            auto &[lower, upper] = boxes.back().get_boundary_points();
            for (unsigned int d = 0; d < dim; ++d)
              {
                const double i = std::floor(random(1., 10.));
                lower[d]       = 0.1 * i;
                upper[d]       = 0.1 * (i + 1.);
              }
          }
      }
    return boxes;
  }

  /** By less than their size, each on its own; or together; or some to anywhere; or what lies on
   * one side of the first box towards it. */
  void
  move(Boxes &boxes, const unsigned int way, RandomNumbers &random)
  {
    const double middle = boxes.empty() ? 0. : boxes[0].get_boundary_points().first[0];
    for (BoundingBox<dim> &b : boxes)
      {
        Tensor<1, dim> u;
        for (unsigned int d = 0; d < dim; ++d)
          u[d] = way == 0 ? random(-0.01, 0.01) : 0.125;
        if (way == 2)
          u *= std::floor(random(-9., 10.));
        if (way == 3 && random(0., 1.) < 0.1)
          u *= 8.;
        if (way == 4)
          u = b.get_boundary_points().first[0] > middle ? Tensor<1, dim>({-0.25, 0., 0.})
                                                        : Tensor<1, dim>();
        translate(b, u);
      }
  }

  /** The methods with what they keep: an object for each use, and one for all. */
  struct Methods
  {
    std::shared_ptr<BroadPhase> one_set, two_sets, any;
  };

  class Comparison
  {
  public:
    Comparison()
    {
      for (const std::string &name : BroadPhaseRegistry::names())
        if (name != "every pair")
          methods[name] = {BroadPhaseRegistry::make(name),
                           BroadPhaseRegistry::make(name),
                           BroadPhaseRegistry::make(name)};
    }

    void
    compare(const Boxes &a, const Boxes &b, const std::string &what)
    {
      const BoxPairs within = reference->find(a), between = reference->find(a, b);
      n_pairs += within.size() + between.size();
      for (auto &[name, method] : methods)
        {
          wrong[name] += method.one_set->find(a) != within;
          wrong[name] += method.two_sets->find(a, b) != between;
          wrong[name] += method.any->find(a) != within;
          wrong[name] += method.any->find(b, a) != reversed(between);
          if (wrong[name] > 0 && first_wrong.count(name) == 0)
            first_wrong[name] = what;
        }
    }

    void
    report() const
    {
      for (const auto &[name, method] : methods)
        std::cout << name << ": "
                  << (wrong.at(name) == 0 ? "the same pairs as each with each"
                                          : "FAILED, first with " + first_wrong.at(name))
                  << std::endl;
      std::cout << (n_pairs > 100000 ? "many" : "FAILED: few") << " pairs" << std::endl;
    }

  private:
    std::shared_ptr<BroadPhase>         reference = BroadPhaseRegistry::make("every pair");
    std::map<std::string, Methods>      methods;
    std::map<std::string, unsigned int> wrong;
    std::map<std::string, std::string>  first_wrong;
    std::size_t                         n_pairs = 0;

    static BoxPairs
    reversed(BoxPairs pairs)
    {
      for (auto &[i, j] : pairs)
        std::swap(i, j);
      std::sort(pairs.begin(), pairs.end());
      return pairs;
    }
  };

  void
  compare_all()
  {
    Comparison    comparison;
    RandomNumbers random;
    for (unsigned int round = 0; round < 20; ++round)
      for (const std::string &kind : kinds)
        {
          // Small numbers, none and one among them; two rounds in which hierarchies have levels.
          const double most = round < 6 ? 2.5 * round : round < 18 ? 70. : 350.;
          Boxes        a    = scene(kind, std::floor(random(0., most)), random),
                b           = scene(kind, std::floor(random(0., most)), random);
          comparison.compare(a, b, kind);
          for (const unsigned int way : {0, 4, 0, 1, 4, 3, 0, 2, 0})
            {
              move(a, way, random);
              move(b, way, random);
              comparison.compare(a, b, kind + ", moved");
            }
          a.resize(a.size() / 2);
          comparison.compare(a, b, kind + ", fewer");
        }
    comparison.report();
  }

  /** @param change Makes a box bad. */
  void
  refused(const std::string &what, const std::function<void(BoundingBox<dim> &)> &change)
  {
    RandomNumbers random;
    const Boxes   good = scene("equal sizes", 9, random);
    Boxes         bad  = good;
    change(bad[7]);
    unsigned int n_refused = 0, n_right = 0, n_methods = 0;
    for (const std::string &name : BroadPhaseRegistry::names())
      {
        ++n_methods;
        const auto method = BroadPhaseRegistry::make(name);
        const auto expect = [&](const std::string &place, const auto &call) {
          try
            {
              call();
            }
          catch (const ExplicitFailure &failure)
            {
              n_refused += std::string(failure.what()).find("Box 7 of " + place) == 0;
            }
        };
        expect("the set", [&] { method->find(bad); });
        expect("the first set", [&] { method->find(bad, good); });
        expect("the second set", [&] { method->find(good, bad); });
        // It goes on to work.
        n_right += method->find(good) == BroadPhaseRegistry::make("every pair")->find(good);
      }
    std::cout << what << ": "
              << (n_refused == 3 * n_methods && n_right == n_methods ? "refused" : "FAILED")
              << std::endl;
  }

  /** The nearest box of a tree is that of all, and few are looked at, also from far away where all
   * have nearly the same distance. */
  void
  nearest()
  {
    RandomNumbers random;
    bool          right   = true;
    unsigned int  n_looks = 0;
    for (const std::string &kind : std::vector<std::string>{"equal sizes", "all the same", "flat"})
      {
        SearchBoxes boxes;
        boxes.append(scene(kind, 4000, random), "the set");
        BoxTree tree;
        tree.build(boxes);
        for (const double away : {0.5, 3., 1e6})
          {
            const Point<dim> x(0.1 - away, 0.2 * away, away);
            double           least = std::numeric_limits<double>::max(), found = least;
            unsigned int     n = 0;
            for (const FlatBox &box : boxes.boxes)
              least = std::min(least, box.distance_square(x));
            tree.nearest(x, [&](const unsigned int k) {
              ++n;
              found = std::min(found, boxes.boxes[k].distance_square(x));
              return std::sqrt(found);
            });
            right &= found == least;
            // Boxes in the same distance all are looked at.
            if (kind != "all the same")
              n_looks = std::max(n_looks, n);
          }
      }
    std::cout << "nearest: " << (right && n_looks < 200 ? "right" : "FAILED") << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  if (argc > 1 && std::string(argv[1]) == "--costs")
    {
      print_costs(argc, argv);
      return 0;
    }
  compare_all();
  nearest();
  refused("NaN", [](BoundingBox<dim> &b) {
    b.get_boundary_points().first[1] = std::numeric_limits<double>::quiet_NaN();
  });
  refused("infinite", [](BoundingBox<dim> &b) {
    b.get_boundary_points().second[2] = std::numeric_limits<double>::infinity();
  });
  refused("inverted", [](BoundingBox<dim> &b) { b.get_boundary_points().second[0] -= 10.; });
  return 0;
}
