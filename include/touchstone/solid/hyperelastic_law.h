#ifndef touchstone_solid_hyperelastic_law_h
#define touchstone_solid_hyperelastic_law_h

#include <touchstone/solid/material_law.h>

namespace Touchstone
{
  /**
   * @brief A material law at finite strain: a strain energy density W of the
   * deformation gradient F = I + grad u, with its derivatives.
   *
   * All gradients are with respect to reference coordinates, all energies and
   * stresses per reference volume and area. W must depend on F through F^T F
   * alone (objectivity), and det F > 0 may be assumed.
   */
  class HyperelasticLaw : public MaterialLaw
  {
  public:
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

    /** @brief All of them by what is demanded. */
    void
    respond(const MaterialInput &input,
            Demand               demand,
            MaterialResponse    &response,
            double              *present) const final;
  };

  /** @brief The laws by the name that the key "Law" of a material takes. */
  using HyperelasticRegistry = Registry<HyperelasticLaw>;

  /** @brief The law called @p name with the constants of @p material, ready for use. */
  std::shared_ptr<const HyperelasticLaw>
  make_hyperelastic_law(const std::string &name, const MaterialParameters &material);
} // namespace Touchstone

#endif
