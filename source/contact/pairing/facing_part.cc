// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/contact/pairing/facing_part.h>
#include <touchstone/contact/pairing/smooth_step.h>
#include <touchstone/contact/tolerances.h>

#include <Sacado.hpp>

// The factor by which area counts where slave and master surface are inclined to each other
// (doc/theory.md 3.2), and the plane of a slave face from which the inclination is measured.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The tangents at the centre of a face, and their vector product, which points outward. */
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
              t[a] += shapes.gradient[m][a] * face.position(m);
          }
        product = cross_product_3d(t[0], t[1]);
        // The order of the tangents is chosen such that their product points outward, as the
        // averaged normals of the nodes do.
        if (product * outward < 0.)
          {
            std::swap(t[0], t[1]);
            product *= -1.;
            for (unsigned int m = 0; m < face.n_nodes(); ++m)
              std::swap(shapes.gradient[m][0], shapes.gradient[m][1]);
          }
      }
    };
  } // namespace



  Tensor<1, dim>
  plane_normal(const Face &face)
  {
    const Tensor<1, dim> product = CentreTangents(face).product;
    return product / product.norm();
  }



  std::array<Tensor<2, dim>, Face::max_nodes>
  plane_normal_derivatives(const Face &face)
  {
    // d (t_0 x t_1) = t_0 x dt_1 - t_1 x dt_0 with dt_a = sum_m N_m,a dx_m.
    const CentreTangents                        centre(face);
    const Tensor<2, dim>                        unit = normalisation_derivative(centre.product);
    std::array<Tensor<2, dim>, Face::max_nodes> result;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      result[m] = unit * (centre.shapes.gradient[m][1] * cross_matrix(centre.t[0]) -
                          centre.shapes.gradient[m][0] * cross_matrix(centre.t[1]));
    return result;
  }



  FacingPart::FacingPart(const double cosine)
  {
    using Number = Sacado::Fad::SFad<double, 1>;
    // One forward derivative, by the cosine.
    const Number part(
      smooth_step(Number(1, 0, cosine), Tolerances::steep_cosine, Tolerances::inclined_cosine));
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
    // Averaged normals are at hand. Only where they are inclined clearly is the surface itself
    // evaluated, for the average may hide how steep a single face is.
    if (const double cosine = -(plane * normal); cosine > Tolerances::hardly_inclined_cosine)
      return cosine;
    const FacePoint      point   = evaluate(master, exact, xi);
    const Tensor<1, dim> product = cross_product_3d(point.tangents[0], point.tangents[1]);
    // The averaged normal tells which side is the outer one.
    return (product * normal < 0. ? 1. : -1.) * (plane * product) / product.norm();
  }
} // namespace Touchstone
