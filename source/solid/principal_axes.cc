// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/principal_axes.h>

#include <algorithm>
#include <cmath>

// W. M. Scherzinger, C. R. Dohrmann (2008): A robust algorithm for finding the eigenvalues and
// eigenvectors of 3 x 3 symmetric matrices, Comput. Methods Appl. Mech. Engng 197, 4007-4015.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Vector3 = Tensor<1, dim>;

    /** The eigenvalue of the deviator @p A that is farthest from the other two, by Cardano's
     * formula. @p scale is sqrt(J2 / 3). */
    double
    distinct_eigenvalue(const SymmetricTensor<2, dim> &A, const double scale)
    {
      const double cosine = 0.5 * determinant(A / scale);
      const double angle  = std::acos(std::min(1., std::abs(cosine))) / 3.;
      return std::copysign(2. * scale * std::cos(angle), cosine);
    }

    /** Two orthonormal vectors in the plane of the columns of the singular, symmetric @p B. */
    std::array<Vector3, 2>
    plane_of_columns(const Tensor<2, dim> &B)
    {
      unsigned int longest = 0;
      for (unsigned int i = 1; i < dim; ++i)
        if (B[i].norm_square() > B[longest].norm_square())
          longest = i;
      const double  length = B[longest].norm();
      const Vector3 first  = B[longest] / length;
      Vector3       second;
      for (unsigned int k = 1; k < dim; ++k)
        {
          const Vector3 &column = B[(longest + k) % dim];
          const Vector3  rest   = column - (first * column) * first;
          if (rest.norm_square() > second.norm_square())
            second = rest;
        }
      // Where the eigenvalues differ by round-off alone all columns can be parallel: then any
      // vector across them will do.
      if (!(second.norm() > 1e-14 * length))
        {
          unsigned int across = 0;
          for (unsigned int i = 1; i < dim; ++i)
            if (std::abs(first[i]) < std::abs(first[across]))
              across = i;
          second         = Vector3();
          second[across] = 1.;
        }
      // A second time, against the round-off that a short rest has of the first.
      second /= second.norm();
      second -= (first * second) * first;
      return {{first, second / second.norm()}};
    }
  } // namespace



  PrincipalAxes::PrincipalAxes(const SymmetricTensor<2, dim> &A)
  {
    const double            mean  = trace(A) / 3.;
    SymmetricTensor<2, dim> rest  = A;
    double                  shear = 0.;
    for (unsigned int i = 0; i < dim; ++i)
      {
        rest[i][i] -= mean;
        for (unsigned int j = 0; j < i; ++j)
          shear += A[i][j] * A[i][j];
      }
    // Diagonal, but for what is too small to be squared.
    if (shear == 0.)
      {
        for (unsigned int i = 0; i < dim; ++i)
          {
            value[i]   = A[i][i];
            axes[i][i] = 1.;
          }
        return;
      }

    Tensor<2, dim> B(rest);
    const double   farthest = distinct_eigenvalue(rest, rest.norm() / std::sqrt(6.));
    for (unsigned int i = 0; i < dim; ++i)
      B[i][i] -= farthest;
    const std::array<Vector3, 2> s = plane_of_columns(B);
    const Vector3                v = cross_product_3d(s[0], s[1]);

    // The other two by one rotation in the plane.
    const Vector3 image    = rest * s[1];
    const double  a        = s[0] * (rest * s[0]);
    const double  b        = s[1] * image;
    const double  c        = s[0] * image;
    const double  half     = 0.5 * (b - a);
    const double  distance = std::sqrt(half * half + c * c);
    const double  tangent  = distance > 0. ? c / (half + std::copysign(distance, half)) : 0.;
    const double  cosine = 1. / std::sqrt(1. + tangent * tangent), sine = tangent * cosine;
    value = {{mean + v * (rest * v), mean + a - tangent * c, mean + b + tangent * c}};
    for (unsigned int i = 0; i < dim; ++i)
      {
        axes[i][0] = v[i];
        axes[i][1] = cosine * s[0][i] - sine * s[1][i];
        axes[i][2] = sine * s[0][i] + cosine * s[1][i];
      }
  }
} // namespace Touchstone
