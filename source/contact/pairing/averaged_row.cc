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
    return kept >= Tolerances::least_cover * whole && Tolerances::most_given * kept >= given &&
           normal.norm_square() > 0.;
  }



  GapCorrection::GapCorrection(const CoverSums &sums, const double mean, const double size)
  {
    using Number         = Sacado::Fad::SFad<double, 5>;
    const double covered = sums.own < std::numeric_limits<double>::max() ? 1. : 0.;
    const Number at_mean = Number(5, 0, mean), least(5, 1, sums.least), kept(5, 3, sums.kept),
                 given   = Number(5, 4, sums.given);
    const Number own     = covered > 0. ? Number(5, 2, sums.own) : Number(sums.least + 1e10 * size);
    const Number difference = least - at_mean;
    Number       result     = 0.;
    if (difference > Tolerances::equal_gaps * size)
      {
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
    gap_vector = share * (mean + correction.value * normal);
  }



  void
  AveragedRow::differentiate(const CoverSumsDerivative &d,
                             Tensor<2, dim>            &d_normal,
                             Tensor<2, dim>            &d_gap_vector) const
  {
    d_normal = normalisation_derivative(normal_sum) * d.normal;
    // Of the mean gap along the mean normal, of what is added to it, and of the share of both.
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
