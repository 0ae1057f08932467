// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_energy_law_h
#define touchstone_solid_energy_law_h

#include <touchstone/solid/cauchy_green_law.h>

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
  class EnergyLaw : public CauchyGreenLaw
  {
  protected:
    double
    value(const dealii::SymmetricTensor<2, dim> &C) const override
    {
      return evaluate_energy(density_of_law(), C);
    }

    EnergyDerivatives
    differentiate(const dealii::SymmetricTensor<2, dim> &C, const bool with_second) const override
    {
      return differentiate_energy(density_of_law(), C, with_second);
    }

  private:
    auto
    density_of_law() const
    {
      return [this](const auto &C) { return static_cast<const Law *>(this)->density(C); };
    }
  };
} // namespace Touchstone

#endif
