// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_scene_h
#define touchstone_scene_scene_h

#include <touchstone/algebra/solver_parameters.h>
#include <touchstone/archive/checkpoint_parameters.h>
#include <touchstone/contact/contact_parameters.h>
#include <touchstone/drive/load_stepping_parameters.h>
#include <touchstone/drive/newton_parameters.h>
#include <touchstone/drive/refinement_parameters.h>
#include <touchstone/drive/time_parameters.h>
#include <touchstone/explicit/general/general_contact_parameters.h>
#include <touchstone/mesh/discretisation_parameters.h>
#include <touchstone/mesh/forest.h>
#include <touchstone/mesh/obstacle_parameters.h>
#include <touchstone/output/output_parameters.h>
#include <touchstone/output/probe_parameters.h>
#include <touchstone/solid/body_parameters.h>
#include <touchstone/verification/reference_parameters.h>

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  class SceneText;

  /**
   * @brief Everything a scene file says, read, complete and checked.
   *
   * The lists "Bodies", "Contact pairs" and "Obstacles" name the subsections
   * "Body NAME", "Contact pair NAME" and "Obstacle NAME" that follow.
   */
  class Scene
  {
  public:
    std::string                        title;
    std::vector<BodyParameters>        bodies;
    std::vector<ObstacleParameters>    obstacles;
    std::vector<ContactPairParameters> pairs;
    /** At most one: what names no other side, in explicit dynamics. */
    std::vector<GeneralContactParameters> general;
    DiscretisationParameters              discretisation;
    ContactParameters                     contact;
    RefinementParameters                  refinement;
    LoadSteppingParameters                load_stepping;
    TimeIntegrationParameters             time_integration;
    NewtonParameters                      newton;
    LinearSolverParameters                linear_solver;
    OutputParameters                      output;
    std::vector<ProbeParameters>          probes;
    ReferenceParameters                   reference;
    CheckpointParameters                  checkpoints;
    /** Sentences on sections that are given and have no effect. */
    std::vector<std::string> without_effect;

    /**
     * @brief Read a scene file and the overrides of the command line.
     * @param text      The contents of the scene file.
     * @param file_name Its name, for messages, relative mesh files and the
     *                  default output folder.
     * @param overrides Entries "Section/Sub section/Key=value".
     * @throws InputError with section, key, value and remedy.
     */
    Scene(const std::string              &text,
          const std::string              &file_name,
          const std::vector<std::string> &overrides);

    Scene(const Scene &) = delete;
    Scene &
    operator=(const Scene &) = delete;

    /** @brief All parameters with their defaults and documentation, in a form
     * that can be read back. */
    void
    print(std::ostream &out) const;

    /** @brief The same without documentation, a text to be kept and compared. */
    std::string
    complete_entries() const;

    /** @brief Input of the forest. */
    ForestInput
    forest_input() const;

    /** @brief Number of the body called @p name. */
    unsigned int
    body_index(const std::string &name) const;

    /** @brief Whether anything may touch. */
    bool
    has_contact() const
    {
      return !pairs.empty() || !general.empty();
    }

    /** @brief Whether any pair has friction. */
    bool
    has_friction() const;

  private:
    dealii::ParameterHandler prm;

    /** Make the bodies, obstacles and pairs that the lists name. */
    void
    read_lists(const SceneText &text);
    /** Bind every entry to its member. */
    void
    declare(const SceneText &text);
    /** Replace automatic choices by what they choose. */
    void
    resolve(const SceneText &text, const std::string &file_name);
    /** End time and number of steps from the phases. @throws InputError if they are set otherwise.
     */
    void
    resolve_phases(const SceneText &text);
    /** Contact pairs for each wall of obstacles that consist of such, see ObstacleShape::walls().
     */
    void
    separate_walls();
    /** Each section, then what goes across sections (combinations.h). */
    void
    check() const;
    void
    check_pair(const ContactPairParameters &pair) const;
    void
    check_general(const GeneralContactParameters &general) const;
    /** The reference solution, and that formulas are given only where it uses them. */
    void
    check_reference() const;
    /** Formulas of the time alone have finite values at the ends of all steps. */
    void
    check_formulas() const;
  };
} // namespace Touchstone

#endif
