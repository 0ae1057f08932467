// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_material_parameters_h
#define touchstone_solid_material_parameters_h

#include <touchstone/base/choice.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>

namespace Touchstone
{
  class HardeningLaw;
  class HyperelasticLaw;
  class SmallStrainLaw;
  class FiniteStrainLaw;

  /** @brief Section "Body NAME/Material": the material of a body. */
  struct MaterialParameters
  {
    /** "linear elastic" (small strain) or the name of a HyperelasticLaw, a SmallStrainLaw
     * or a FiniteStrainLaw, whose constants are those of linear elasticity at the
     * undeformed state; keys of its own stand beside them. */
    Choice<Registry<HyperelasticLaw, const MaterialParameters &>,
           Registry<SmallStrainLaw, const MaterialParameters &>,
           Registry<FiniteStrainLaw, const MaterialParameters &>>
      law{"linear elastic"};
    /** Young's modulus, force per area; must be positive. */
    double young_modulus = 0.;
    /** Poisson's ratio, -1 < nu < 0.5. */
    double poisson_ratio = 0.3;
    /** Mass per volume; must be positive where there is inertia. */
    double density = 0.;
    /** Rayleigh damping C = a M + b K, with K at the undeformed state: a per
     * time, b time. */
    double rayleigh_mass = 0., rayleigh_stiffness = 0.;

    /** @name Subsection "Plasticity", of plastic laws only */
    /** @{ */
    /** The isotropic hardening, and that with its own parameters read; null if the law is
     * elastic. */
    Choice<Registry<HardeningLaw>> hardening_type{"none"};
    std::shared_ptr<HardeningLaw>  hardening;
    /** C of Armstrong and Frederick, force per area, 0 for none; and gamma, no unit, 0 for
     * linear kinematic hardening. */
    double kinematic_modulus = 0., kinematic_recovery = 0.;
    /** @} */

    /** @name Subsection "Thermal expansion" */
    /** @{ */
    /** Strain per temperature; and the temperature above that without strain, an expression in x,
     * y, z, t. */
    double      thermal_coefficient = 0.;
    std::string temperature;
    bool
    thermal() const
    {
      return thermal_coefficient != 0. && !temperature.empty();
    }
    /** @} */

    /** @brief The law is "linear elastic", and forces are products with a constant stiffness. */
    bool
    linear() const
    {
      return law.name == "linear elastic" && !thermal();
    }
    /** @brief Whether the law is for finite strain. */
    bool
    finite_strain() const;
    /** @brief mu, force per area. */
    double
    shear_modulus() const
    {
      return young_modulus / (2. * (1. + poisson_ratio));
    }
    /** @brief kappa, force per area. */
    double
    bulk_modulus() const
    {
      return young_modulus / (3. * (1. - 2. * poisson_ratio));
    }
    /** @brief Declare all entries.
     * @param values Of this section: law and hardening decide on other keys. */
    void
    declare(dealii::ParameterHandler &prm, const EarlyValues &values);
    /** @brief Set Young's modulus and, if it is no key, Poisson's ratio where the law has moduli of
     * its own. Call when all values are read. */
    void
    resolve();
    void
    check(const std::string &section) const;

  private:
    void
    declare_thermal_expansion(dealii::ParameterHandler &prm);
    void
    check_thermal_expansion(const std::string &section) const;
    void
    check_plasticity(const std::string &section) const;
  };
} // namespace Touchstone

#endif
