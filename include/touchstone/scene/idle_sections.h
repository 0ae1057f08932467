// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_idle_sections_h
#define touchstone_scene_idle_sections_h

#include <string>
#include <vector>

namespace Touchstone
{
  class Scene;
  class SceneText;

  /**
   * @brief Take the subsections 'Friction' out of pairs without friction, so that friction can be
   * switched off by the key 'Behaviour' alone.
   *
   * @param scene With its keys declared.
   * @return a sentence on each, for the user.
   * @throws InputError for a key that no friction law has: it may be a misspelt one of the pair.
   */
  std::vector<std::string>
  take_idle_friction(const Scene &scene, SceneText &text);

  /** @brief A section, or one of its keys, that has no effect if @p idle. */
  struct IdleRule
  {
    bool        idle;
    std::string section;
    /** Empty: the whole section. */
    std::string key;
    std::string reason;
  };

  /** @brief The rules of all sections but 'Friction'. @param scene Its entries are set. */
  std::vector<IdleRule>
  idle_rules(const Scene &scene);

  /**
   * @brief A sentence on each other section, and each key of another section, that is changed but
   * has no effect.
   * @param defaults, complete The short listing of the scene before and after its entries were set.
   */
  std::vector<std::string>
  idle_entries(const Scene &scene, const std::string &defaults, const std::string &complete);
} // namespace Touchstone

#endif
