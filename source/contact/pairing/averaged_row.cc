// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/contact/pairing/averaged_row.h>
#include <touchstone/contact/pairing/smooth_step.h>
#include <touchstone/contact/tolerances.h>

#include <Sacado.hpp>
#include <limits>

namespace Touchstone
{
  using namespace dealii;

  bool
  CoverSums::suffices(const double whole) const
  {
    // A row needs some covered area of its own, at most r = 3 of it given away (doc/theory.md 3.1),
    // and a normal.
    return kept >= Tolerances::least_cover * whole && Tolerances::most_given * kept >= given &&
           normal.norm_square() > 0.;
  }



  GapCorrection::GapCorrection(const CoverSums &sums, const double mean, const double size)
  {
    // The corrections of equations (6) and (7) with derivatives by the six quantities that they
    // depend on: g mean, g_min, the two of g_s, D_kk and a_k - D_kk.
    using Number = Sacado::Fad::SFad<double, 6>;
    const Number at_mean(6, 0, mean), least(6, 1, sums.least), own(6, 2, sums.own),
      beside(6, 3, sums.beside), kept(6, 4, sums.kept), given(6, 5, sums.given);
    Number result = 0.;
    // chi of equation (7): whether the node itself is covered.
    const Number at_node = 1. - smooth_step(beside, 0., Tolerances::beside_node);
    // On plane faces all gaps are the mean up to round-off, and the quotients below would be noise.
    const double noise = Tolerances::equal_gaps * size;
    if (const Number above = own - sums.length * beside - at_mean; at_node > 0. && above > noise)
      {
        // As long as nothing overlaps the gap is that of the node, which the force of the row moves
        // and no other row has in common with it.
        Number part = at_node;
        if (const Number deep = -least / above; deep >= Tolerances::pressed)
          part = 0.;
        else if (deep > 0.)
          part *= 1. - deep / Tolerances::pressed;
        result += part * above;
      }
    if (const Number above = least - at_mean; at_node < 1. && above > noise)
      result += (1. - at_node) * above *
                smooth_step(Number(least / size), Tolerances::hardly_open, Tolerances::well_open);
    // 0.01 h r^4 of equation (6): the row opens before its area vanishes.
    if (given > 0.)
      {
        const Number ratio = given / kept;
        result += Tolerances::gap_growth * size * ratio * ratio * ratio * ratio;
      }
    value     = result.val();
    by_mean   = result.dx(0);
    by_least  = result.dx(1);
    by_own    = result.dx(2);
    by_beside = result.dx(3);
    by_kept   = result.dx(4);
    by_given  = result.dx(5);
    // The mean with a dual basis and the gap at the node follow the node alone, that at another
    // point by the shape function there.
    slope = 1. + by_mean + by_own + by_least * sums.at_least;
  }



  AveragedRow::AveragedRow(const CoverSums &sums, const double size)
    : share(sums.area / sums.kept)
    , normal(sums.normal / sums.normal.norm())
    , area(sums.area)
    , kept(sums.kept)
    , mean(sums.gap / sums.area)
    , normal_sum(sums.normal)
    , correction(sums, mean * normal, size)
  {
    // Normalised by D_kk and not by D, like the weights of the stencil, so that gap and stencil
    // belong to the same constraint.
    gap_vector = share * (mean + correction.value * normal);
  }



  void
  AveragedRow::differentiate(const CoverSumsDerivative &d,
                             Tensor<2, dim>            &d_normal,
                             Tensor<2, dim>            &d_gap_vector) const
  {
    // n = N/|N|.
    d_normal = normalisation_derivative(normal_sum) * d.normal;
    // Derivatives of the mean gap vector G/D, of the correction, and of the share D/D_kk by which
    // both are multiplied.
    const Tensor<2, dim> d_mean  = (d.gap - outer_product(mean, d.area)) / area;
    const Tensor<1, dim> d_value = correction.by_mean * (normal * d_mean + mean * d_normal) +
                                   correction.by_least * d.least + correction.by_own * d.own +
                                   correction.by_beside * d.beside + correction.by_kept * d.kept +
                                   correction.by_given * d.given;
    const Tensor<1, dim> d_share = (d.area - share * d.kept) / kept;
    d_gap_vector                 = outer_product(mean + correction.value * normal, d_share) +
                   share * (d_mean + outer_product(normal, d_value) + correction.value * d_normal);
  }



  Tensor<1, dim>
  AveragedRow::weight_derivative(const double               weight,
                                 const Tensor<1, dim>      &d_integral,
                                 const CoverSumsDerivative &d) const
  {
    return (d_integral - weight * d.kept) / kept;
  }
} // namespace Touchstone
