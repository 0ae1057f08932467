// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_hyperelastic_law_h
#define touchstone_solid_hyperelastic_law_h

#include <touchstone/base/registry.h>
#include <touchstone/base/types.h>

#include <deal.II/base/tensor.h>

namespace Touchstone
{
  struct MaterialParameters;

  /**
   * @brief A material law at finite strain: a strain energy density W of the
   * deformation gradient F = I + grad u, with its derivatives.
   *
   * All gradients are with respect to reference coordinates, all energies and
   * stresses per reference volume and area. W must depend on F through F^T F
   * alone (objectivity), and det F > 0 may be assumed.
   */
  class HyperelasticLaw
  {
  public:
    virtual ~HyperelasticLaw() = default;

    /** @brief Whether W is defined at F, det F > 0; a law whose chains have a limit says no beyond
     * it, and nothing else is called there. */
    virtual bool
    admits(const dealii::Tensor<2, dim> & /*F*/) const
    {
      return true;
    }

    /** @brief W(F), energy per reference volume; zero for F = I. */
    virtual double
    energy(const dealii::Tensor<2, dim> &F) const = 0;

    /** @brief First Piola-Kirchhoff stress P = dW/dF, P[i][J], force per reference
     * area. */
    virtual dealii::Tensor<2, dim>
    stress(const dealii::Tensor<2, dim> &F) const = 0;

    /** @brief A = dP/dF, A[i][J][k][L] = A[k][L][i][J], force per area. */
    virtual dealii::Tensor<4, dim>
    tangent(const dealii::Tensor<2, dim> &F) const = 0;
  };

  /** @brief The laws by the name that the key "Law" of a material takes. */
  using HyperelasticRegistry = Registry<HyperelasticLaw, const MaterialParameters &>;
} // namespace Touchstone

#endif
