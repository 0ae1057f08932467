#include <touchstone/contact/partial_cover.h>

#include <deal.II/base/quadrature_lib.h>

#include <Sacado.hpp>
#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Of the mean cover of a face: a node that has less than `weak` leaves its row to
     * others, with `strong` it keeps it. Half a face covered gives 0.4 to nodes beyond. */
    constexpr double weak = 0.1, strong = 0.4;

    /** What a node may give away per area that it keeps until it has no row; by which part of
     * a face its gap grows where it gives as much as it keeps, and with which power of the ratio
     * of both. Gaps of 1e-5 and 0.1 of a face alike then open the row while the edge goes a good
     * part of a face, and as slowly as that allows. */
    constexpr double       most_given = 3., growth = 0.01;
    constexpr unsigned int power = 4;

    /** How deep the closest point must be, as a multiple of what the mean is deeper, for the mean
     * to count alone. More slowly than the point goes deeper: a row keeps its weights. */
    constexpr double deep = 2.;

    /** Of the size of a face: on flat faces mean and closest point can be the same. */
    constexpr double round_off = 1e-10;

    template <typename Number>
    Number
    smooth_step(const Number &x, const double begin, const double end)
    {
      if (x <= begin)
        return Number(0.);
      if (x >= end)
        return Number(1.);
      const Number t = (x - begin) / (end - begin);
      return t * t * (3. - 2. * t);
    }

    /** beta_i and w_k. */
    template <typename Number>
    struct Division
    {
      std::array<Number, Face::max_nodes> keep, take;

      Division(const unsigned int                         n,
               const std::array<Number, Face::max_nodes> &covered,
               const std::array<double, Face::max_nodes> &whole,
               const bool                                 gradual)
      {
        Number sum = 0., squares = 0., receivers = 0.;
        for (unsigned int i = 0; i < n; ++i)
          if (whole[i] > 0.)
            {
              sum += covered[i];
              squares += covered[i] * covered[i] / whole[i];
            }
        for (unsigned int i = 0; i < n; ++i)
          {
            // Of a function that hangs and is as much negative as positive.
            const Number cover =
              whole[i] > 0. ? Number(covered[i] / whole[i] * sum / squares) : Number(1.);
            keep[i] = gradual ? smooth_step(cover, weak, strong)
                              : Number(cover < 0.5 * (weak + strong) ? 0. : 1.);
            take[i] = smooth_step(cover, strong, 1.) * covered[i];
            receivers += take[i];
          }
        for (unsigned int k = 0; k < n; ++k)
          take[k] /= receivers;
      }
    };
  } // namespace



  std::array<double, Face::max_nodes>
  whole_areas(const Face &face, const TraceBasis *basis, const bool reference)
  {
    static const QGauss<2>              quadrature(3);
    std::array<double, Face::max_nodes> result{};
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      {
        const FaceShapes shapes(
          face.degree, {{2. * quadrature.point(q)[0] - 1., 2. * quadrature.point(q)[1] - 1.}});
        Tensor<1, dim> t[2];
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          {
            Tensor<1, dim> x = face.reference[m];
            if (!reference)
              x += face.displacement[m];
            for (unsigned int a = 0; a < 2; ++a)
              t[a] += shapes.gradient[m][a] * x;
          }
        const double weight = 4. * quadrature.weight(q) * cross_product_3d(t[0], t[1]).norm();
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          result[m] += weight * shapes.value[m];
      }
    return basis ? basis->apply(result) : result;
  }



  CoverShares::CoverShares(const unsigned int                         n,
                           const std::array<double, Face::max_nodes> &covered,
                           const std::array<double, Face::max_nodes> &whole,
                           const bool                                 gradual,
                           const bool                                 with_derivative)
  {
    const Division<double> division(n, covered, whole, gradual);
    partial = std::any_of(division.keep.begin(), division.keep.begin() + n, [](const double beta) {
      return beta != 1.;
    });
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int i = 0; i < n; ++i)
        {
          share[k][i] = (1. - division.keep[i]) * division.take[k] * covered[i] +
                        (k == i ? division.keep[i] * covered[i] : 0.);
          if (with_derivative)
            for (unsigned int l = 0; l < n; ++l)
              derivative[k][i][l] = (k == i && i == l);
        }
    if (!with_derivative || !partial)
      return;

    using Number = Sacado::Fad::SFad<double, int(Face::max_nodes)>;
    std::array<Number, Face::max_nodes> a;
    for (unsigned int i = 0; i < n; ++i)
      a[i] = Number(int(Face::max_nodes), int(i), covered[i]);
    const Division<Number> differentiated(n, a, whole, gradual);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int i = 0; i < n; ++i)
        {
          Number value = (1. - differentiated.keep[i]) * differentiated.take[k] * a[i];
          if (k == i)
            value += differentiated.keep[i] * a[i];
          for (unsigned int l = 0; l < n; ++l)
            derivative[k][i][l] = value.dx(l);
        }
  }



  FullMatrix<double>
  CoverShares::weights(FullMatrix<double> &mass) const
  {
    // On a sliver the mass matrix is singular to working precision. What is added to the diagonal
    // is taken out again of the weights, and not of the inverse: those of nodes that take the
    // shares of others are moderate and leave small residuals, however thin the sliver.
    const unsigned int       n = mass.m();
    const FullMatrix<double> original(mass);
    const double             addition = 1e-14 * mass.trace();
    for (unsigned int i = 0; i < n; ++i)
      mass(i, i) += addition;
    mass.gauss_jordan();
    FullMatrix<double> result(n, n), rest(n, n);
    for (unsigned int step = 0; step < 4; ++step)
      {
        result.mmult(rest, original);
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int i = 0; i < n; ++i)
            rest(k, i) = share[k][i] - rest(k, i);
        rest.mmult(result, mass, /*adding=*/true);
      }
    return result;
  }



  bool
  CoverSums::suffices(const double whole) const
  {
    return kept >= 1e-6 * whole && most_given * kept >= given && normal.norm_square() > 0.;
  }



  GapCorrection::GapCorrection(const CoverSums &sums, const double mean, const double size)
  {
    // Of what the closest point is beyond the mean; less of it the deeper that point is, so that
    // where surfaces are pressed together means count.
    const double d = sums.least - mean;
    value = by_mean = by_least = 0.;
    if (d > round_off * size)
      {
        const double depth    = std::max(-sums.least / d, 0.);
        const double part     = 1. - smooth_step(depth, 0., deep);
        const double t        = std::min(depth / deep, 1.);
        const double by_depth = -6. * t * (1. - t) / deep;
        value                 = part * d;
        by_mean               = -(part - depth * by_depth);
        by_least              = -by_mean - (sums.least < 0. ? by_depth : 0.);
      }
    const double ratio = std::max(sums.given / sums.kept, 0.);
    const double steep = growth * size * power * std::pow(ratio, power - 1) / sums.kept;
    value += growth * size * std::pow(ratio, power);
    by_given = steep;
    by_kept  = -steep * ratio;
  }
} // namespace Touchstone
