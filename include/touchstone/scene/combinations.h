// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_combinations_h
#define touchstone_scene_combinations_h

namespace Touchstone
{
  class Scene;

  /**
   * @brief Refuse choices of different sections that do not go together.
   *
   * The one table of these rules. What a registered class can do is asked of its object
   * (LinearSolver::symmetric_only(), Enforcement::uses_multipliers()), not known by its name.
   * @throws InputError for the first rule that is broken.
   */
  void
  check_combinations(const Scene &scene);
} // namespace Touchstone

#endif
