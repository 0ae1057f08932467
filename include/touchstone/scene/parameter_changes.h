#ifndef touchstone_scene_parameter_changes_h
#define touchstone_scene_parameter_changes_h

#include <string>
#include <vector>

namespace Touchstone
{
  class Scene;

  /**
   * @brief Whether a run may go on with another value of a key: it says where results go,
   * or how exactly and by which way they are found, but not what they are.
   *
   * The one list of these keys. What is not on it changes the answer.
   */
  bool
  may_change(const std::string &section, const std::string &key);

  /**
   * @brief Refuse to go on with a scene that is not the one that was stopped.
   *
   * Values are compared as text and, where they are numbers, as numbers.
   * @param before Scene::complete_entries() of the run that was stopped.
   * @param time   At which it goes on: the end must not lie before it.
   * @return lines on what has changed and may.
   * @throws InputError with section, key and both values.
   */
  std::vector<std::string>
  compare_parameters(const std::string &before, const Scene &scene, double time);
} // namespace Touchstone

#endif
