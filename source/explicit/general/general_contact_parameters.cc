// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/explicit/general/general_contact_parameters.h>

#include <cmath>
#include <set>
#include <tuple>

// Input of general contact: the keys with their documentation, and the checks that need no mesh.
namespace Touchstone
{
  namespace Patterns = dealii::Patterns;

  std::string
  GeneralContactParameters::section() const
  {
    return "Contact pair " + name;
  }



  double
  GeneralContactParameters::margin_length() const
  {
    return margin == "automatic" ? 0. : std::stod(margin);
  }



  bool
  GeneralContactParameters::all_bodies() const
  {
    return bodies.size() == 1 && bodies.front() == "all";
  }



  bool
  GeneralContactParameters::all_boundaries() const
  {
    return boundaries.size() == 1 && boundaries.front() == "all";
  }



  void
  GeneralContactParameters::declare(dealii::ParameterHandler &prm, const EarlyValues &values)
  {
    const Patterns::List list(Patterns::Anything{});
    prm.add_parameter("Slave body",
                      bodies,
                      "Without master body and obstacle: the bodies that may touch each other and "
                      "themselves, with commas, or 'all'.",
                      list);
    prm.add_parameter("Slave boundaries",
                      boundaries,
                      "Their boundaries, or 'all': every face that has no cell behind it and is no "
                      "plane of symmetry.",
                      list);
    behaviour.declare_key(prm,
                          values,
                          "Behaviour",
                          "'frictionless' contact, or a friction law, whose own keys stand in the "
                          "subsection 'Friction':",
                          {"frictionless"});
    friction = behaviour.make();
    if (friction)
      {
        prm.enter_subsection("Friction");
        behaviour.declare_own_keys(prm);
        prm.leave_subsection();
      }
    search.declare_key(prm,
                       values,
                       "Search",
                       "How pairs of faces that are close to each other are found. All ways find "
                       "the same pairs:");
    prm.add_parameter("Search margin",
                      margin,
                      "How far nodes may move, relative to each other, before pairs are sought "
                      "anew; 'automatic' takes up to half a face, by the speed of the motion. "
                      "Results do not depend on it. [length]",
                      Patterns::Anything());
    initial_overlap.declare(prm,
                            "Initial overlap",
                            "Surfaces that cross each other as the bodies are placed are an error "
                            "to 'refuse', with the places, or a fault of the mesh to 'adjust': "
                            "nodes are moved, without stress, until nothing overlaps. Overlaps of "
                            "more than a quarter of a face are refused in any case.");
  }



  void
  GeneralContactParameters::check(const std::string &section) const
  {
    for (const auto &[key, list, what] :
         {std::make_tuple("Slave body", &bodies, "body"),
          std::make_tuple("Slave boundaries", &boundaries, "boundary")})
      {
        if (list->empty())
          throw InputError(section,
                           key,
                           "",
                           "the list is empty",
                           std::string("name each ") + what + ", or write 'all'");
        std::set<std::string> seen;
        for (const std::string &one : *list)
          if (one.empty() || !seen.insert(one).second || (one == "all" && list->size() > 1))
            throw InputError(section,
                             key,
                             one,
                             one.empty()    ? "a name in this list is empty"
                             : one == "all" ? "it stands for all, but is not alone"
                                            : std::string("this ") + what + " is listed twice",
                             std::string("name each ") + what + " once, or write 'all' alone");
      }
    behaviour.check(section + "/Friction");
    search.check(section);
    if (friction)
      {
        // Nodes of general contact have neither an area of their own nor a path of slip that would
        // be kept from one partner to the next.
        FrictionInput input;
        input.normal_force = input.area = 1.;
        const double limit              = friction->limit(input).force;
        for (double FrictionInput::*const quantity :
             {&FrictionInput::area, &FrictionInput::slip_length})
          {
            FrictionInput other = input;
            other.*quantity += 1.;
            if (friction->limit(other).force != limit)
              throw InputError(section,
                               "Behaviour",
                               behaviour.name,
                               "depends on areas or on the slip path, which general contact does "
                               "not have",
                               "take 'coulomb' with a constant coefficient, or declare the pair "
                               "with its master body");
          }
      }
    if (margin == "automatic")
      return;
    bool valid = false;
    try
      {
        std::size_t  end   = 0;
        const double value = std::stod(margin, &end);
        valid              = end == margin.size() && std::isfinite(value) && value > 0.;
      }
    catch (const std::logic_error &)
      {
        // No number: reported below.
      }
    if (!valid)
      throw InputError(section,
                       "Search margin",
                       margin,
                       "must be a positive length or 'automatic'",
                       "remove the key: 'automatic' follows the motion");
  }
} // namespace Touchstone
