// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/patch_polynomials.h>

// Polynomials around vertices for recovered stresses (doc/theory.md 11).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The directions of the quadratic monomials, in their order after 1, x, y, z. */
    constexpr std::array<std::array<unsigned int, 2>, 6> two_directions = {
      {{{0, 0}}, {{1, 1}}, {{2, 2}}, {{0, 1}}, {{1, 2}}, {{2, 0}}}};
  } // namespace



  PatchPolynomials::PatchPolynomials(const unsigned int degree)
    : n(degree == 1 ? 1 + dim : 1 + dim + two_directions.size())
    , degree(degree)
  {
    Assert(degree == 1 || degree == 2, ExcNotImplemented());
  }



  std::vector<double>
  PatchPolynomials::monomials(const Tensor<1, dim> &d) const
  {
    std::vector<double> result(n);
    result[0] = 1.;
    for (unsigned int i = 0; i < dim; ++i)
      result[1 + i] = d[i];
    for (unsigned int k = 1 + dim; k < n; ++k)
      result[k] = d[two_directions[k - 1 - dim][0]] * d[two_directions[k - 1 - dim][1]];
    return result;
  }



  FullMatrix<double>
  PatchPolynomials::affine_map(const Tensor<2, dim> &B, const Tensor<1, dim> &delta) const
  {
    FullMatrix<double> T(n, n);
    T(0, 0) = 1.;
    for (unsigned int i = 0; i < dim; ++i)
      {
        T(1 + i, 0) = delta[i];
        for (unsigned int j = 0; j < dim; ++j)
          T(1 + i, 1 + j) = B[i][j];
      }
    for (unsigned int k = 1 + dim; k < n; ++k)
      {
        const auto &[i, j] = two_directions[k - 1 - dim];
        T(k, 0)            = delta[i] * delta[j];
        for (unsigned int l = 0; l < dim; ++l)
          T(k, 1 + l) = delta[i] * B[j][l] + delta[j] * B[i][l];
        for (unsigned int m = 1 + dim; m < n; ++m)
          {
            const auto &[p, q] = two_directions[m - 1 - dim];
            T(k, m)            = B[i][p] * B[j][q] + (p == q ? 0. : B[i][q] * B[j][p]);
          }
      }
    return T;
  }



  FullMatrix<double>
  PatchPolynomials::least_squares(const FullMatrix<double>    &M,
                                  const Tensor<2, dim>        &frame,
                                  const std::array<bool, dim> &fitted) const
  {
    const FullMatrix<double>  T = affine_map(frame, Tensor<1, dim>());
    std::vector<unsigned int> taken;
    // 1, and of degree 2 the linear and mixed monomials too, are taken in any case.
    const unsigned int first_power = degree == 1 ? 1 : 1 + dim;
    for (unsigned int k = 0; k < n; ++k)
      if (k < first_power || k >= first_power + dim || fitted[k - first_power])
        taken.push_back(k);
    // With T_S the rows taken, the fit is T_S^T (T_S M T_S^T)^-1 T_S.
    FullMatrix<double> rows(taken.size(), n), product(taken.size(), n),
      small(taken.size(), taken.size()), result(n, n);
    for (unsigned int k = 0; k < taken.size(); ++k)
      for (unsigned int m = 0; m < n; ++m)
        rows(k, m) = T(taken[k], m);
    rows.mmult(product, M);
    product.mTmult(small, rows);
    small.gauss_jordan();
    small.mmult(product, rows);
    rows.Tmmult(result, product);
    return result;
  }
} // namespace Touchstone
