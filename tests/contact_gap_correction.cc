// SPDX-License-Identifier: LGPL-2.1-or-later
// The gap of an averaged row over a curved face (doc/theory.md 3.1, equations (6) and (7)): it is
// not negative while nothing overlaps, it is that of the node where surfaces touch on a line of
// nodes and the mean where they are pressed together, it grows with all nodes and with its own
// most, and with all together as much as they move. Derivatives are compared with differences.

#include <touchstone/contact/pairing/averaged_row.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** A tube of radius 1/2 over a plane, faces of size 1 on both sides of a node: means are below
   * those of the interpolated gaps at the nodes by 1/6. */
  constexpr double radius = 0.5, size = 1., below = 1. / (12. * radius);

  const Tensor<1, dim> normal({0., 0., 1.});

  /** Gaps at a node and its two neighbours, and the lengths of the faces to these. */
  struct Gaps
  {
    double node, neighbour[2];
    double length[2] = {1., 1.};

    /** The smallest gap on the face to neighbour @p i. */
    double
    least(const unsigned int i) const
    {
      double result = node;
      for (unsigned int k = 0; k <= 32; ++k)
        {
          const double x = k / 32.;
          result         = std::min(result,
                            (1. - x) * node + x * neighbour[i] -
                              length[i] * length[i] * x * (1. - x) / (2. * radius));
        }
      return result;
    }

    /** The smallest gap. */
    double
    least() const
    {
      return std::min(least(0), least(1));
    }

    /** How far the mean on the face to neighbour @p i is below that of the nodes. */
    double
    below_on(const unsigned int i) const
    {
      return length[i] * length[i] * below;
    }

    double
    mean() const
    {
      return node - (length[0] * below_on(0) + length[1] * below_on(1)) / (length[0] + length[1]);
    }

    /** With nodes moved. */
    Gaps
    moved(const double own, const double first, const double second) const
    {
      Gaps result = *this;
      result.node += own;
      result.neighbour[0] += first;
      result.neighbour[1] += second;
      return result;
    }

    CoverSums
    sums() const
    {
      CoverSums result;
      result.area = result.kept = 0.5 * (length[0] + length[1]);
      // Not clearly apart.
      result.least  = -1.;
      result.own    = node;
      result.beside = 0.;
      result.length = 1.;
      for (unsigned int i = 0; i < 2; ++i)
        {
          FaceShare face;
          face.area = face.shape_area = 0.5 * length[i];
          face.gap                    = face.area * (node - below_on(i)) * normal;
          face.shape_gap =
            face.area * (2. / 3. * node + 1. / 3. * neighbour[i] - below_on(i)) * normal;
          face.own    = node;
          face.beside = 0.;
          face.least  = least(i);
          result.faces.push_back(face);
        }
      return result;
    }

    double
    row() const
    {
      return mean() + GapCorrection(sums(), normal, mean(), size).value;
    }
  };

  void
  print(const char *what, const bool holds)
  {
    std::cout << what << ": " << (holds ? "yes" : "no") << std::endl;
  }

  /** Whether the derivatives by all quantities are those of the value, with the face @p deciding.
   */
  bool
  derivatives(CoverSums sums, double mean, const int deciding)
  {
    constexpr double    step = 1e-7;
    const GapCorrection correction(sums, normal, mean, size);
    double              error = 0.;
    const auto          check = [&](double &x, const double derivative) {
      const double before = x;
      x                   = before + step;
      const double above  = GapCorrection(sums, normal, mean, size).value;
      x                   = before - step;
      const double under  = GapCorrection(sums, normal, mean, size).value;
      x                   = before;
      error = std::max(error, std::abs(derivative - (above - under) / (2. * step)));
    };
    check(mean, correction.by_mean);
    check(sums.least, correction.by_least);
    check(sums.own, correction.by_own);
    check(sums.beside, correction.by_beside);
    check(sums.kept, correction.by_kept);
    check(sums.given, correction.by_given);
    check(sums.area, correction.by_area);
    if (deciding < 0)
      return error < 1e-6 && correction.face == nullptr;
    FaceShare &face = sums.faces[deciding];
    check(face.gap[2], correction.by_face_mean / face.area);
    check(face.shape_gap[2], correction.by_face_positive / face.shape_area);
    check(face.own, correction.by_face_own);
    check(face.beside, correction.by_face_beside);
    check(face.least, correction.by_face_least);
    // The mean of the face changes with its area as well.
    check(face.area,
          correction.by_face_area -
            correction.by_face_mean * face.gap[2] / (face.area * face.area));
    return error < 1e-6 && correction.face == &face;
  }
} // namespace



