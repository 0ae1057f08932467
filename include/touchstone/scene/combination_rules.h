// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_combination_rules_h
#define touchstone_scene_combination_rules_h

#include <string>
#include <vector>

/**
 * @file
 * The tables of combinations that are refused (check_combinations()). Each key is valid by itself
 * (the check() of its section has passed); these rules find combinations that no single section
 * can see. They are tables rather than code, so that each rule reads as one entry: condition, key,
 * problem, remedy. All are checked before the mesh is made.
 */
namespace Touchstone
{
  struct BodyParameters;
  struct ContactPairParameters;
  class Scene;

  /** @brief A combination that is refused if @p broken, with the parts of the InputError. */
  struct CombinationRule
  {
    bool        broken;
    std::string section, key, value, problem, remedy;
  };

  /** @brief Element types but 'full' are for degree 1, and for small or for finite strain, see
   * doc/theory.md 2.1 and 2.2. */
  std::vector<CombinationRule>
  element_rules(const Scene &scene, const BodyParameters &body);

  /** @brief Pressure that turns with a surface needs stresses that do (doc/theory.md 2.3). */
  std::vector<CombinationRule>
  pressure_rules(const BodyParameters &body);

  /** @brief Errors of contact forces are estimated in statics, of linear bodies (doc/theory.md 11).
   */
  std::vector<CombinationRule>
  estimate_rules(const Scene &scene);

  /** @brief Inertia needs densities; initial velocities and damping need inertia. */
  std::vector<CombinationRule>
  inertia_rules(const Scene &scene, const BodyParameters &body);

  /** @brief Explicit dynamics (doc/explicit.md, section 1), and what only that has. @{ */
  std::vector<CombinationRule>
  cycle_rules(const Scene &scene);
  std::vector<CombinationRule>
  cycle_rules(const Scene &scene, const BodyParameters &body);
  /** @} */

  /** @brief Tied pairs do not slide, and Gregory patches (doc/theory.md 4, "Smoothing") exist for
   * bilinear faces only. */
  std::vector<CombinationRule>
  pair_rules(const Scene &scene, const ContactPairParameters &pair);

  /** @brief Pairings of cells (doc/theory.md 3.5): their rows have no slave node of their own that
   * could be eliminated or projected to. */
  std::vector<CombinationRule>
  ball_rules(const Scene &scene, const ContactPairParameters &pair);

  /** @brief Mesh, mass, enforcement and linear solver: a partitioner that cannot refine,
   * multipliers for a solver that needs a definite matrix, an unsymmetric tangent for one that
   * needs a symmetric matrix. */
  std::vector<CombinationRule>
  method_rules(const Scene &scene);
} // namespace Touchstone

#endif
