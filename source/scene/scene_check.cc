#include <touchstone/base/formula.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/suggestion.h>
#include <touchstone/scene/scene.h>

#include <algorithm>

namespace Touchstone
{
  namespace
  {
    /** Names of bodies, obstacles or pairs. */
    template <class Parameters>
    std::vector<std::string>
    names(const std::vector<Parameters> &all)
    {
      std::vector<std::string> result;
      for (const Parameters &one : all)
        result.push_back(one.name);
      return result;
    }

    /** The entry @p key of @p section names one of @p known. */
    void
    check_name(const std::string              &section,
               const std::string              &key,
               const std::string              &name,
               const std::string              &list,
               const std::vector<std::string> &known)
    {
      if (std::find(known.begin(), known.end(), name) == known.end())
        throw InputError(section,
                         key,
                         name,
                         "the list '" + list + "' does not name it" + did_you_mean(name, known),
                         known.empty() ? "add it to the list, which is empty"
                                       : "take one of " + quoted_list(known));
    }
  } // namespace



  void
  Scene::check() const
  {
    discretisation.check("Discretisation");
    for (const BodyParameters &body : bodies)
      body.check(discretisation.degree);
    for (const ObstacleParameters &obstacle : obstacles)
      obstacle.check(obstacle.section());
    for (const ContactPairParameters &pair : pairs)
      check_pair(pair);
    contact.check("Contact");
    refinement.check("Refinement");
    if (refinement.active() && discretisation.partitioner != "p4est" &&
        discretisation.partitioner != "automatic")
      throw InputError("Discretisation",
                       "Partitioner",
                       discretisation.partitioner,
                       "its mesh cannot be refined during the run",
                       "set it to 'automatic', or 'Estimator' in section 'Refinement' to 'none'.");
    load_stepping.check("Load stepping");
    check_formulas();
    check_time_integration();
    newton.check("Newton");
    linear_solver.check("Linear solver");
    output.check("Output");

    if (contact.enforcement.name == "lagrange multipliers" && !linear_solver.takes_multipliers())
      throw InputError("Contact",
                       "Enforcement",
                       contact.enforcement.name,
                       "multipliers make the system indefinite, which '" + linear_solver.type +
                         "' cannot solve",
                       "set 'Contact/Enforcement = elimination' or "
                       "'Linear solver/Type = MUMPS'");
    if (contact.linearisation == "consistent" && linear_solver.symmetric_only())
      throw InputError("Contact",
                       "Linearisation",
                       contact.linearisation,
                       "makes the system unsymmetric, which '" + linear_solver.type + "' cannot solve",
                       "set it to 'automatic' or 'frozen', or 'Linear solver/Type' to 'MUMPS' or "
                       "'Belos GMRES'");
    check_reference();
  }



  void
  Scene::check_reference() const
  {
    reference.check("Reference solution");
    if (!reference.pair.empty())
      check_name("Reference solution", "Pair", reference.pair, "Contact pairs", names(pairs));
    if (reference.type == "formula")
      return;
    const auto no_formula =
      [&](const std::string &section, const std::string &key, const std::string &text) {
        if (!text.empty())
          throw InputError(section,
                           key,
                           text,
                           "means nothing while 'Reference solution/Type' is '" + reference.type +
                             "'",
                           "remove it, or set that type to 'formula'");
      };
    no_formula("Reference solution", "Pressure", reference.pressure);
    for (const BodyParameters &body : bodies)
      for (unsigned int d = 0; d < 3; ++d)
        no_formula(body.section(),
                   std::string("Reference displacement ") + "xyz"[d],
                   body.reference_displacement[d]);
  }



