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
    // phi of equation (7) and the correction of equation (6) with derivatives by the five
    // quantities that they depend on: g mean, g_min, g_s, D_kk and a_k - D_kk.
    using Number         = Sacado::Fad::SFad<double, 5>;
    const double covered = sums.own < std::numeric_limits<double>::max() ? 1. : 0.;
    const Number at_mean = Number(5, 0, mean), least(5, 1, sums.least), kept(5, 3, sums.kept),
                 given   = Number(5, 4, sums.given);
    // A node that is not covered has g_s infinite; a large finite value keeps the derivatives
    // finite.
    const Number own = covered > 0. ? Number(5, 2, sums.own) : Number(sums.least + 1e10 * size);
    const Number difference = least - at_mean;
    Number       result     = 0.;
    // On plane faces the mean is the smallest gap up to round-off, and the quotients below would be
    // noise.
    if (difference > Tolerances::equal_gaps * size)
      {
        // omega of equation (7): 1 if another point than the node is the closest.
        const Number other =
          smooth_step(Number((own - least) / difference), 0., Tolerances::elsewhere);
        Number part = 1. - other;
        if (least < 0.)
          part *= 1. - smooth_step(Number(-least / difference), 0., Tolerances::deep_node);
        else
          part += other *
                  smooth_step(Number(least / size), Tolerances::hardly_open, Tolerances::well_open);
        result = part * difference;
      }
    // 0.01 h r^4 of equation (6): the row opens before its area vanishes.
    if (given > 0.)
      {
        const Number ratio = given / kept;
        result += Tolerances::gap_growth * size * ratio * ratio * ratio * ratio;
      }
    value    = result.val();
    by_mean  = result.dx(0);
    by_least = result.dx(1);
    by_own   = result.dx(2);
    by_kept  = result.dx(3);
    by_given = result.dx(4);
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
                                   correction.by_kept * d.kept + correction.by_given * d.given;
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
