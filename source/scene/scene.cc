// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/suggestion.h>
#include <touchstone/mesh/obstacle_shape.h>
#include <touchstone/scene/idle_sections.h>
#include <touchstone/scene/scene.h>
#include <touchstone/scene/scene_entries.h>
#include <touchstone/scene/scene_text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <set>
#include <sstream>

/**
 * @file
 * From the text of a scene file to its parameters. The order matters: the lists of names say which
 * subsections there are, choices of classes (read early from the text) say which keys these
 * declare; only then deal.II's handler knows all entries and can take their values; derived values
 * and checks come last.
 */

namespace Touchstone
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    /**
     * Names in a list such as "Bodies = a, b". Each must have a subsection of its own, so names
     * that could not be part of a path, duplicates and names without subsection are errors.
     */
    std::vector<std::string>
    names_of_list(const SceneText   &text,
                  const std::string &section,
                  const std::string &key,
                  const std::string &prefix)
    {
      const std::string        value = text.value(section, key, "");
      std::vector<std::string> names = dealii::Utilities::split_string_list(value, ',');
      if (!value.empty() && value.back() == ',')
        names.emplace_back(); // split_string_list drops it

      std::vector<std::string> sections;
      for (const auto &[name, line] : text.sections())
        sections.push_back(name);

      std::set<std::string> seen;
      for (const std::string &name : names)
        {
          if (name.empty())
            throw InputError(
              section, key, value, "a name in this list is empty", "remove the comma too many");
          if (name.find_first_of("/=\"'") != std::string::npos)
            throw InputError(section,
                             key,
                             name,
                             "a name cannot contain any of / = \" '",
                             "use letters, numbers and blanks");
          if (!seen.insert(name).second)
            throw InputError(
              section, key, name, "this name is listed twice", "give each its own name");

          // The subsection "Body a" of the name a.
          const std::string own = (section.empty() ? "" : section + "/") + prefix + name;
          if (text.sections().count(own) == 0)
            throw InputError(section,
                             key,
                             name,
                             "there is no subsection '" + own + "'" + did_you_mean(own, sections),
                             "write one, or take '" + name + "' from the list");
        }
      return names;
    }
  } // namespace



  Scene::Scene(const std::string              &content,
               const std::string              &file_name,
               const std::vector<std::string> &overrides)
  {
    SceneText text(content, file_name, overrides);
    read_lists(text);
    declare(text);
    // The keys exist from here on, those of the present behaviours: what is set beside them is
    // taken away before the entries are compared with the keys.
    without_effect             = take_idle_friction(*this, text);
    const std::string defaults = complete_entries();
    set_entries(text, prm);
    const std::string complete = complete_entries();
    resolve(text, file_name);
    const std::vector<std::string> idle = idle_entries(*this, defaults, complete);
    without_effect.insert(without_effect.end(), idle.begin(), idle.end());
    check();
    separate_walls();
  }



  // A node in the corner of a die touches several walls: each has rows of its own. Last, for the
  // handler knows the parameters of the pairs by their place.
  void
  Scene::separate_walls()
  {
    std::vector<ContactPairParameters> all;
    for (const ContactPairParameters &pair : pairs)
      {
        const auto obstacle =
          std::find_if(obstacles.begin(), obstacles.end(), [&](const ObstacleParameters &one) {
            return one.name == pair.obstacle;
          });
        const std::size_t n =
          obstacle == obstacles.end() || pair.tied() ? 0 : obstacle->shape.make()->walls().size();
        if (n == 0)
          all.push_back(pair);
        for (unsigned int wall = 0; wall < n; ++wall)
          {
            all.push_back(pair);
            all.back().part_of = pair.name;
            all.back().wall    = wall;
            all.back().name += " wall " + std::to_string(wall + 1);
          }
      }
    pairs = all;
  }



  void
  Scene::read_lists(const SceneText &text)
  {
    // An empty list is a mistake of its own; a missing one is reported later, as a required key
    // that is not set.
    if (text.is_set("", "Bodies") && text.value("", "Bodies", "").empty())
      throw InputError(
        "", "Bodies", "", "the list is empty", "name at least one body: set Bodies = NAME");
    for (const std::string &name : names_of_list(text, "", "Bodies", "Body "))
      {
        BodyParameters body;
        body.name       = name;
        body.conditions = names_of_list(text, body.section(), "Boundary conditions", "Boundary ");
        bodies.push_back(body);
      }
    for (const std::string &name : names_of_list(text, "", "Obstacles", "Obstacle "))
      {
        obstacles.emplace_back();
        obstacles.back().name = name;
      }
    for (const std::string &name : names_of_list(text, "", "Probes", "Probe "))
      {
        probes.emplace_back();
        probes.back().name = name;
      }
    for (const std::string &name : names_of_list(text, "Load stepping", "Phases", "Phase "))
      load_stepping.phases.push_back({name, 0., 1});
    // "all" needs no subsection: everything touches everything without friction.
    if (text.value("", "Contact pairs", "") == "all" &&
        text.sections().count("Contact pair all") == 0)
      {
        general.emplace_back();
        general.back().name = "all";
        return;
      }
    for (const std::string &name : names_of_list(text, "", "Contact pairs", "Contact pair "))
      if (const std::string section = "Contact pair " + name;
          text.value("Time integration", "Scheme", "") == "central_differences" &&
          !text.is_set(section, "Master body") && !text.is_set(section, "Obstacle"))
        {
          general.emplace_back();
          general.back().name = name;
        }
      else
        {
          pairs.emplace_back();
          pairs.back().name = name;
        }
  }



  void
  Scene::declare(const SceneText &text)
  {
    prm.add_parameter("Title", title, "What the scene is about.", Patterns::Anything());
    // Taken out of the text before (SceneText): here for the documentation alone.
    prm.declare_entry("Constants",
                      "",
                      Patterns::Anything(),
                      "Names for numbers, 'R = 10, p0 = 5*R', which formulas and numbers of the "
                      "scene may use. In a scene that the program prints, numbers stand in their "
                      "place.");
    const Patterns::List list(Patterns::Anything{});
    prm.declare_entry("Bodies",
                      "",
                      list,
                      "Names of the bodies, with commas; each has a subsection "
                      "'Body NAME'. Required.",
                      /*has_to_be_set=*/true);
    prm.declare_entry("Obstacles",
                      "",
                      list,
                      "Names of the rigid obstacles; each has a subsection "
                      "'Obstacle NAME'.");
    prm.declare_entry("Contact pairs",
                      "",
                      list,
                      "Names of the contact pairs; each has a subsection "
                      "'Contact pair NAME'.");

    prm.declare_entry("Probes",
                      "",
                      list,
                      "Names of places whose history is wanted; each has a subsection "
                      "'Probe NAME'.");

    // The values that are needed before the handler has them.
    const auto look_up    = [&text](const auto &...arguments) { return text.value(arguments...); };
    const auto declare_in = [&](const std::string &section, auto &parameters) {
      prm.enter_subsection(section);
      parameters.declare(prm);
      prm.leave_subsection();
    };
    // Classes that are chosen by name (geometries, laws, enforcements) declare keys of their own:
    // their name is looked up in the text before the entries are declared.
    const auto declare_choices_in = [&](const std::string &section, auto &parameters) {
      prm.enter_subsection(section);
      parameters.declare(prm, EarlyValues(look_up, section));
      prm.leave_subsection();
    };
    for (BodyParameters &body : bodies)
      {
        if (text.sections().count(body.section() + "/Geometry") == 0)
          throw InputError(body.section(),
                           "",
                           "",
                           "there is no subsection 'Geometry': the body has no shape",
                           "write one with the key 'Type' and the keys of that geometry");
        declare_choices_in(body.section(), body);
      }
    for (ObstacleParameters &obstacle : obstacles)
      declare_choices_in(obstacle.section(), obstacle);
    for (ContactPairParameters &pair : pairs)
      declare_choices_in(pair.section(), pair);
    for (GeneralContactParameters &one : general)
      declare_choices_in(one.section(), one);
    declare_choices_in("Contact", contact);
    declare_in("Discretisation", discretisation);
    declare_in("Refinement", refinement);
    declare_in("Load stepping", load_stepping);
    declare_in("Time integration", time_integration);
    declare_in("Newton", newton);
    declare_in("Linear solver", linear_solver);
    declare_in("Output", output);
    for (ProbeParameters &probe : probes)
      declare_in(probe.section(), probe);
    declare_in("Checkpoints", checkpoints);
    declare_choices_in("Reference solution", reference);
  }



  void
  Scene::resolve(const SceneText &text, const std::string &file_name)
  {
    for (BodyParameters &body : bodies)
      body.material.resolve();
    for (BodyParameters &body : bodies)
      // Resolved once, so that everything else sees the element that is used.
      if (body.element_type == ElementType::automatic)
        body.element_type = body.automatic_element(discretisation.degree);

    // Each shape holds its own parameters: it is the one that contact will ask for its surface.
    for (ObstacleParameters &obstacle : obstacles)
      obstacle.shape.make()->set_folder(std::filesystem::path(file_name).parent_path().string());

    for (ContactPairParameters &pair : pairs)
      if (pair.tied() && !text.is_set(pair.section(), "Sliding"))
        {
          // A tied pair does not slide: the default of "Sliding" is another one there. It is set
          // through the handler, so that the printed scene shows it and can be read back.
          prm.enter_subsection(pair.section());
          prm.set("Sliding", std::string("small"));
          prm.leave_subsection();
        }

    // The mass of explicit steps is lumped: shown so by the printed scene, and what else is set is
    // refused.
    if (time_integration.runs_in_cycles() && !text.is_set("Time integration", "Mass"))
      {
        prm.enter_subsection("Time integration");
        prm.set("Mass", std::string("lumped"));
        prm.leave_subsection();
      }

    // Once here, so that everything else sees the enforcement that is used; the printed scene
    // keeps the word.
    if (contact.enforcement.name == "automatic")
      contact.enforcement =
        ContactParameters::default_enforcement(time_integration.runs_in_cycles());

    if (!load_stepping.phases.empty())
      resolve_phases(text);

    if (output.directory.empty())
      {
        // The default folder is named after the scene file: output/STEM. A leading dot belongs to
        // the name.
        const std::size_t slash = file_name.find_last_of('/');
        const std::string stem =
          slash == std::string::npos ? file_name : file_name.substr(slash + 1);
        const std::size_t dot = stem.find_last_of('.');
        output.directory      = "output/" + (dot == 0 ? stem : stem.substr(0, dot));
      }
  }



  void
  Scene::resolve_phases(const SceneText &text)
  {
    const double end   = load_stepping.phases.back().end_time;
    unsigned int steps = 0;
    for (const LoadPhase &phase : load_stepping.phases)
      steps += phase.steps;
    // A complete scene that was printed before sets both to these values.
    for (const auto &[key, differs] : {std::make_pair("End time", load_stepping.end_time != end),
                                       std::make_pair("Steps", load_stepping.steps != steps)})
      if (text.is_set("Load stepping", key) && differs)
        throw InputError("Load stepping",
                         key,
                         text.value("Load stepping", key, ""),
                         "follows from the phases, with another value",
                         "remove it; each phase has this key in its own subsection");
    // Through the handler, so that the printed scene shows them.
    prm.enter_subsection("Load stepping");
    prm.set("End time", end);
    prm.set("Steps", static_cast<long int>(steps));
    prm.leave_subsection();
  }



  void
  Scene::print(std::ostream &out) const
  {
    // The declared order is that of the documentation; deal.II would sort by name.
    prm.print_parameters(out,
                         dealii::ParameterHandler::PRM |
                           dealii::ParameterHandler::KeepDeclarationOrder);
  }



  std::string
  Scene::complete_entries() const
  {
    std::ostringstream text;
    prm.print_parameters(text,
                         dealii::ParameterHandler::ShortPRM |
                           dealii::ParameterHandler::KeepDeclarationOrder);
    return text.str();
  }



  ForestInput
  Scene::forest_input() const
  {
    ForestInput input;
    input.discretisation  = discretisation;
    input.refines         = refinement.changes_mesh();
    input.computes_ghosts = time_integration.runs_in_cycles();
    // Relative cost of a cell for the partitioning: nonlinear laws are evaluated in each iteration,
    // linear stiffness is assembled once per run.
    for (const BodyParameters &body : bodies)
      input.bodies.push_back(
        {body.name, body.geometry, body.material.linear() ? 1U : 3U, body.symmetry});
    for (const ContactPairParameters &pair : pairs)
      // Pairs tell the forest which boundaries meet.
      input.pairs.push_back({pair.section(),
                             body_index(pair.slave_body),
                             pair.slave_boundaries,
                             pair.master_body.empty() ? 0 : body_index(pair.master_body),
                             pair.master_boundaries,
                             pair.master_normal != MasterNormal::smoothed});
    return input;
  }



  unsigned int
  Scene::body_index(const std::string &name) const
  {
    const auto body = std::find_if(bodies.begin(), bodies.end(), [&name](const BodyParameters &b) {
      return b.name == name;
    });
    if (body == bodies.end())
      throw InputError("", "Bodies", "", "there is no body '" + name + "'", "");
    return body - bodies.begin();
  }



  bool
  Scene::has_friction() const
  {
    const auto has_law = [](const auto &pair) { return pair.friction != nullptr; };
    return std::any_of(pairs.begin(), pairs.end(), has_law) ||
           std::any_of(general.begin(), general.end(), has_law);
  }
} // namespace Touchstone
