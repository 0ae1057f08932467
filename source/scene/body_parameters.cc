#include <touchstone/base/input_error.h>
#include <touchstone/mesh/geometry.h>
#include <touchstone/scene/body_parameters.h>
#include <touchstone/scene/expression.h>
#include <touchstone/solid/hardening_law.h>
#include <touchstone/solid/hyperelastic_law.h>
#include <touchstone/solid/material_law.h>

#include <algorithm>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  bool
  MaterialParameters::plastic() const
  {
    return SmallStrainRegistry::records().count(law) > 0 ||
           FiniteStrainRegistry::records().count(law) > 0;
  }



  bool
  MaterialParameters::finite_strain() const
  {
    return !linear() && SmallStrainRegistry::records().count(law) == 0;
  }



  void
  MaterialParameters::declare(ParameterHandler &prm)
  {
    // What the scene has chosen decides on other keys, but is not the default of its own.
    const MaterialParameters defaults;
    const bool               has_plasticity   = plastic();
    const std::string        chosen_hardening = hardening_name;
    law                                       = defaults.law;
    hardening_name                            = defaults.hardening_name;
    prm.add_parameter("Law",
                      law,
                      "The material law, always isotropic. 'linear elastic': small "
                      "strain and small rotations. " +
                        HyperelasticRegistry::documentation() + ' ' +
                        SmallStrainRegistry::documentation() + ' ' +
                        FiniteStrainRegistry::documentation(),
                      Patterns::Selection("linear elastic|" + HyperelasticRegistry::selection() +
                                          '|' + SmallStrainRegistry::selection() + '|' +
                                          FiniteStrainRegistry::selection()));
    prm.add_parameter("Young modulus",
                      young_modulus,
                      "Young's modulus, greater than zero. Required. "
                      "[force per area]",
                      Patterns::Double(),
                      /*has_to_be_set=*/true);
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
    if (!has_plasticity)
      return;
    prm.enter_subsection("Plasticity");
    prm.add_parameter("Hardening",
                      hardening_name,
                      "Isotropic hardening: how the yield stress depends on the equivalent plastic "
                      "strain p. " +
                        HardeningLawRegistry::documentation(),
                      Patterns::Selection(HardeningLawRegistry::selection()));
    if (HardeningLawRegistry::records().count(chosen_hardening) > 0)
      {
        hardening = HardeningLawRegistry::make(chosen_hardening);
        hardening->declare(prm);
      }
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
  MaterialParameters::check(const std::string &section) const
  {
    if (young_modulus <= 0.)
      throw InputError(section,
                       "Young modulus",
                       Patterns::Tools::to_string(young_modulus),
                       "must be positive",
                       "give Young's modulus in the scene's unit of force per "
                       "area, e.g. 210000 for steel in N and mm");
    if (poisson_ratio <= -1. || poisson_ratio >= 0.5)
      throw InputError(section,
                       "Poisson ratio",
                       Patterns::Tools::to_string(poisson_ratio),
                       "must be greater than -1 and less than 0.5",
                       std::string("for incompressible material take 0.4999 with the element '") +
                         (finite_strain() ? "F-bar" : "b-bar") + "' or degree 2");
    if (hardening)
      check_plasticity(section + "/Plasticity");
  }



  void
  MaterialParameters::check_plasticity(const std::string &section) const
  {
    hardening->check(section);
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



  void
  BoundaryParameters::declare(ParameterHandler &prm)
  {
    const std::string formula = " A formula in x, y, z (reference coordinates) and t (time); ";
    const auto        component =
      [&](const std::string &name, std::string &value, const std::string &what) {
        prm.add_parameter(name, value, what, Patterns::Anything());
      };
    const std::string moved = "component of the displacement." + formula + "empty: free. [length]";
    component("Displacement x", displacement_x, "Prescribed x " + moved);
    component("Displacement y", displacement_y, "Prescribed y " + moved);
    component("Displacement z", displacement_z, "Prescribed z " + moved);
    const std::string loaded = "component of the traction on the reference area." + formula +
                               "empty: none. [force per area]";
    component("Traction x", traction_x, "The x " + loaded);
    component("Traction y", traction_y, "The y " + loaded);
    component("Traction z", traction_z, "The z " + loaded);
    component("Pressure",
              pressure,
              "Pressure against the outward normal of the surface." + formula +
                "empty: none. [force per area]");
    prm.add_parameter("Pressure follows",
                      pressure_follows,
                      "'surface': the pressure acts on the deformed surface, along its present "
                      "normal; 'nothing': on the reference area along the normal there (a dead "
                      "load); 'automatic': on the deformed surface if the material has a law for "
                      "finite strain.",
                      Patterns::Selection("automatic|surface|nothing"));
  }



  std::vector<std::pair<std::string, std::string>>
  BoundaryParameters::formulas() const
  {
    return {{"Pressure", pressure},
            {"Displacement x", displacement_x},
            {"Displacement y", displacement_y},
            {"Displacement z", displacement_z},
            {"Traction x", traction_x},
            {"Traction y", traction_y},
            {"Traction z", traction_z}};
  }



  void
  BoundaryParameters::check(const std::string &section) const
  {
    const std::string *displacements[] = {&displacement_x, &displacement_y, &displacement_z};
    const std::string *tractions[]     = {&traction_x, &traction_y, &traction_z};
    bool               all_moved       = true;
    for (unsigned int d = 0; d < 3; ++d)
      {
        const std::string letter(1, "xyz"[d]);
        if (!displacements[d]->empty())
          check_expression(section, "Displacement " + letter, *displacements[d]);
        if (!tractions[d]->empty())
          check_expression(section, "Traction " + letter, *tractions[d]);
        if (!displacements[d]->empty() && !tractions[d]->empty())
          throw InputError(section,
                           "Traction " + letter,
                           *tractions[d],
                           "contradicts 'Displacement " + letter +
                             "', which moves the same component",
                           "prescribe either the displacement or the traction");
        all_moved = all_moved && !displacements[d]->empty();
      }
    if (!pressure.empty())
      check_expression(section, "Pressure", pressure);
    if (pressure.empty() && pressure_follows != "automatic")
      throw InputError(section,
                       "Pressure follows",
                       pressure_follows,
                       "there is no pressure on this boundary",
                       "remove the key, or set 'Pressure'");
    if (!pressure.empty() && all_moved)
      throw InputError(section,
                       "Pressure",
                       pressure,
                       "has no effect where all three displacements are prescribed",
                       "remove the pressure or one of the displacements");
  }



  std::string
  BodyParameters::section() const
  {
    return "Body " + name;
  }



  bool
  BodyParameters::supported() const
  {
    return !symmetry.empty() || !fixed.empty() ||
           std::any_of(boundaries.begin(), boundaries.end(), [](const auto &entry) {
             const BoundaryParameters &b = entry.second;
             return !(b.displacement_x + b.displacement_y + b.displacement_z).empty();
           });
  }



  ElementType
  BodyParameters::element() const
  {
    return element_name == "full"    ? ElementType::full
           : element_name == "b-bar" ? ElementType::b_bar
           : element_name == "F-bar" ? ElementType::f_bar
                                     : ElementType::incompatible_modes;
  }



  std::string
  BodyParameters::automatic_element(const unsigned int degree) const
  {
    return degree > 1                 ? "full"
           : material.finite_strain() ? "F-bar"
           : material.plastic()       ? "b-bar"
                                      : "incompatible modes";
  }



  void
  BodyParameters::declare(ParameterHandler &prm, const std::string &geometry_type)
  {
    prm.add_parameter("Element",
                      element_name,
                      "How cells interpolate strain: 'full' integration of the displacements' "
                      "gradient; 'b-bar' with a constant volume change per cell, for nearly "
                      "incompressible material; 'incompatible modes' for bending; 'F-bar' is "
                      "b-bar for finite strain. The latter three are for degree 1, b-bar for "
                      "material laws of small strain, incompatible modes for the law 'linear "
                      "elastic' only, F-bar for laws of finite strain. 'automatic' takes full "
                      "for degree 2; for degree 1 F-bar with a law for finite strain, b-bar with "
                      "plasticity at small strain (plastic flow keeps the volume, and full cells "
                      "lock), and else incompatible modes.",
                      Patterns::Selection("automatic|full|b-bar|incompatible modes|F-bar"));
    prm.add_parameter("Symmetry",
                      symmetry,
                      "Plane boundaries that keep their place in the normal "
                      "direction, by name or number.");
    prm.add_parameter("Fixed", fixed, "Boundaries that cannot move at all, by name or number.");
    for (unsigned int d = 0; d < 3; ++d)
      {
        const std::string letter(1, "xyz"[d]);
        const auto        formula =
          [&](const std::string &key, std::string &value, const std::string &what) {
            prm.add_parameter(key + " " + letter, value, what, Patterns::Anything());
          };
        formula("Initial velocity",
                initial_velocity[d],
                letter + " component of the velocity at time 0, a formula in x, y, z; empty: "
                         "zero. [length per time]");
        formula("Initial displacement",
                initial_displacement[d],
                letter + " component of the displacement that the body starts from, a formula in "
                         "x, y, z; empty: zero. [length]");
        formula("Body force",
                body_force[d],
                letter + " component of the force on the body, gravity for example, a formula in "
                         "x, y, z, t; empty: none. [force per reference volume]");
        formula("Reference displacement",
                reference_displacement[d],
                letter + " component of the displacement that the result is compared with if "
                         "'Reference solution/Type' is 'formula', a formula in x, y, z, t; empty: "
                         "not compared. [length]");
      }
    prm.add_parameter("Boundary conditions",
                      conditions,
                      "Boundaries, by name or number, that each have a subsection "
                      "'Boundary NAME' with displacements or loads.");

    prm.enter_subsection("Geometry");
    {
      geometry_name = geometry_type;
      geometry      = GeometryRegistry::make(geometry_type);
      prm.add_parameter("Type",
                        geometry_name,
                        "The shape of the body, which decides on the other keys "
                        "here. " +
                          GeometryRegistry::documentation(),
                        Patterns::Selection(GeometryRegistry::selection()));
      geometry->declare(prm);
    }
    prm.leave_subsection();

    prm.enter_subsection("Material");
    material.declare(prm);
    prm.leave_subsection();

    for (const std::string &boundary : conditions)
      {
        prm.enter_subsection("Boundary " + boundary);
        boundaries[boundary].declare(prm);
        prm.leave_subsection();
      }
  }



  void
  BodyParameters::check_element(const unsigned int degree) const
  {
    if (degree > 1 && element() != ElementType::full)
      throw InputError(section(),
                       "Element",
                       element_name,
                       "is made for degree 1, but 'Discretisation/Degree' is " +
                         std::to_string(degree),
                       "take the element 'automatic' or 'full', or degree 1");
    const ElementType type = element();
    const bool small_only  = type == ElementType::b_bar || type == ElementType::incompatible_modes;
    if (type == ElementType::incompatible_modes && material.plastic() && !material.finite_strain())
      throw InputError(section(),
                       "Element",
                       element_name,
                       "has no plasticity, but 'Material/Law' is '" + material.law + "'",
                       "take the element 'automatic' or 'b-bar', degree 2, or the law 'linear "
                       "elastic'");
    if (material.finite_strain() && small_only)
      throw InputError(section(),
                       "Element",
                       element_name,
                       "is for small strain, but 'Material/Law' is '" + material.law + "'",
                       "take the element 'automatic', 'F-bar' or 'full', or the law "
                       "'linear elastic'");
    if (!material.finite_strain() && type == ElementType::f_bar)
      throw InputError(section(),
                       "Element",
                       element_name,
                       "is for finite strain, but 'Material/Law' is '" + material.law + "'",
                       "take the element 'automatic', 'b-bar' or 'full', or another law");
  }



  void
  BodyParameters::check(const unsigned int degree) const
  {
    geometry->check(section() + "/Geometry");
    material.check(section() + "/Material");
    check_element(degree);
    for (unsigned int d = 0; d < 3; ++d)
      {
        const std::string letter(1, "xyz"[d]);
        for (const auto &[key, expression, variables] :
             {std::make_tuple("Initial velocity ", &initial_velocity[d], "x,y,z"),
              std::make_tuple("Initial displacement ", &initial_displacement[d], "x,y,z"),
              std::make_tuple("Body force ", &body_force[d], "x,y,z,t"),
              std::make_tuple("Reference displacement ", &reference_displacement[d], "x,y,z,t")})
          if (!expression->empty())
            check_expression(section(), key + letter, *expression, variables);
      }

    // Where nothing can move in some direction nothing can be pushed in it.
    std::map<std::string, std::string> held;
    for (const auto &[key, list] :
         {std::make_pair("Symmetry", &symmetry), std::make_pair("Fixed", &fixed)})
      for (const std::string &boundary : *list)
        {
          if (boundary.empty())
            throw InputError(section(),
                             key,
                             Patterns::Tools::to_string(*list),
                             "a name in this list is empty",
                             "remove the comma too many");
          if (held.count(boundary) > 0)
            throw InputError(section(),
                             key,
                             boundary,
                             held.at(boundary) == key
                               ? "this boundary is listed twice"
                               : "this boundary is also in the list '" + held.at(boundary) + "'",
                             "name it once: a fixed boundary needs no symmetry");
          held[boundary] = key;
        }

    for (const auto &[boundary, condition] : boundaries)
      {
        const std::string where = section() + "/Boundary " + boundary;
        condition.check(where);
        if (held.count(boundary) == 0)
          continue;
        const auto entries = condition.formulas();
        // A symmetry plane may still be moved or loaded along itself, and
        // which direction that is only the mesh knows; pressure is across.
        const unsigned int n = held.at(boundary) == "Fixed" ? entries.size() : 1;
        for (unsigned int i = 0; i < n; ++i)
          if (!entries[i].second.empty())
            throw InputError(where,
                             entries[i].first,
                             entries[i].second,
                             "this boundary is held by '" + held.at(boundary) + "' of '" +
                               section() + "'",
                             "remove this entry or take the boundary from the list '" +
                               held.at(boundary) + "'");
      }
  }
} // namespace Touchstone
