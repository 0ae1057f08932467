#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/contact/pairing/partial_cover.h>

#include <deal.II/base/quadrature_lib.h>

#include <Sacado.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Of the mean cover of a face: a node that has less than `weak` leaves its row to
     * others, with `strong` it keeps it. Two thirds of a face covered give 0.6 to nodes beyond. */
    constexpr double weak = 0.2, strong = 0.6;

    /** What a node may give away per area that it keeps until it has no row, and by which part of
     * a face its gap grows where it gives as much as it keeps. It grows with the fourth power
     * of the ratio of both: gaps of 1e-5 and 0.1 of a face alike then open the row while the
     * edge goes a good part of a face. */
    constexpr double most_given = 3., growth = 0.01;

    /** How deep the node must be, if it is the closest point, as a multiple of what the mean is
     * deeper, for the mean to count alone. By how much of the same length another point must be
     * closer to count as another point; and how far that must be open for the row not to be
     * closer, of the size of a face. */
    constexpr double deep = 2., elsewhere = 0.5, hardly_open = 1e-4, open = 1e-2;

    /** Cosines of the angles between the surfaces from which on less than all and nothing of
     * the area counts, and one at which it is clear from the averaged normal that all does. */
    constexpr double inclined = 0.7, steep = 0.3, hardly_inclined = 0.85;

    /** The tangents at the centre of a face, and their product. */
    struct CentreTangents
    {
      FaceShapes     shapes;
      Tensor<1, dim> t[2], product;

      explicit CentreTangents(const Face &face)
        : shapes(face.degree, {{0., 0.}})
      {
        Tensor<1, dim> outward;
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          {
            outward += face.normals[m];
            for (unsigned int a = 0; a < 2; ++a)
              t[a] += shapes.gradient[m][a] * (face.reference[m] + face.displacement[m]);
          }
        product = cross_product_3d(t[0], t[1]);
        if (product * outward < 0.)
          {
            std::swap(t[0], t[1]);
            product *= -1.;
            for (unsigned int m = 0; m < face.n_nodes(); ++m)
              std::swap(shapes.gradient[m][0], shapes.gradient[m][1]);
          }
      }
    };

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



  namespace
  {
    /** Quadrature points of a face: weight, shape functions and tangents to @p visit. */
    template <class Visit>
    void
    for_each_point(const Face &face, const bool reference, const Visit &visit)
    {
      static const QGauss<2> quadrature(3);
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const FaceShapes shapes(
            face.degree, {{2. * quadrature.point(q)[0] - 1., 2. * quadrature.point(q)[1] - 1.}});
          std::array<Tensor<1, dim>, 2> t;
          for (unsigned int m = 0; m < face.n_nodes(); ++m)
            {
              Tensor<1, dim> x = face.reference[m];
              if (!reference)
                x += face.displacement[m];
              for (unsigned int a = 0; a < 2; ++a)
                t[a] += shapes.gradient[m][a] * x;
            }
          visit(4. * quadrature.weight(q), shapes, t);
        }
    }
  } // namespace



  std::array<double, Face::max_nodes>
  whole_areas(const Face &face, const TraceBasis *basis, const bool reference)
  {
    std::array<double, Face::max_nodes> result{};
    for_each_point(face, reference, [&](const double w, const FaceShapes &shapes, const auto &t) {
      const double weight = w * cross_product_3d(t[0], t[1]).norm();
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        result[m] += weight * shapes.value[m];
    });
    return basis ? basis->apply(result) : result;
  }



  Tensor<1, dim>
  plane_normal(const Face &face)
  {
    const Tensor<1, dim> product = CentreTangents(face).product;
    return product / product.norm();
  }



  std::array<Tensor<2, dim>, Face::max_nodes>
  plane_normal_derivatives(const Face &face)
  {
    const CentreTangents                        centre(face);
    const Tensor<2, dim>                        unit = normalisation_derivative(centre.product);
    std::array<Tensor<2, dim>, Face::max_nodes> result;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      result[m] = unit * (centre.shapes.gradient[m][1] * cross_matrix(centre.t[0]) -
                          centre.shapes.gradient[m][0] * cross_matrix(centre.t[1]));
    return result;
  }



  std::array<std::array<std::array<double, Face::max_nodes>, dim>, Face::max_nodes>
  whole_area_derivatives(const Face &face, const TraceBasis *basis)
  {
    std::array<std::array<std::array<double, Face::max_nodes>, dim>, Face::max_nodes> result{};
    for_each_point(face, false, [&](const double w, const FaceShapes &shapes, const auto &t) {
      const Tensor<1, dim> cross     = cross_product_3d(t[0], t[1]);
      const Tensor<1, dim> normal    = cross / cross.norm();
      const Tensor<1, dim> by_first  = cross_product_3d(t[1], normal),
                           by_second = cross_product_3d(normal, t[0]);
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        for (unsigned int e = 0; e < dim; ++e)
          for (unsigned int k = 0; k < face.n_nodes(); ++k)
            result[m][e][k] +=
              w * shapes.value[k] *
              (shapes.gradient[m][0] * by_first[e] + shapes.gradient[m][1] * by_second[e]);
    });
    if (basis)
      for (auto &of_node : result)
        for (auto &of_component : of_node)
          of_component = basis->apply(of_component);
    return result;
  }



  FacingPart::FacingPart(const double cosine)
  {
    using Number = Sacado::Fad::SFad<double, 1>;
    const Number part(smooth_step(Number(1, 0, cosine), steep, inclined));
    value     = part.val();
    by_cosine = part.dx(0);
  }



  double
  facing_cosine(const Tensor<1, dim>        &plane,
                const Tensor<1, dim>        &normal,
                const Face                  &master,
                const AnalyticSurface       *exact,
                const std::array<double, 2> &xi)
  {
    if (const double cosine = -(plane * normal); cosine > hardly_inclined)
      return cosine;
    const FacePoint      point   = evaluate(master, exact, xi);
    const Tensor<1, dim> product = cross_product_3d(point.tangents[0], point.tangents[1]);
    return (product * normal < 0. ? 1. : -1.) * (plane * product) / product.norm();
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
    using Number         = Sacado::Fad::SFad<double, 5>;
    const double covered = sums.own < std::numeric_limits<double>::max() ? 1. : 0.;
    const Number at_mean = Number(5, 0, mean), least(5, 1, sums.least), kept(5, 3, sums.kept),
                 given   = Number(5, 4, sums.given);
    const Number own     = covered > 0. ? Number(5, 2, sums.own) : Number(sums.least + 1e10 * size);
    const Number difference = least - at_mean;
    Number       result     = 0.;
    if (difference > round_off * size)
      {
        const Number other = smooth_step(Number((own - least) / difference), 0., elsewhere);
        Number       part  = 1. - other;
        if (least < 0.)
          part *= 1. - smooth_step(Number(-least / difference), 0., deep);
        else
          part += other * smooth_step(Number(least / size), hardly_open, open);
        result = part * difference;
      }
    if (given > 0.)
      {
        const Number ratio = given / kept;
        result += growth * size * ratio * ratio * ratio * ratio;
      }
    value    = result.val();
    by_mean  = result.dx(0);
    by_least = result.dx(1);
    by_own   = result.dx(2);
    by_kept  = result.dx(3);
    by_given = result.dx(4);
  }
} // namespace Touchstone
