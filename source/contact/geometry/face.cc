// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/facet_rotation.h>

#include <cmath>


// Shape functions of bilinear and biquadratic faces and the position on a face, on facets or on the
// exact surface (doc/theory.md 4, equation (8)). Everything that measures gaps evaluates faces here
// or in FaceGeometry.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Lagrange polynomials on equidistant points of [-1,1], and derivatives. */
    void
    lagrange(const unsigned int degree, const double x, double *value, double *derivative)
    {
      if (degree == 1)
        {
          value[0]      = 0.5 * (1. - x);
          value[1]      = 0.5 * (1. + x);
          derivative[0] = -0.5;
          derivative[1] = 0.5;
        }
      else
        {
          value[0]      = 0.5 * x * (x - 1.);
          value[1]      = (1. - x) * (1. + x);
          value[2]      = 0.5 * x * (x + 1.);
          derivative[0] = x - 0.5;
          derivative[1] = -2. * x;
          derivative[2] = x + 0.5;
        }
    }
  } // namespace



  FaceShapes::FaceShapes(const unsigned int degree, const std::array<double, 2> &xi)
  {
    // Searches and averages ask for millions of points, most of them on bilinear faces.
    if (degree == 1)
      {
        const double low[2]  = {0.5 * (1. - xi[0]), 0.5 * (1. - xi[1])},
                     high[2] = {0.5 * (1. + xi[0]), 0.5 * (1. + xi[1])};
        value[0]             = low[0] * low[1];
        value[1]             = high[0] * low[1];
        value[2]             = low[0] * high[1];
        value[3]             = high[0] * high[1];
        gradient[0]          = {{-0.5 * low[1], -0.5 * low[0]}};
        gradient[1]          = {{0.5 * low[1], -0.5 * high[0]}};
        gradient[2]          = {{-0.5 * high[1], 0.5 * low[0]}};
        gradient[3]          = {{0.5 * high[1], 0.5 * high[0]}};
        return;
      }
    // Tensor products of one-dimensional Lagrange polynomials, numbered with xi_1 first.
    double n[2][3], dn[2][3];
    for (unsigned int d = 0; d < 2; ++d)
      lagrange(degree, xi[d], n[d], dn[d]);
    for (unsigned int j = 0; j <= degree; ++j)
      for (unsigned int i = 0; i <= degree; ++i)
        {
          const unsigned int m = i + (degree + 1) * j;
          value[m]             = n[0][i] * n[1][j];
          gradient[m]          = {{dn[0][i] * n[1][j], n[0][i] * dn[1][j]}};
        }
  }



  std::array<std::array<double, 3>, Face::max_nodes>
  shape_hessians(const unsigned int degree, const std::array<double, 2> &xi)
  {
    // Second derivatives of the one-dimensional polynomials are constant: zero if linear, 1, -2, 1
    // if quadratic.
    double n[2][3], dn[2][3];
    for (unsigned int d = 0; d < 2; ++d)
      lagrange(degree, xi[d], n[d], dn[d]);
    const double                                       ddn[2][3] = {{0., 0., 0.}, {1., -2., 1.}};
    const double                                      *second    = ddn[degree - 1];
    std::array<std::array<double, 3>, Face::max_nodes> result{};
    for (unsigned int j = 0; j <= degree; ++j)
      for (unsigned int i = 0; i <= degree; ++i)
        result[i + (degree + 1) * j] = {
          {second[i] * n[1][j], dn[0][i] * dn[1][j], n[0][i] * second[j]}};
    return result;
  }



  std::array<double, 2>
  node_coordinates(const Face &face, const unsigned int m)
  {
    const unsigned int p = face.degree;
    // Lexicographic numbering of p + 1 equidistant nodes per direction.
    return {{2. * (m % (p + 1)) / p - 1., 2. * (m / (p + 1)) / p - 1.}};
  }



  Tensor<1, dim>
  reference_area_vector(const Face &face, const unsigned int m)
  {
    const double sign = (m == 0 || m == 3) ? 1. : -1.;
    return sign * cross_product_3d(face.reference[m ^ 1u] - face.reference[m],
                                   face.reference[m ^ 2u] - face.reference[m]);
  }



  bool
  at_end(const Face &face, const unsigned int m)
  {
    const std::array<double, 2> xi = node_coordinates(face, m);
    for (unsigned int a = 0; a < 2; ++a)
      if (std::abs(xi[a]) == 1. && (face.outer_edges & (1u << (2 * a + (xi[a] > 0. ? 1 : 0)))))
        return true;
    return false;
  }



  Tensor<1, dim>
  FacePoint::normal() const
  {
    const Tensor<1, dim> cross  = cross_product_3d(tangents[0], tangents[1]);
    const double         length = cross.norm();
    // A degenerate face has no normal: return zero instead of dividing by it.
    return length > 0. ? cross / length : cross;
  }



  FacePoint
  evaluate(const Face &face, const AnalyticSurface *exact, const std::array<double, 2> &xi)
  {
    return evaluate(face, exact, FaceShapes(face.degree, xi));
  }



  FacePoint
  evaluate(const Face &face, const AnalyticSurface *exact, const FaceShapes &shapes)
  {
    FacePoint result;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        result.x += shapes.value[m] * face.reference[m];
        for (unsigned int a = 0; a < 2; ++a)
          result.tangents[a] += shapes.gradient[m][a] * face.reference[m];
      }
    // x(xi) = R P(sum N_m X_m) + sum N_m (x_m - R X_m), equation (8): only the reference position
    // is projected onto the exact surface, the projection maps its tangents by grad P, and both
    // turn with the facet. What nodes have moved apart from that is added after it, without
    // projection.
    auto moved = face.displacement;
    if (exact)
      {
        const Tensor<2, dim> rotation = facet_rotation(face);
        result.x = Point<dim>(rotation * exact->project_with(result.x, result.tangents));
        for (Tensor<1, dim> &tangent : result.tangents)
          tangent = rotation * tangent;
        moved = relative_displacement(face, rotation);
      }
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        result.x += shapes.value[m] * moved[m];
        for (unsigned int a = 0; a < 2; ++a)
          result.tangents[a] += shapes.gradient[m][a] * moved[m];
      }
    return result;
  }



  Face
  at_start_of_step(const Face &face)
  {
    Face result         = face;
    result.displacement = face.committed;
    return result;
  }



  double
  reference_diagonal(const Face &face)
  {
    return face.reference[0].distance(face.reference[face.n_nodes() - 1]);
  }
} // namespace Touchstone
