// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_parameter_changes_h
#define touchstone_scene_parameter_changes_h

#include <string>
#include <vector>

namespace Touchstone
{
  class Scene;

  /**
   * @brief Whether a run may be resumed with another value of a key: one that decides where
   * results are written, or how accurately and by which method they are computed, but not
   * what they are.
   *
   * The one list of these keys. All others change the answer.
   */
  bool
  may_change(const std::string &section, const std::string &key);

  /**
   * @brief Refuse to resume with a scene that differs from that of the checkpoint.
   *
   * Values are compared as text and, where they are numbers, as numbers.
   * @param before Scene::complete_entries() of the run that wrote the checkpoint.
   * @param time   Of the checkpoint: the end time must not lie before it.
   * @return lines on the changes that are allowed.
   * @throws InputError with section, key and both values.
   */
  std::vector<std::string>
  compare_parameters(const std::string &before, const Scene &scene, double time);
} // namespace Touchstone

#endif
