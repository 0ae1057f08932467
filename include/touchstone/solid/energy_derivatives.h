// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_energy_derivatives_h
#define touchstone_solid_energy_derivatives_h

#include <touchstone/base/types.h>

#include <deal.II/base/symmetric_tensor.h>

#include <Sacado.hpp>
#include <array>

/**
 * @file
 * Stress and tangent of a material from its energy alone, by automatic differentiation: any
 * law can call differentiate_energy(), and a HyperelasticLaw can be made by EnergyLaw.
 */

namespace Touchstone
{
  /** @brief A symmetric 3 x 3 matrix of numbers that carry derivatives. */
  template <class Number>
  struct SymmetricMatrix
  {
    /** 11, 22, 33, 12, 13, 23. */
    std::array<Number, 6> components;

    const Number &
    operator()(const unsigned int i, const unsigned int j) const
    {
      return components[i == j ? i : i + j + 2];
    }
  };

  template <class Number>
  Number
  trace(const SymmetricMatrix<Number> &A)
  {
    return A(0, 0) + A(1, 1) + A(2, 2);
  }

  /** @brief tr(A A). */
  template <class Number>
  Number
  trace_of_square(const SymmetricMatrix<Number> &A)
  {
    return A(0, 0) * A(0, 0) + A(1, 1) * A(1, 1) + A(2, 2) * A(2, 2) +
           2. * (A(0, 1) * A(0, 1) + A(0, 2) * A(0, 2) + A(1, 2) * A(1, 2));
  }

  template <class Number>
  Number
  determinant(const SymmetricMatrix<Number> &A)
  {
    return A(0, 0) * (A(1, 1) * A(2, 2) - A(1, 2) * A(1, 2)) -
           A(0, 1) * (A(0, 1) * A(2, 2) - A(1, 2) * A(0, 2)) +
           A(0, 2) * (A(0, 1) * A(1, 2) - A(1, 1) * A(0, 2));
  }

  /** @brief A function of a symmetric tensor with its derivatives. */
  struct EnergyDerivatives
  {
    double                          value;
    dealii::SymmetricTensor<2, dim> first;
    dealii::SymmetricTensor<4, dim> second;
  };

  /** @brief The energy at @p tensor, without derivatives.
   * @param energy Called with a SymmetricMatrix of any number type, returns such a number. */
  template <class Energy>
  double
  evaluate_energy(const Energy &energy, const dealii::SymmetricTensor<2, dim> &tensor)
  {
    SymmetricMatrix<double> matrix;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        matrix.components[i == j ? i : i + j + 2] = tensor[i][j];
    return energy(matrix);
  }

  /** @brief The energy at @p tensor and its first and, if @p with_second, second derivative.
   * Off-diagonal components occur twice in the tensor and once among the variables: the
   * derivative by one of them is shared by both places.
   * @param energy As for evaluate_energy(). */
  template <class Energy>
  EnergyDerivatives
  differentiate_energy(const Energy                          &energy,
                       const dealii::SymmetricTensor<2, dim> &tensor,
                       const bool                             with_second)
  {
    constexpr unsigned int n         = 6;
    using First                      = Sacado::Fad::SFad<double, n>;
    using Second                     = Sacado::Fad::SFad<First, n>;
    static const unsigned int row[n] = {0, 1, 2, 0, 0, 1}, column[n] = {0, 1, 2, 1, 2, 2};

    EnergyDerivatives result;
    if (!with_second)
      {
        SymmetricMatrix<First> matrix;
        for (unsigned int a = 0; a < n; ++a)
          matrix.components[a] = First(n, a, tensor[row[a]][column[a]]);
        const First W = energy(matrix);
        result.value  = W.val();
        for (unsigned int a = 0; a < n; ++a)
          result.first[row[a]][column[a]] = (a < dim ? 1. : 0.5) * W.fastAccessDx(a);
        return result;
      }
    SymmetricMatrix<Second> matrix;
    for (unsigned int a = 0; a < n; ++a)
      matrix.components[a] = Second(n, a, First(n, a, tensor[row[a]][column[a]]));
    const Second W = energy(matrix);
    result.value   = W.val().val();
    for (unsigned int a = 0; a < n; ++a)
      {
        const double share              = a < dim ? 1. : 0.5;
        result.first[row[a]][column[a]] = share * W.val().fastAccessDx(a);
        for (unsigned int b = 0; b < n; ++b)
          result.second[row[a]][column[a]][row[b]][column[b]] =
            share * (b < dim ? 1. : 0.5) * W.fastAccessDx(a).fastAccessDx(b);
      }
    return result;
  }
} // namespace Touchstone

#endif
