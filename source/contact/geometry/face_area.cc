// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_area.h>

#include <deal.II/base/quadrature_lib.h>

// Areas of faces and of their nodes, int N_m, with derivatives: the measure of which part of a face
// is covered (doc/theory.md 3.1), and the tributary areas by which forces become tractions.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Quadrature points of a face: weight, shape functions and tangents to @p visit. */
    template <class Visit>
    void
    for_each_face_point(const Face &face, const bool reference, const Visit &visit)
    {
      // |t_1 x t_2| is no polynomial on warped faces; three points per direction integrate it with
      // a shape function exactly on flat parallelograms of degree 1 and 2.
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
          // The rule is for [0,1]^2, face coordinates are in [-1,1]^2.
          visit(4. * quadrature.weight(q), shapes, t);
        }
    }
  } // namespace



  double
  face_area(const Face &face)
  {
    double sum = 0.;
    for_each_face_point(face, false, [&](const double w, const FaceShapes &, const auto &t) {
      // In the present state.
      sum += w * cross_product_3d(t[0], t[1]).norm();
    });
    return sum;
  }



  Tensor<1, dim>
  area_vector(const Face &face)
  {
    Tensor<1, dim> sum;
    for_each_face_point(face, false, [&](const double w, const FaceShapes &, const auto &t) {
      sum += w * cross_product_3d(t[0], t[1]);
    });
    return sum;
  }



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
    // Integrals of N~ = C^T N are C^T times those of N (doc/theory.md 11).
    return basis ? basis->apply(result) : result;
  }



  std::array<std::array<std::array<double, Face::max_nodes>, dim>, Face::max_nodes>
  whole_area_derivatives(const Face &face, const TraceBasis *basis)
  {
    std::array<std::array<std::array<double, Face::max_nodes>, dim>, Face::max_nodes> result{};
    for_each_face_point(face, false, [&](const double w, const FaceShapes &shapes, const auto &t) {
      // d|c| = n . (dt_1 x t_2 + t_1 x dt_2) = dt_1 . (t_2 x n) + dt_2 . (n x t_1), n = c/|c|.
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
} // namespace Touchstone
