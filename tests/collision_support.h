// SPDX-License-Identifier: LGPL-2.1-or-later
// Boxes for tests of global search, and its costs: collision_searches --costs [FACES ...] prints
// them for the methods of the registry; contrib/search_costs.sh calls it so.

#ifndef touchstone_tests_collision_support_h
#define touchstone_tests_collision_support_h

#include <touchstone/collision/broad_phase.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
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

  inline void
  print_costs(int, char **)
  {
  }
} // namespace Touchstone

#endif