  void
  Scene::check_formulas() const
  {
    const auto check =
      [&](const std::string &section, const std::string &key, const std::string &text) {
        check_at_all_steps(section, key, text, load_stepping.end_time, load_stepping.steps);
      };
    for (const BodyParameters &body : bodies)
      {
        for (unsigned int d = 0; d < 3; ++d)
          check(body.section(), std::string("Body force ") + "xyz"[d], body.body_force[d]);
        for (const auto &[boundary, condition] : body.boundaries)
          for (const auto &[key, text] : condition.formulas())
            check(body.section() + "/Boundary " + boundary, key, text);
      }
    for (const ObstacleParameters &obstacle : obstacles)
      for (const auto &[key, text] : {std::make_pair("Motion x", &obstacle.motion_x),
                                      std::make_pair("Motion y", &obstacle.motion_y),
                                      std::make_pair("Motion z", &obstacle.motion_z)})
        check(obstacle.section(), key, *text);
  }



  void
  Scene::check_time_integration() const
  {
    const std::string section = "Time integration";
    time_integration.check(section);
    if (time_integration.mass == "dispersion corrected" && discretisation.degree != 1)
      throw InputError(section,
                       "Mass",
                       time_integration.mass,
                       "is made for degree 1",
                       "set it to 'consistent', or 'Discretisation/Degree' to 1");
    for (const BodyParameters &body : bodies)
      {
        const MaterialParameters &material = body.material;
        if (time_integration.dynamic() && material.density <= 0.)
          throw InputError(body.section() + "/Material",
                           "Density",
                           dealii::Patterns::Tools::to_string(material.density),
                           "must be positive: 'Time integration/Scheme' is '" +
                             time_integration.scheme + "'",
                           "give the mass per volume in the scene's units, e.g. 7.85e-9 for steel "
                           "in t and mm, or set the scheme to 'static'");
        if (time_integration.dynamic())
          continue;
        const std::string remedy = "remove it, or set 'Time integration/Scheme' to 'newmark', "
                                   "'generalized_alpha' or another scheme with inertia";
        for (unsigned int d = 0; d < 3; ++d)
          for (const auto &[key, value] :
               {std::make_pair("Initial velocity ", &body.initial_velocity[d]),
                std::make_pair("Initial displacement ", &body.initial_displacement[d])})
            if (!value->empty())
              throw InputError(body.section(),
                               key + std::string(1, "xyz"[d]),
                               *value,
                               "means nothing without inertia",
                               remedy);
        for (const auto &[key, value] :
             {std::make_pair("Rayleigh mass", material.rayleigh_mass),
              std::make_pair("Rayleigh stiffness", material.rayleigh_stiffness)})
          if (value > 0.)
            throw InputError(body.section() + "/Material",
                             key,
                             dealii::Patterns::Tools::to_string(value),
                             "means nothing without inertia",
                             remedy);
      }
  }



  void
  Scene::check_pair(const ContactPairParameters &pair) const
  {
    const std::string section = pair.section();
    check_name(section, "Slave body", pair.slave_body, "Bodies", names(bodies));
    if (!pair.master_body.empty())
      check_name(section, "Master body", pair.master_body, "Bodies", names(bodies));
    if (!pair.obstacle.empty())
      check_name(section, "Obstacle", pair.obstacle, "Obstacles", names(obstacles));
    pair.check(section);
    if (pair.tied() && pair.initial_overlap != "interference")
      throw InputError(section,
                       "Initial overlap",
                       pair.initial_overlap,
                       "a tied pair holds the bodies as they are placed",
                       "remove the key");
    if (pair.tied() && pair.sliding == "finite")
      throw InputError(section,
                       "Sliding",
                       pair.sliding,
                       "a tied pair cannot slide",
                       "remove 'Sliding' or set it to 'small'");
    if (pair.master_normal == "smoothed" && discretisation.degree != 1)
      throw InputError(section,
                       "Master normal",
                       pair.master_normal,
                       "only faces of degree 1 can be smoothed; those of degree 2 are curved",
                       "set 'Master normal = averaged' or 'Discretisation/Degree = 1'");
  }
} // namespace Touchstone
