// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/contact/geometry/facet_rotation.h>

#include <deal.II/base/symmetric_tensor.h>

// How a facet turns, and how this changes with its nodes (doc/theory.md 4, equation (8)).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The middle of a face. */
    constexpr std::array<double, 2> middle{{0., 0.}};

    /** Unit vectors along the tangents at the middle of a face, their sum and their difference:
     * these are perpendicular to each other. */
    struct Frame
    {
      std::array<Tensor<1, dim>, 2> tangents;
      Tensor<1, dim>                sum, difference;
      std::array<Tensor<1, dim>, 3> e;
      bool                          degenerate = true;

      explicit Frame(const std::array<Tensor<1, dim>, 2> &t)
        : tangents(t)
      {
        const double length[2] = {t[0].norm(), t[1].norm()};
        if (length[0] == 0. || length[1] == 0.)
          return;
        sum        = t[0] / length[0] + t[1] / length[1];
        difference = t[0] / length[0] - t[1] / length[1];
        degenerate = sum.norm() == 0. || difference.norm() == 0.;
        if (degenerate)
          return;
        e[0] = sum / sum.norm();
        e[1] = difference / difference.norm();
        e[2] = cross_product_3d(e[0], e[1]);
      }
    };

    /** Tangents of the facet at its middle, in the reference and in the present state. */
    void
    evaluate_tangents(const Face                    &face,
                      std::array<Tensor<1, dim>, 2> &reference,
                      std::array<Tensor<1, dim>, 2> &present)
    {
      const FaceShapes shapes(face.degree, middle);
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        for (unsigned int a = 0; a < 2; ++a)
          {
            reference[a] += shapes.gradient[m][a] * face.reference[m];
            present[a] += shapes.gradient[m][a] * face.position(m);
          }
    }
  } // namespace



  Tensor<2, dim>
  facet_rotation(const Face &face)
  {
    std::array<Tensor<1, dim>, 2> reference, present;
    evaluate_tangents(face, reference, present);
    const Frame from(reference), to(present);
    if (from.degenerate || to.degenerate)
      return Tensor<2, dim>(unit_symmetric_tensor<dim>());
    Tensor<2, dim> result;
    for (unsigned int i = 0; i < 3; ++i)
      result += outer_product(to.e[i], from.e[i]);
    return result;
  }



  NodeMatrices
  facet_rotation_derivative(const Face &face)
  {
    NodeMatrices                  result{};
    std::array<Tensor<1, dim>, 2> reference, present;
    evaluate_tangents(face, reference, present);
    const Frame frame(present);
    if (frame.degenerate || Frame(reference).degenerate)
      return result;
    // With de_i = w x e_i the rotation is w = e_3 (e_2 . de_1) - e_2 (e_3 . de_1) + e_1 (e_3 .
    // de_2).
    const auto          &e        = frame.e;
    const Tensor<2, dim> by_sum   = normalisation_derivative(frame.sum),
                         by_other = normalisation_derivative(frame.difference),
                         of_first =
                           outer_product(e[2], e[1] * by_sum) - outer_product(e[1], e[2] * by_sum),
                         of_second  = outer_product(e[0], e[2] * by_other),
                         by_unit[2] = {of_first + of_second, of_first - of_second};
    const FaceShapes shapes(face.degree, middle);
    for (unsigned int a = 0; a < 2; ++a)
      {
        const Tensor<2, dim> by_tangent = by_unit[a] * normalisation_derivative(frame.tangents[a]);
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          result[m] += shapes.gradient[m][a] * by_tangent;
      }
    return result;
  }



  std::array<Tensor<1, dim>, Face::max_nodes>
  relative_displacement(const Face &face, const Tensor<2, dim> &rotation)
  {
    std::array<Tensor<1, dim>, Face::max_nodes> result;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      result[m] = face.position(m) - rotation * face.reference[m];
    return result;
  }
} // namespace Touchstone
