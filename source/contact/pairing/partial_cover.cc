// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/value_of.h>
#include <touchstone/contact/pairing/partial_cover.h>
#include <touchstone/contact/pairing/smooth_step.h>
#include <touchstone/contact/tolerances.h>

#include <Sacado.hpp>
#include <algorithm>
#include <cmath>

// How the nodes of a slave face that is covered in part share it: equation (4) of doc/theory.md
// 3.1. A template of the number type, so that derivatives by the covered areas come from the same
// code.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** beta_i and w_k of CoverShares. */
    template <typename Number>
    struct Division
    {
      std::array<Number, Face::max_nodes> keep, take;
      std::array<double, Face::max_nodes> at{};

      Division(const unsigned int                         n,
               const std::array<Number, Face::max_nodes> &covered,
               const std::array<double, Face::max_nodes> &whole,
               const CoverShares::Whole                  &at_once)
      {
        std::array<double, Face::max_nodes> values;
        std::transform(covered.begin(), covered.end(), values.begin(), [](const Number &a) {
          return value_of(a);
        });
        const bool leaves = CoverShares::gives_away(n, values, whole, at_once);
        Number     sum = 0., squares = 0., receivers = 0., most = 0.;
        for (unsigned int i = 0; i < n; ++i)
          if (whole[i] > 0.)
            {
              const Number theta = covered[i] / whole[i];
              sum += covered[i];
              squares += covered[i] * theta;
              if (!at_once.gives[i] && theta > most)
                most = theta;
            }
        // The mean cover; the largest one of those that receive, where that is less.
        Number mean = squares / sum;
        if (leaves && most < mean)
          mean = most;
        for (unsigned int i = 0; i < n; ++i)
          {
            if (leaves && at_once.gives[i])
              {
                keep[i] = take[i] = 0.;
                continue;
              }
            // A basis function of a face with hanging nodes may have an integral of zero or less:
            // it keeps its part.
            const Number cover = whole[i] > 0. ? Number(covered[i] / whole[i] / mean) : Number(1.);
            const double once  = at_once.part[i];
            at[i]              = value_of(cover);
            keep[i] =
              (1. - once) * smooth_step(cover, Tolerances::gives_all, Tolerances::keeps_all) +
              (CoverShares::keeps(at[i], at_once.before[i]) ? once : 0.);
            // Receivers are those that keep all of their own (beta = 1), in proportion to their
            // area, and start from zero there: no jump, and no chain of nodes that both give and
            // receive.
            take[i] = smooth_step(cover, Tolerances::keeps_all, 1.) * covered[i];
            receivers += take[i];
          }
        for (unsigned int k = 0; k < n; ++k)
          // w_k, of sum one.
          take[k] /= receivers;
      }

      /** T_ki a_i. */
      Number
      share(const unsigned int k, const unsigned int i, const Number &covered) const
      {
        Number result = (1. - keep[i]) * take[k] * covered;
        if (k == i)
          result += keep[i] * covered;
        return result;
      }
    };
  } // namespace



  bool
  CoverShares::gives_away(const unsigned int                         n,
                          const std::array<double, Face::max_nodes> &covered,
                          const std::array<double, Face::max_nodes> &whole,
                          const Whole                               &at_once)
  {
    // The mean cover is squares / sum = sum a_i theta_i / sum a_i, theta_i = a_i / A_i.
    double sum = 0., squares = 0., most = 0.;
    int    before = -1;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double theta = whole[i] > 0. ? covered[i] / whole[i] : 0.;
        sum += theta * whole[i];
        squares += theta * theta * whole[i];
        if (!at_once.gives[i])
          most = std::max(most, theta);
        else if (at_once.before[i] >= 0)
          before = (before == 0 || at_once.before[i] == 1) ? 0 : 1;
      }
    return keeps(most * sum / squares, before);
  }



  bool
  CoverShares::keeps(const double cover, const int before)
  {
    // Beyond these limits what was before is outdated, for the edge of the cover has moved by a
    // good part of a face.
    if (before < 0 || cover < Tolerances::gives_all || cover > Tolerances::keeps_all)
      return cover >= Tolerances::keeps_if_at_once;
    return before == 1;
  }



  CoverShares::CoverShares(const unsigned int                         n,
                           const std::array<double, Face::max_nodes> &covered,
                           const std::array<double, Face::max_nodes> &whole,
                           const CoverShares::Whole                  &at_once,
                           const bool                                 with_derivative)
  {
    const Division<double> division(n, covered, whole, at_once);
    cover   = division.at;
    partial = std::any_of(division.keep.begin(), division.keep.begin() + n, [](const double beta) {
      return beta != 1.;
    });
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int i = 0; i < n; ++i)
        {
          share[k][i] = division.share(k, i, covered[i]);
          if (with_derivative)
            for (unsigned int l = 0; l < n; ++l)
              // Without partial cover T is the unit matrix and S = diag(a).
              derivative[k][i][l] = (k == i && i == l);
        }
    if (!with_derivative || !partial)
      return;

    using Number = Sacado::Fad::SFad<double, int(Face::max_nodes)>;
    std::array<Number, Face::max_nodes> a;
    for (unsigned int i = 0; i < n; ++i)
      a[i] = Number(int(Face::max_nodes), int(i), covered[i]);
    const Division<Number> differentiated(n, a, whole, at_once);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int i = 0; i < n; ++i)
        {
          const Number value = differentiated.share(k, i, a[i]);
          for (unsigned int l = 0; l < n; ++l)
            derivative[k][i][l] = value.dx(l);
        }
  }
} // namespace Touchstone
