// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_collision_bernstein_h
#define touchstone_collision_bernstein_h

#include <touchstone/base/types.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>

namespace Touchstone
{
  /**
   * @brief A polynomial on an interval of time by its coefficients for Bernstein's polynomials:
   * its values there lie between the smallest and the largest of them (Farouki 2012, "The Bernstein
   * polynomial basis: a centennial retrospective").
   *
   * @tparam T Number or vector.
   */
  template <unsigned int degree, class T = double>
  struct Bernstein
  {
    /** @brief The first is the value at the start, the last at the end. */
    std::array<T, degree + 1> coefficients;

    /** @brief A lower bound on the interval. */
    double
    lowest() const
    {
      return *std::min_element(coefficients.begin(), coefficients.end());
    }

    /** @brief An upper bound on the interval. */
    double
    highest() const
    {
      return *std::max_element(coefficients.begin(), coefficients.end());
    }

    Bernstein
    operator-(const Bernstein &other) const
    {
      Bernstein result;
      for (unsigned int i = 0; i <= degree; ++i)
        result.coefficients[i] = coefficients[i] - other.coefficients[i];
      return result;
    }
  };

  /** @brief n over k. */
  constexpr double
  binomial(const unsigned int n, const unsigned int k)
  {
    double result = 1.;
    for (unsigned int i = 0; i < k; ++i)
      result = result * (n - i) / (i + 1);
    return result;
  }

  /** @brief The polynomial of products of values. Its coefficients are means of products of
   * coefficients, with weights of sum 1: no error is larger than that of the largest product. */
  template <unsigned int m, unsigned int n, class T, class Product>
  auto
  multiply(const Bernstein<m, T> &a, const Bernstein<n, T> &b, const Product &product)
  {
    Bernstein<m + n, decltype(product(a.coefficients[0], b.coefficients[0]))> result{};
    for (unsigned int i = 0; i <= m; ++i)
      for (unsigned int j = 0; j <= n; ++j)
        result.coefficients[i + j] += (binomial(m, i) * binomial(n, j) / binomial(m + n, i + j)) *
                                      product(a.coefficients[i], b.coefficients[j]);
    return result;
  }

  /** @brief Scalar product. */
  template <unsigned int m, unsigned int n>
  Bernstein<m + n>
  dot(const Bernstein<m, dealii::Tensor<1, dim>> &a, const Bernstein<n, dealii::Tensor<1, dim>> &b)
  {
    return multiply(a, b, [](const auto &x, const auto &y) { return double(x * y); });
  }

  /** @brief Cross product. */
  template <unsigned int m, unsigned int n>
  Bernstein<m + n, dealii::Tensor<1, dim>>
  cross(const Bernstein<m, dealii::Tensor<1, dim>> &a,
        const Bernstein<n, dealii::Tensor<1, dim>> &b)
  {
    return multiply(a, b, [](const auto &x, const auto &y) { return cross_product_3d(x, y); });
  }
} // namespace Touchstone

#endif
