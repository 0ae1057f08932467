// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/balls_in_cell.h>

#include <algorithm>

// Where the balls of a cell are (doc/theory.md 3.5).
namespace Touchstone
{
  BallsInCell::BallsInCell(const unsigned int splittings)
    : n(1u << splittings)
  {
    const auto centre = [this](const unsigned int i) { return (2. * i + 1.) / n - 1.; };
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          centres.push_back({{centre(i), centre(j)}});
          const FaceShapes            shapes(1, centres.back());
          const double                depth = 0.5 / n;
          std::array<double, n_nodes> of_ball;
          for (unsigned int m = 0; m < Face::behind; ++m)
            {
              of_ball[m]                = (1. - depth) * shapes.value[m];
              of_ball[Face::behind + m] = depth * shapes.value[m];
            }
          weights.push_back(of_ball);
        }
  }



  unsigned int
  BallsInCell::below(const std::array<double, 2> &xi) const
  {
    unsigned int along[2];
    for (unsigned int a = 0; a < 2; ++a)
      along[a] = static_cast<unsigned int>(std::clamp(0.5 * (xi[a] + 1.) * n, 0., n - 0.5));
    return along[0] + n * along[1];
  }
} // namespace Touchstone
