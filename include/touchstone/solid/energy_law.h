// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_energy_law_h
#define touchstone_solid_energy_law_h

#include <touchstone/solid/energy_derivatives.h>
#include <touchstone/solid/hyperelastic_law.h>

namespace Touchstone
{
  /**
   * @brief A hyperelastic law that gives its energy and nothing else: stress and tangent come
   * from it by automatic differentiation.
   *
   * The law derives from EnergyLaw<Law> and has a public member
   * @code
   *   template <class Number>
   *   Number
   *   density(const SymmetricMatrix<Number> &C) const;
   * @endcode
   * the energy per reference volume as a function of C = F^T F, 0 for C = I. A function of C
   * is objective whatever it is. Mathematical functions are called without std::.
   */
  template <class Law>
  class EnergyLaw : public HyperelasticLaw
  {
  public:
    double
    energy(const dealii::Tensor<2, dim> &F) const override
    {
      return evaluate_energy(density_of_law(), right_cauchy_green(F));
    }

    dealii::Tensor<2, dim>
    stress(const dealii::Tensor<2, dim> &F) const override
    {
      // P = F S with S = 2 dW/dC
      return F * dealii::Tensor<2, dim>(
                   2. * differentiate_energy(density_of_law(), right_cauchy_green(F), false).first);
    }

    dealii::Tensor<4, dim>
    tangent(const dealii::Tensor<2, dim> &F) const override
    {
      // A_iJkL = delta_ik S_JL + F_iM D_MJNL F_kN with D = 4 d2W/dCdC
      const EnergyDerivatives W =
        differentiate_energy(density_of_law(), right_cauchy_green(F), true);
      dealii::Tensor<4, dim> left, A;
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

  private:
    auto
    density_of_law() const
    {
      return [this](const auto &C) { return static_cast<const Law *>(this)->density(C); };
    }

    static dealii::SymmetricTensor<2, dim>
    right_cauchy_green(const dealii::Tensor<2, dim> &F)
    {
      return dealii::symmetrize(dealii::transpose(F) * F);
    }
  };
} // namespace Touchstone

#endif
