// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/expression.h>
#include <touchstone/base/input_error.h>
#include <touchstone/solid/boundary_parameters.h>

#include <algorithm>
#include <cmath>

// Keys of a section 'Boundary NAME' of a body: prescribed displacements and loads, all as
// formulas in x, y, z and t.
namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  void
  BoundaryParameters::declare(ParameterHandler &prm)
  {
    const std::string formula = " A formula in x, y, z (reference coordinates) and t (time); ";
    const auto        component =
      [&](const std::string &name, std::string &value, const std::string &what) {
        prm.add_parameter(name, value, what, FormulaPattern());
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
    pressure_follows.declare(
      prm,
      "Pressure follows",
      "'surface': the pressure acts on the deformed surface, along its present "
      "normal; 'nothing': on the reference area along the normal there (a dead "
      "load); 'automatic': on the deformed surface if the material has a law for "
      "finite strain.");
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter(std::string("Force ") + "xyz"[d],
                        force[d],
                        std::string(1, "xyz"[d]) +
                          " component of a force that acts at 'Reference point' and is carried to "
                          "the boundary by tractions that are linear in the position, a formula in "
                          "t; empty: none. [force]",
                        FormulaPattern());
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter(std::string("Moment ") + "xyz"[d],
                        moment[d],
                        std::string(1, "xyz"[d]) +
                          " component of a moment, in the same way. [force times length]",
                        FormulaPattern());
    prm.add_parameter("Reference point",
                      reference_point,
                      "x, y, z of the point at which 'Force' acts; empty: the centroid of the "
                      "boundary. [length]",
                      Patterns::List(Patterns::Double(), 0, 3));
    prm.add_parameter("Spring stiffness normal",
                      spring_normal,
                      "Stiffness of springs to the ground across the boundary, in tension as in "
                      "compression; 0: none. [force per area and length]",
                      Patterns::Double());
    prm.add_parameter("Spring stiffness tangential",
                      spring_tangential,
                      "The same along the boundary. [force per area and length]",
                      Patterns::Double());
  }



  bool
  BoundaryParameters::has_resultant() const
  {
    return !(force[0] + force[1] + force[2] + moment[0] + moment[1] + moment[2]).empty();
  }



  /** All entries that are formulas, with their keys, for checks that concern each of them. The
   * pressure comes first: BodyParameters::check() relies on it, as only the pressure always acts
   * across a symmetry plane. */
  std::vector<std::pair<std::string, std::string>>
  BoundaryParameters::formulas() const
  {
    return {{"Pressure", pressure},
            {"Displacement x", displacement_x},
            {"Displacement y", displacement_y},
            {"Displacement z", displacement_z},
            {"Traction x", traction_x},
            {"Traction y", traction_y},
            {"Traction z", traction_z},
            {"Force x", force[0]},
            {"Force y", force[1]},
            {"Force z", force[2]},
            {"Moment x", moment[0]},
            {"Moment y", moment[1]},
            {"Moment z", moment[2]}};
  }



  bool
  BoundaryParameters::prescribes_nothing() const
  {
    const auto all = formulas();
    return std::all_of(all.begin(),
                       all.end(),
                       [](const auto &entry) { return entry.second.empty(); }) &&
           spring_normal == 0. && spring_tangential == 0.;
  }



  namespace
  {
    /** The stiffness of springs in the scene; empty for none. */
    std::string
    spring_text(const double stiffness)
    {
      return stiffness == 0. ? "" : Patterns::Tools::to_string(stiffness);
    }
  } // namespace



  void
  BoundaryParameters::check(const std::string &section) const
  {
    // A load on a component that is prescribed changes the reaction and nothing else; as it is
    // most likely a mistake, it is an error here.
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
        for (const auto &[key, text] :
             {std::make_pair("Force ", &force[d]), std::make_pair("Moment ", &moment[d])})
          if (!text->empty())
            check_expression(section, key + letter, *text, "t");
        if (!displacements[d]->empty() && has_resultant())
          throw InputError(section,
                           "Displacement " + letter,
                           *displacements[d],
                           "the boundary has a force or moment, whose tractions would be taken by "
                           "this support",
                           "prescribe either the displacement or the force");
        all_moved = all_moved && !displacements[d]->empty();
      }
    if (!pressure.empty())
      check_expression(section, "Pressure", pressure);
    if (!reference_point.empty() && (reference_point.size() != 3 || !has_resultant()))
      throw InputError(section,
                       "Reference point",
                       Patterns::Tools::to_string(reference_point),
                       has_resultant() ? "is no point" : "there is no force on this boundary",
                       has_resultant() ? "give three numbers" : "remove the key, or set 'Force x'");
    for (const auto &[key, value] :
         {std::make_pair("Spring stiffness normal", spring_normal),
          std::make_pair("Spring stiffness tangential", spring_tangential)})
      if (!(value >= 0.) || !std::isfinite(value))
        throw InputError(section,
                         key,
                         Patterns::Tools::to_string(value),
                         "must not be negative",
                         "give force per area and length, or 0 for no springs");
    // A key without effect is an error: it shows that the user expects something else.
    if (pressure.empty() && pressure_follows != Follows::automatic)
      throw InputError(section,
                       "Pressure follows",
                       pressure_follows.word(),
                       "there is no pressure on this boundary",
                       "remove the key, or set 'Pressure'");
    if (all_moved)
      for (const auto &[key, value] :
           {std::make_pair(std::string("Pressure"), pressure),
            std::make_pair(std::string("Spring stiffness normal"), spring_text(spring_normal)),
            std::make_pair(std::string("Spring stiffness tangential"),
                           spring_text(spring_tangential))})
        if (!value.empty())
          throw InputError(section,
                           key,
                           value,
                           "has no effect where all three displacements are prescribed",
                           "remove the key or one of the displacements");
  }
} // namespace Touchstone
