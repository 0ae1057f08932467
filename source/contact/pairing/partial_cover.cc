#include <touchstone/contact/pairing/partial_cover.h>
#include <touchstone/contact/pairing/smooth_step.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/quadrature_lib.h>

#include <Sacado.hpp>
#include <algorithm>

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
            keep[i] = gradual ? smooth_step(cover, Tolerances::gives_all, Tolerances::keeps_all)
                              : Number(cover < Tolerances::keeps_if_at_once ? 0. : 1.);
            take[i] = smooth_step(cover, Tolerances::keeps_all, 1.) * covered[i];
            receivers += take[i];
          }
        for (unsigned int k = 0; k < n; ++k)
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



    /** Quadrature points of a face: weight, shape functions and tangents to @p visit. */
    template <class Visit>
    void
    for_each_face_point(const Face &face, const bool reference, const Visit &visit)
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
    for_each_face_point(face,
                        reference,
                        [&](const double w, const FaceShapes &shapes, const auto &t) {
                          const double weight = w * cross_product_3d(t[0], t[1]).norm();
                          for (unsigned int m = 0; m < face.n_nodes(); ++m)
                            result[m] += weight * shapes.value[m];
                        });
    return basis ? basis->apply(result) : result;
  }



  std::array<std::array<std::array<double, Face::max_nodes>, dim>, Face::max_nodes>
  whole_area_derivatives(const Face &face, const TraceBasis *basis)
  {
    std::array<std::array<std::array<double, Face::max_nodes>, dim>, Face::max_nodes> result{};
    for_each_face_point(face, false, [&](const double w, const FaceShapes &shapes, const auto &t) {
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
          share[k][i] = division.share(k, i, covered[i]);
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
          const Number value = differentiated.share(k, i, a[i]);
          for (unsigned int l = 0; l < n; ++l)
            derivative[k][i][l] = value.dx(l);
        }
  }
} // namespace Touchstone