namespace
{
  /** What holds for all gaps, with faces of these lengths.
   * @param overlap By how much of c the gap may be below zero where undeformed bodies touch. */
  void
  check_gaps(const double first, const double second, const double overlap)
  {
    std::mt19937                           random(1);
    std::uniform_real_distribution<double> gap(-0.5, 1.), place(-0.5, 0.5);
    constexpr double                       step = 1e-4, round_off = 1e-12;
    bool apart = true, touching = true, between = true, own = true, others = true, together = true;
    for (unsigned int i = 0; i < 20000; ++i)
      {
        const double node = gap(random), left = gap(random), right = gap(random);
        const Gaps   gaps{node, {left, right * second}, {first, second}};
        const double row = gaps.row();
        between = between && row <= gaps.node + round_off && row >= gaps.mean() - round_off;
        own     = own && gaps.moved(step, 0., 0.).row() - row >= 0.5 * step - round_off;
        others  = others && gaps.moved(0., step, 0.).row() >= row - round_off;
        together =
          together && std::abs(gaps.moved(step, step, step).row() - row - step) < round_off;
        apart = apart && (gaps.least() < 0. || row >= -round_off);
        // Undeformed and pressed by nothing; the lowest point is beside the node.
        const double x          = place(random);
        const auto   undeformed = [&](const double at) {
          return (at - x) * (at - x) / (2. * radius);
        };
        const Gaps touch{undeformed(0.), {undeformed(-first), undeformed(second)}, {first, second}};
        touching = touching && touch.row() >= -overlap * (touch.node - touch.mean()) - round_off;
      }
    print("no overlap, no negative gap", apart);
    print(overlap == 0. ? "touching bodies: no negative gap"
                        : "touching bodies: hardly a negative gap",
          touching);
    print("between the mean and the gap at the node", between);
    print("grows with its node by half of the motion at least", own);
    print("does not fall with its neighbours", others);
    print("changes as much as all nodes together", together);
  }
} // namespace



int
main()
{
  check_gaps(1., 1., 0.);
  std::cout << "Faces of 1 and 3:" << std::endl;
  check_gaps(1., 3., 0.06);
  constexpr double round_off = 1e-12;
  // On a line of contact; pressed flat; and so on one side, at the edge of a contact.
  const Gaps line{0., {1., 1.}}, flat{below, {below, below}}, edge{below, {below, below + 1.}};
  print("the gap at the node where one line of nodes touches", std::abs(line.row()) < round_off);
  print("the mean where the surfaces are pressed together", std::abs(flat.row()) < round_off);
  print("the mean at the edge of a contact", std::abs(edge.row()) < round_off);

  // The same difference between node and mean, but made by displacements, or of surfaces that
  // nearly fit: their arches are 250 times as high.
  CoverSums strained = line.sums(), fitting = line.sums();
  strained.own_moved = below * normal;
  fitting.shape_area = 1.;
  fitting.arch       = 250. * below;
  print("the mean where strain makes the difference",
        GapCorrection(strained, normal, line.mean(), size).value == 0.);
  print("the mean between surfaces that nearly fit",
        GapCorrection(fitting, normal, line.mean(), size).value == 0.);

  const Gaps hardly{0.05, {0.8, 0.9}}, half{0.05, {0.6, 0.4}}, open{0.05, {1.3, 1.2}};
  print("derivatives, hardly flattened", derivatives(hardly.sums(), hardly.mean(), 0));
  print("derivatives, half flattened", derivatives(half.sums(), half.mean(), 1));
  print("derivatives, not flattened", derivatives(open.sums(), open.mean(), -1));
  CoverSums sums = half.sums();
  sums.beside    = 0.2;
  sums.own += 0.2;
  print("derivatives, beside the cover", derivatives(sums, half.mean(), 1));
  sums.faces[1].area = 0.01;
  sums.faces[1].gap *= 0.02;
  print("derivatives, a small part of a face", derivatives(sums, half.mean(), 1));
  sums.least = 0.004;
  sums.given = 0.3;
  print("derivatives, apart and area given away", derivatives(sums, half.mean(), 1));

  sums              = hardly.sums();
  const double mean = hardly.mean();
  // The mean of a node that is not covered is extrapolated.
  sums.beside = 0.3;
  sums.own += 0.3;
  sums.faces[0].least = 0.04;
  print("no overlap where the mean is extrapolated",
        mean + GapCorrection(sums, normal, mean, size).value > 0.04);
  print("derivatives where the mean is extrapolated", derivatives(sums, mean, 0));
  sums.beside = 0.04;
  sums.own -= 0.26;
  print("derivatives where it hardly is", derivatives(sums, mean, 0));
  return 0;
}
