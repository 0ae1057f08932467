// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/expression.h>
#include <touchstone/base/input_error.h>
#include <touchstone/solid/hardening_law.h>
#include <touchstone/solid/hyperelastic_law.h>
#include <touchstone/solid/material_law.h>
#include <touchstone/solid/material_parameters.h>
#include <touchstone/solid/own_moduli.h>

#include <cmath>

// Keys of the section 'Material' of a body (doc/materials.md, "Keys"): elastic constants, density
// and damping for all laws, and the subsection 'Plasticity' for laws with plastic flow.
namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    /** Whether the law called @p name has plastic flow, which an instance of it tells. */
    bool
    has_plasticity(const std::string &name, const MaterialParameters &material)
    {
      return (SmallStrainRegistry::knows(name) &&
              SmallStrainRegistry::make(name, material)->plastic()) ||
             (FiniteStrainRegistry::knows(name) &&
              FiniteStrainRegistry::make(name, material)->plastic());
    }
  } // namespace



  bool
  MaterialParameters::finite_strain() const
  {
    // All laws that are neither linear nor registered for small strain are for finite strain.
    return law.name != "linear elastic" && !SmallStrainRegistry::knows(law.name);
  }



  void
  MaterialParameters::declare(ParameterHandler &prm, const EarlyValues &values)
  {
    law.declare_key(
      prm,
      values,
      "Law",
      "The material law. 'linear elastic': isotropic, for small strain and small rotations.",
      {"linear elastic"});
    const auto own = law.own_keys<OwnModuli>();
    if (!own)
      prm.add_parameter("Young modulus",
                        young_modulus,
                        "Young's modulus, greater than zero. Required. "
                        "[force per area]",
                        Patterns::Double(),
                        /*has_to_be_set=*/true);
    if (!own || own->keeps_poisson_ratio())
      prm.add_parameter("Poisson ratio",
                        poisson_ratio,
                        "Poisson's ratio, greater than -1 and less than 0.5. "
                        "[no unit]",
                        Patterns::Double());
    prm.add_parameter("Density",
                      density,
                      "Mass per volume, for inertia. [mass per volume]",
                      Patterns::Double(0.));
    prm.add_parameter("Rayleigh mass",
                      rayleigh_mass,
                      "Damping force per momentum. [1 / time]",
                      Patterns::Double(0.));
    prm.add_parameter("Rayleigh stiffness",
                      rayleigh_stiffness,
                      "Damping force per elastic force of the same velocity field, with the "
                      "stiffness of the undeformed body: it also resists finite rotations. [time]",
                      Patterns::Double(0.));
    // The subsection exists for plastic laws only, so that its keys are an error with an elastic
    // law.
    law.declare_own_keys(prm);
    declare_thermal_expansion(prm);
    if (!has_plasticity(law.chosen(), *this))
      return;
    prm.enter_subsection("Plasticity");
    hardening_type.declare_key(
      prm,
      values.in("Plasticity"),
      "Hardening",
      "Isotropic hardening: how the yield stress depends on the equivalent plastic strain p.");
    hardening_type.declare_own_keys(prm);
    hardening = hardening_type.make();
    prm.add_parameter("Kinematic modulus",
                      kinematic_modulus,
                      "Kinematic hardening, which may be added to the isotropic one: increase of "
                      "the uniaxial back stress per plastic strain, at least zero; 0 for none. "
                      "[force per area]",
                      Patterns::Double());
    prm.add_parameter("Kinematic recovery",
                      kinematic_recovery,
                      "Dynamic recovery of the back stress after Armstrong and Frederick, at "
                      "least zero: the uniaxial back stress tends to 'Kinematic modulus' over "
                      "this; 0 for linear kinematic hardening. [no unit]",
                      Patterns::Double());
    prm.leave_subsection();
  }



  void
  MaterialParameters::declare_thermal_expansion(ParameterHandler &prm)
  {
    prm.enter_subsection("Thermal expansion");
    prm.add_parameter("Coefficient",
                      thermal_coefficient,
                      "Strain per temperature, the same in all directions. [1 / temperature]",
                      Patterns::Double());
    prm.add_parameter("Temperature",
                      temperature,
                      "Temperature above that at which the material has no thermal strain, a "
                      "formula in x, y, z (reference coordinates) and t; empty: none. "
                      "[temperature]",
                      FormulaPattern());
    prm.leave_subsection();
  }



  void
  MaterialParameters::resolve()
  {
    const auto own = law.own_keys<OwnModuli>();
    if (!own)
      return;
    if (!own->keeps_poisson_ratio())
      poisson_ratio = 0.;
    young_modulus = 2. * (1. + poisson_ratio) * own->initial_shear_modulus();
  }



  void
  MaterialParameters::check_thermal_expansion(const std::string &section) const
  {
    if (!temperature.empty())
      check_expression(section, "Temperature", temperature, "x,y,z,t");
    if (!std::isfinite(thermal_coefficient))
      throw InputError(section,
                       "Coefficient",
                       Patterns::Tools::to_string(thermal_coefficient),
                       "is no number",
                       "give the strain per temperature, e.g. 1.2e-5 for steel");
    if (temperature.empty() != (thermal_coefficient == 0.))
      throw InputError(section,
                       temperature.empty() ? "Temperature" : "Coefficient",
                       temperature.empty() ? "" : Patterns::Tools::to_string(thermal_coefficient),
                       std::string("without it '") +
                         (temperature.empty() ? "Coefficient" : "Temperature") + "' has no effect",
                       "give both, or neither");
  }



  void
  MaterialParameters::check(const std::string &section) const
  {
    if (law.own_keys<OwnModuli>())
      law.check(section); // young_modulus follows from its constants
    check_thermal_expansion(section + "/Thermal expansion");
    if (young_modulus <= 0.)
      throw InputError(section,
                       "Young modulus",
                       Patterns::Tools::to_string(young_modulus),
                       "must be positive",
                       "give Young's modulus in the scene's unit of force per "
                       "area, e.g. 210000 for steel in N and mm");
    // Squares of forces must neither vanish nor overflow: with 1e-320 all residuals are zero, and
    // the first state would pass for an equilibrium.
    constexpr double smallest = 1e-100, largest = 1e100;
    if (!(young_modulus >= smallest && young_modulus <= largest))
      throw InputError(section,
                       "Young modulus",
                       Patterns::Tools::to_string(young_modulus),
                       "must be between 1e-100 and 1e100: forces could not be told from zero or "
                       "from infinity",
                       "choose units in which forces are not so small or large");
    if (poisson_ratio <= -1. || poisson_ratio >= 0.5)
      throw InputError(section,
                       "Poisson ratio",
                       Patterns::Tools::to_string(poisson_ratio),
                       "must be greater than -1 and less than 0.5",
                       std::string("for incompressible material take 0.4999 with the element '") +
                         (finite_strain() ? "F-bar" : "b-bar") + "' or degree 2");
    law.check(section);
    if (hardening)
      check_plasticity(section + "/Plasticity");
  }



  void
  MaterialParameters::check_plasticity(const std::string &section) const
  {
    hardening_type.check(section);
    if (!(kinematic_modulus >= 0.))
      throw InputError(section,
                       "Kinematic modulus",
                       Patterns::Tools::to_string(kinematic_modulus),
                       "must not be negative",
                       "give the increase of the back stress per plastic strain, or 0 for none");
    if (!(kinematic_recovery >= 0.))
      throw InputError(section,
                       "Kinematic recovery",
                       Patterns::Tools::to_string(kinematic_recovery),
                       "must not be negative",
                       "give 0 for linear kinematic hardening");
    if (kinematic_recovery > 0. && kinematic_modulus == 0.)
      throw InputError(section,
                       "Kinematic recovery",
                       Patterns::Tools::to_string(kinematic_recovery),
                       "has no effect while 'Kinematic modulus' is 0",
                       "set 'Kinematic modulus', or remove this key");
  }
} // namespace Touchstone
