// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/expression.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/suggestion.h>
#include <touchstone/mesh/placed_geometry.h>
#include <touchstone/solid/body_parameters.h>
#include <touchstone/solid/material_law.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

// Keys of the section 'Body NAME': element, supports, loads, initial values, geometry and
// material. What can be judged without a mesh is checked here, by key and section, before
// anything is computed; conditions that depend on the mesh (is a symmetry boundary plane?) are
// checked by BoundaryConditions.
namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  std::string
  BodyParameters::section() const
  {
    return "Body " + name;
  }



  bool
  BodyParameters::supported() const
  {
    // Whether some displacement is prescribed on the body; this does not tell whether all of its
    // rigid motions are prevented, which RigidBodyModes::free_motion() decides.
    return !symmetry.empty() || !fixed.empty() ||
           std::any_of(boundaries.begin(), boundaries.end(), [](const auto &entry) {
             const BoundaryParameters &b = entry.second;
             return !(b.displacement_x + b.displacement_y + b.displacement_z).empty();
           });
  }



  /** The element that neither locks nor fails for the law and degree in question (doc/theory.md
   * 2.1 and 2.2). Degree 2 hardly locks, so the displacement element is kept. Plastic flow keeps
   * the volume, so that elastoplastic material needs a mean dilatation; linear elastic bodies
   * get incompatible modes, which do not lock in bending. */
  ElementType
  BodyParameters::automatic_element(const unsigned int degree) const
  {
    return degree > 1                 ? ElementType::full
           : material.finite_strain() ? ElementType::f_bar
           : !material.linear()       ? ElementType::b_bar
                                      : ElementType::incompatible_modes;
  }



  void
  BodyParameters::declare_formulas(ParameterHandler &prm)
  {
    for (unsigned int d = 0; d < 3; ++d)
      {
        const std::string letter(1, "xyz"[d]);
        const auto        formula =
          [&](const std::string &key, std::string &value, const std::string &what) {
            prm.add_parameter(key + " " + letter, value, what, FormulaPattern());
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
  }



  void
  BodyParameters::declare_geometry(ParameterHandler &prm, const EarlyValues &values)
  {
    prm.enter_subsection("Geometry");
    {
      // The keys of a geometry are known only once its type is: the type is read first from the
      // early values, then the object is made and declares keys of its own, so that a key of
      // another geometry is an error.
      geometry_type.declare_key(prm,
                                values.in("Geometry"),
                                "Type",
                                "The shape of the body, which decides on the other keys here.");
      if (!GeometryRegistry::knows(geometry_type.chosen()))
        throw InputError(section() + "/Geometry",
                         "Type",
                         geometry_type.chosen(),
                         "there is no such geometry" +
                           did_you_mean(geometry_type.chosen(), GeometryRegistry::names()),
                         "take one of " + quoted_list(GeometryRegistry::names()));
      geometry_type.declare_own_keys(prm);
      geometry = std::make_shared<PlacedGeometry>(geometry_type.make());
      geometry->declare(prm);
    }
    prm.leave_subsection();
  }



  void
  BodyParameters::declare(ParameterHandler &prm, const EarlyValues &values)
  {
    element_type.declare(
      prm,
      "Element",
      "How cells interpolate strain: 'full' integration of the displacements' "
      "gradient; 'b-bar' with a constant volume change per cell, for nearly "
      "incompressible material; 'incompatible modes' for bending; 'F-bar' is "
      "b-bar for finite strain. The latter three are for degree 1, b-bar for "
      "material laws of small strain, incompatible modes for the law 'linear "
      "elastic' only, F-bar for laws of finite strain. 'automatic' takes full "
      "for degree 2; for degree 1 F-bar with a law for finite strain, b-bar with "
      "plasticity at small strain (plastic flow keeps the volume, and full cells "
      "lock), and else incompatible modes. 'one point' is for explicit dynamics: cheap "
      "hexahedra with one point of integration and control of their hourglass modes.");
    hourglass.declare(
      prm,
      "Hourglass control",
      "Of the element 'one point': 'stiffness', elastic forces that make its bending exact; "
      "'viscous', damping; 'none', for tests.");
    prm.add_parameter("Hourglass coefficient",
                      hourglass_coefficient,
                      "Of the element 'one point': factor of that stiffness, or part of the "
                      "critical damping; a number from 0 to 1, or 'automatic': 1 for the stiffness "
                      "of elastic bodies, else 0.1. [no unit]",
                      Patterns::Anything());
    prm.add_parameter("Symmetry",
                      symmetry,
                      "Plane boundaries that keep their place in the normal "
                      "direction, by name or number.");
    prm.add_parameter("Fixed", fixed, "Boundaries that cannot move at all, by name or number.");
    declare_formulas(prm);
    prm.add_parameter("Boundary conditions",
                      conditions,
                      "Boundaries, by name or number, that each have a subsection "
                      "'Boundary NAME' with displacements or loads.");

    declare_geometry(prm, values);

    prm.enter_subsection("Material");
    material.declare(prm, values.in("Material"));
    prm.leave_subsection();

    // The list 'Boundary conditions' names the subsections, so it must have been read before they
    // can be declared.
    for (const std::string &boundary : conditions)
      {
        prm.enter_subsection("Boundary " + boundary);
        boundaries[boundary].declare(prm);
        prm.leave_subsection();
      }
  }



  double
  BodyParameters::hourglass_factor() const
  {
    if (hourglass_coefficient != "automatic")
      return dealii::Utilities::string_to_double(hourglass_coefficient);
    const bool elastic = !SmallStrainRegistry::knows(material.law.name) &&
                         !FiniteStrainRegistry::knows(material.law.name);
    return hourglass == Hourglass::stiffness && elastic ? 1. : 0.1;
  }



  void
  BodyParameters::check() const
  {
    if (hourglass_coefficient != "automatic" &&
        !Patterns::Double(0., 1.).match(hourglass_coefficient))
      throw InputError(section(),
                       "Hourglass coefficient",
                       hourglass_coefficient,
                       "is neither 'automatic' nor a number from 0 to 1",
                       "take 'automatic'");
    geometry_type.check(section() + "/Geometry");
    geometry->check(section() + "/Geometry");
    material.check(section() + "/Material");
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

    // Lists are compared by the names that were given; that a name and a number mean the same
    // boundary shows only with the mesh, where BoundaryConditions checks once more.
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
