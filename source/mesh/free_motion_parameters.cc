// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/expression.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/suggestion.h>
#include <touchstone/mesh/free_motion_parameters.h>

#include <algorithm>

// Keys of obstacles that are moved by forces (doc/theory.md 4.5). What depends on other sections is
// checked in scene/free_motion_rules.cc.
namespace Touchstone
{
  using namespace dealii;

  std::string
  FreeMotionParameters::word(const unsigned int component)
  {
    return (component < 3 ? "" : "about ") + std::string(1, "xyz"[component % 3]);
  }



  std::string
  FreeMotionParameters::load_key(const unsigned int component)
  {
    return (component < 3 ? "Force " : "Moment ") + std::string(1, "xyz"[component % 3]);
  }



  bool
  FreeMotionParameters::is_free(const unsigned int component) const
  {
    return std::find(directions.begin(), directions.end(), word(component)) != directions.end();
  }



  void
  FreeMotionParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Free directions",
                      directions,
                      "Directions in which the obstacle is not driven but follows the forces on "
                      "it: 'x', 'y', 'z' along axes, 'about x', 'about y', 'about z' for turns "
                      "about axes through 'Reference point', of which there is one or all three.",
                      Patterns::List(Patterns::Anything()));
    prm.add_parameter("Reference point",
                      reference_point,
                      "The point of the obstacle at time 0 about which it turns freely and to "
                      "which moments refer; in dynamics its centre of mass. [length]");
    for (unsigned int c = 0; c < n_components; ++c)
      prm.add_parameter(load_key(c),
                        loads[c],
                        std::string(c < 3 ? "Force on the obstacle along this axis"
                                          : "Moment on the obstacle about this axis") +
                          ", which must be a free direction; a formula in t; empty: none. " +
                          (c < 3 ? "[force]" : "[force * length]"),
                        FormulaPattern());
    prm.add_parameter("Mass", mass, "Mass of an obstacle that is free along axes, in dynamics.");
    prm.add_parameter("Inertia",
                      inertia,
                      "Moments of inertia about the three axes through the reference point, of an "
                      "obstacle that turns freely in dynamics; the axes turn with it. "
                      "[mass * length^2]");
    prm.add_parameter("Initial velocity",
                      velocity,
                      "Velocity along the free directions at time 0, in dynamics. "
                      "[length / time]");
    prm.add_parameter("Initial angular velocity",
                      angular_velocity,
                      "Angular velocity about the free axes at time 0, in dynamics. "
                      "[radians / time]");
  }



  void
  FreeMotionParameters::check_directions(const std::string &section) const
  {
    std::vector<std::string> words;
    for (unsigned int c = 0; c < n_components; ++c)
      words.push_back(word(c));
    for (const std::string &name : directions)
      {
        if (std::find(words.begin(), words.end(), name) == words.end())
          throw InputError(section,
                           "Free directions",
                           name,
                           "is no direction" + did_you_mean(name, words),
                           "take some of " + quoted_list(words));
        if (std::count(directions.begin(), directions.end(), name) > 1)
          throw InputError(
            section, "Free directions", name, "is there twice", "name each direction once");
      }
    if (is_free(3) + is_free(4) + is_free(5) == 2)
      throw InputError(section,
                       "Free directions",
                       Patterns::Tools::to_string(directions),
                       "has turns about two axes, whose outcome would depend on the load steps, as "
                       "turns do not commute",
                       "free the turn about one axis, or about all three");
  }



  void
  FreeMotionParameters::check_inertia(const std::string &section) const
  {
    if (!(mass >= 0.))
      throw InputError(section,
                       "Mass",
                       Patterns::Tools::to_string(mass),
                       "must not be negative",
                       "give the mass of the obstacle");
    for (unsigned int d = 0; d < 3; ++d)
      if (!(inertia[d] >= 0.))
        throw InputError(section,
                         "Inertia",
                         Patterns::Tools::to_string(inertia),
                         "must not be negative",
                         "give the moments of inertia about the three axes");
    // No body has less: I_x + I_y - I_z is an integral of z^2.
    if (is_free(3) && is_free(4) && is_free(5))
      for (unsigned int d = 0; d < 3; ++d)
        if (inertia[d] > (1. + 1e-9) * (inertia[(d + 1) % 3] + inertia[(d + 2) % 3]))
          throw InputError(section,
                           "Inertia",
                           Patterns::Tools::to_string(inertia),
                           "is that of no body: one moment is larger than the sum of the others",
                           "give the moments of inertia about the three axes");
  }



  void
  FreeMotionParameters::check(const std::string                &section,
                              const std::array<std::string, 4> &prescribed) const
  {
    check_directions(section);
    for (unsigned int c = 0; c < n_components; ++c)
      {
        const std::string key = load_key(c);
        if (!loads[c].empty())
          {
            check_expression(section, key, loads[c], "t");
            if (!is_free(c))
              throw InputError(section,
                               key,
                               loads[c],
                               "acts along a direction in which the motion is prescribed",
                               "add '" + word(c) +
                                 "' to 'Free directions', or remove the "
                                 "key");
          }
        if (start(c) != 0. && !is_free(c))
          throw InputError(section,
                           c < 3 ? "Initial velocity" : "Initial angular velocity",
                           Patterns::Tools::to_string(c < 3 ? velocity : angular_velocity),
                           "has a component along '" + word(c) +
                             "', in which the motion is "
                             "prescribed",
                           "add it to 'Free directions', or remove the key");
        const std::string &driven = prescribed[std::min(c, 3u)];
        if (is_free(c) && driven != "0")
          throw InputError(section,
                           c < 3 ? "Motion " + word(c) : "Rotate angle",
                           driven,
                           "drives the obstacle along '" + word(c) +
                             "', which is one of 'Free "
                             "directions'",
                           "remove one of both");
      }
    check_inertia(section);
    if (!any() && (mass != 0. || inertia.norm() > 0. || reference_point.norm() > 0.))
      throw InputError(section,
                       mass != 0.            ? "Mass"
                       : inertia.norm() > 0. ? "Inertia"
                                             : "Reference point",
                       mass != 0.            ? Patterns::Tools::to_string(mass)
                       : inertia.norm() > 0. ? Patterns::Tools::to_string(inertia)
                                             : Patterns::Tools::to_string(reference_point),
                       "means nothing for an obstacle that is driven in all directions",
                       "remove the key, or set 'Free directions'");
  }
} // namespace Touchstone
