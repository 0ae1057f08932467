// SPDX-License-Identifier: LGPL-2.1-or-later
// The gap of an averaged row over a curved face (doc/theory.md 3.1, equations (6) and (7)): it is
// not negative while nothing overlaps, it grows with its node and does not fall with others, and it
// is the mean where surfaces are pressed together. Derivatives are compared with differences.

#include <touchstone/contact/pairing/averaged_row.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

using namespace Touchstone;

namespace
{
  /** A tube of radius 1/2 over a plane, faces of size 1 on both sides of a node: gaps between the
   * nodes are below their interpolation by up to 1/4, means by 1/6. */
  constexpr double radius = 0.5, size = 1., below = 1. / (12. * radius);

  /** Gaps at a node and its two neighbours. */
  struct Gaps
  {
    double node, neighbour[2];

    double
    least() const
    {
      double result = node;
      for (const double other : neighbour)
        for (unsigned int i = 0; i <= 32; ++i)
          {
            const double x = i / 32.;
            result = std::min(result, (1. - x) * node + x * other - x * (1. - x) / (2. * radius));
          }
      return result;
    }

    CoverSums
    sums() const
    {
      CoverSums result;
      result.area = result.kept = 1.;
      result.least              = least();
      result.own                = node;
      result.beside             = 0.;
      result.length             = 1.;
      return result;
    }

    double
    row() const
    {
      const double mean = node - below;
      return mean + GapCorrection(sums(), mean, size).value;
    }
  };

  void
  print(const char *what, const bool holds)
  {
    std::cout << what << ": " << (holds ? "yes" : "no") << std::endl;
  }

  /** Whether the derivatives by all quantities are those of the value. */
  bool
  derivatives(CoverSums sums, const double mean)
  {
    constexpr double    step = 1e-6;
    const GapCorrection correction(sums, mean, size);
    const auto          difference = [&](double &x) {
      const double before = x;
      x                   = before + step;
      const double above  = GapCorrection(sums, mean, size).value;
      x                   = before - step;
      const double result = (above - GapCorrection(sums, mean, size).value) / (2. * step);
      x                   = before;
      return result;
    };
    const double by_mean = (GapCorrection(sums, mean + step, size).value -
                            GapCorrection(sums, mean - step, size).value) /
                           (2. * step);
    double error = std::abs(correction.by_mean - by_mean);
    error        = std::max(error, std::abs(correction.by_least - difference(sums.least)));
    error        = std::max(error, std::abs(correction.by_own - difference(sums.own)));
    error        = std::max(error, std::abs(correction.by_beside - difference(sums.beside)));
    error        = std::max(error, std::abs(correction.by_kept - difference(sums.kept)));
    error        = std::max(error, std::abs(correction.by_given - difference(sums.given)));
    return error < 1e-6;
  }
} // namespace



int
main()
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> gap(-0.5, 1.);
  bool apart = true, own = true, others = true, alone = true, pressed = true, mean = true;
  for (unsigned int i = 0; i < 20000; ++i)
    {
      const Gaps       gaps{gap(random), {gap(random), gap(random)}};
      const double     row  = gaps.row();
      constexpr double step = 1e-4, round_off = 1e-12;
      const Gaps       higher{gaps.node + step, {gaps.neighbour[0], gaps.neighbour[1]}};
      const Gaps       beside{gaps.node, {gaps.neighbour[0] + step, gaps.neighbour[1]}};
      // The largest that it may be is that of the node.
      pressed = pressed && row <= gaps.node + round_off && row >= gaps.node - below - round_off;
      own     = own && higher.row() - row >= step - round_off;
      others  = others && beside.row() >= row - round_off;
      if (gaps.least() >= 0.)
        {
          apart = apart && row >= 0.;
          alone = alone && std::abs(beside.row() - row) < round_off;
        }
    }
  // Pressed flat: means vanish.
  const Gaps flat{below, {below, below}};
  mean = std::abs(flat.row()) < 1e-12;
  print("no overlap, no negative gap", apart);
  print("between the mean and the gap at the node", pressed);
  print("grows with its node at least as much", own);
  print("does not fall with its neighbours", others);
  print("changes with its node alone while nothing overlaps", alone);
  print("the mean where the surfaces are pressed together", mean);

  CoverSums sums = Gaps{0.05, {0.4, 0.5}}.sums();
  print("derivatives, apart", derivatives(sums, 0.05 - below));
  sums.least = -0.02;
  print("derivatives, in between", derivatives(sums, 0.05 - below));
  sums.beside = 0.2;
  sums.own += 0.2;
  print("derivatives, beside the cover", derivatives(sums, 0.05 - below));
  sums.least = 0.004;
  sums.given = 0.3;
  sums.own   = 0.3;
  print("derivatives, area given away", derivatives(sums, -0.2));
  return 0;
}
