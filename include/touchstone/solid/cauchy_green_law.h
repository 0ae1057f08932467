// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_cauchy_green_law_h
#define touchstone_solid_cauchy_green_law_h

#include <touchstone/solid/energy_derivatives.h>
#include <touchstone/solid/hyperelastic_law.h>

namespace Touchstone
{
  /** @brief A hyperelastic law whose energy is given as a function of C = F^T F, with its
   * derivatives: such a law is objective whatever the function is. */
  class CauchyGreenLaw : public HyperelasticLaw
  {
  public:
    double
    energy(const dealii::Tensor<2, dim> &F) const override
    {
      return value(right_cauchy_green(F));
    }

    dealii::Tensor<2, dim>
    stress(const dealii::Tensor<2, dim> &F) const override
    {
      // P = F S with S = 2 dW/dC
      return F * dealii::Tensor<2, dim>(2. * differentiate(right_cauchy_green(F), false).first);
    }

    dealii::Tensor<4, dim>
    tangent(const dealii::Tensor<2, dim> &F) const override
    {
      // A_iJkL = delta_ik S_JL + F_iM D_MJNL F_kN with D = 4 d2W/dCdC
      const EnergyDerivatives W = differentiate(right_cauchy_green(F), true);
      dealii::Tensor<4, dim>  left, A;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int J = 0; J < dim; ++J)
          for (unsigned int N = 0; N < dim; ++N)
            for (unsigned int L = 0; L < dim; ++L)
              for (unsigned int M = 0; M < dim; ++M)
                left[i][J][N][L] += 4. * F[i][M] * W.second[M][J][N][L];
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int J = 0; J < dim; ++J)
          for (unsigned int L = 0; L < dim; ++L)
            {
              for (unsigned int k = 0; k < dim; ++k)
                for (unsigned int N = 0; N < dim; ++N)
                  A[i][J][k][L] += left[i][J][N][L] * F[k][N];
              A[i][J][i][L] += 2. * W.first[J][L];
            }
      return A;
    }

  protected:
    /** @brief Energy per reference volume, 0 for C = I. */
    virtual double
    value(const dealii::SymmetricTensor<2, dim> &C) const = 0;

    /** @brief The first and, if @p with_second, second derivative of the energy. */
    virtual EnergyDerivatives
    differentiate(const dealii::SymmetricTensor<2, dim> &C, bool with_second) const = 0;

    static dealii::SymmetricTensor<2, dim>
    right_cauchy_green(const dealii::Tensor<2, dim> &F)
    {
      return dealii::symmetrize(dealii::transpose(F) * F);
    }
  };
} // namespace Touchstone

#endif
