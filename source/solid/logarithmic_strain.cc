// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/logarithmic_strain.h>

#include <algorithm>
#include <cmath>

// Logarithmic strain E = 1/2 ln C and its first two derivatives by C, in the frame of the
// eigenvectors of C (doc/materials.md, "Finite strain"). There the derivatives are divided
// differences of 1/2 ln x over the eigenvalues, which stay finite where eigenvalues are equal;
// the usual formulas with 1/(b - a) do not.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** [ln b - ln a] / 2 over b - a, accurate for neighbours, too. */
    double
    first_difference(const double a, const double b)
    {
      const double x = (b - a) / a;
      return x == 0. ? 0.5 / a : 0.5 * std::log1p(x) / (x * a);
    }

    /** Divided difference of 1/2 ln x over three eigenvalues; symmetric in them, so they are
     * sorted first, and the denominator is the largest distance. */
    double
    second_difference(double a, double b, double c)
    {
      // The difference of two first ones would cancel between neighbours: there, the
      // Taylor series about the mean m. Its first omitted term is less than 1e-12 of the
      // whole.
      if (a > b)
        std::swap(a, b);
      if (b > c)
        std::swap(b, c);
      if (a > b)
        std::swap(a, b);
      const double m = (a + b + c) / 3.;
      if (c - a > 2e-3 * m)
        return (first_difference(b, c) - first_difference(a, b)) / (c - a);
      const double x = (a - m) / m, y = (b - m) / m, z = (c - m) / m;
      return (-0.25 - (x * x + y * y + z * z) / 16. + x * y * z / 10.) / (m * m);
    }

    /** The symmetric tensor with the given eigenvalues; the columns of @p frame are the
     * eigenvectors. */
    SymmetricTensor<2, dim>
    assemble(const std::array<double, dim> &value, const Tensor<2, dim> &frame)
    {
      SymmetricTensor<2, dim> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          for (unsigned int a = 0; a < dim; ++a)
            result[i][j] += value[a] * frame[i][a] * frame[j][a];
      return result;
    }
  } // namespace



  LogarithmicStrain::LogarithmicStrain(const SymmetricTensor<2, dim> &C)
    : principal(C)
  {
    const std::array<double, dim> &value = principal.value;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = a; b < dim; ++b)
        first[a][b] = first[b][a] = first_difference(value[a], value[b]);
  }



  SymmetricTensor<2, dim>
  LogarithmicStrain::strain() const
  {
    // Elastic strains of metals are small: ln(1 + x) keeps their digits.
    SymmetricTensor<2, dim> E;
    for (unsigned int a = 0; a < dim; ++a)
      E[a][a] = 0.5 * std::log1p(principal.value[a] - 1.);
    return E;
  }



  std::array<double, dim>
  LogarithmicStrain::inverse_stretch() const
  {
    std::array<double, dim> result;
    for (unsigned int a = 0; a < dim; ++a)
      result[a] = 1. / std::sqrt(principal.value[a]);
    return result;
  }



  SymmetricTensor<2, dim>
  LogarithmicStrain::conjugate_stress(const SymmetricTensor<2, dim> &T) const
  {
    SymmetricTensor<2, dim> S;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = a; b < dim; ++b)
        S[a][b] = 2. * first[a][b] * T[a][b];
    return S;
  }



  SymmetricTensor<4, dim>
  LogarithmicStrain::conjugate_tangent(const SymmetricTensor<2, dim> &T,
                                       const SymmetricTensor<4, dim> &D) const
  {
    const std::array<double, dim> &value = principal.value;
    SymmetricTensor<4, dim>        result;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = a; b < dim; ++b)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = c; d < dim; ++d)
            result[a][b][c][d] = 4. * first[a][b] * D[a][b][c][d] * first[c][d];

    // H : T : D2E : G = 2 sum_abc e[a,b,c] T_ab H_ac G_bc. An entry of the result for a pair of
    // different indices stands for both of their orders, so that each has half of the sum.
    const auto orders = [](const unsigned int i, const unsigned int j) { return i == j ? 1. : 2.; };
    double     second[dim][dim][dim];
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = a; b < dim; ++b)
        for (unsigned int c = b; c < dim; ++c)
          second[a][b][c] = second[a][c][b] = second[b][c][a] =
            second_difference(value[a], value[b], value[c]);
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = a; b < dim; ++b)
        for (unsigned int c = 0; c < dim; ++c)
          {
            const double share = 8. * second[a][b][c] * T[a][b] / (orders(a, c) * orders(b, c));
            result[a][c][b][c] += share;
            if (a != b)
              result[b][c][a][c] += share;
          }
    return result;
  }



  SymmetricTensor<2, dim>
  exponential(const SymmetricTensor<2, dim> &E)
  {
    PrincipalAxes principal(E);
    for (double &x : principal.value)
      x = std::exp(x);
    return assemble(principal.value, principal.axes);
  }
} // namespace Touchstone
