// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/place_in_words.h>

#include <cmath>
#include <cstdio>

// Positions in messages.
namespace Touchstone
{
  using namespace dealii;

  std::string
  place_in_words(const Point<dim> &x)
  {
    constexpr double shown = 1e-4; // of the distance from the origin
    double           r[dim];
    for (unsigned int d = 0; d < dim; ++d)
      r[d] = std::abs(x[d]) > shown * x.norm() ? x[d] : 0.;
    char text[80];
    std::snprintf(text, sizeof(text), "(%.3g, %.3g, %.3g)", r[0], r[1], r[2]);
    return text;
  }
} // namespace Touchstone
