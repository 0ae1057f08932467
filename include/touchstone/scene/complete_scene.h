// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_complete_scene_h
#define touchstone_scene_complete_scene_h

#include <string>

namespace Touchstone
{
  class Scene;

  /** @brief The scene with all defaults, so that a result can be reproduced from any folder, and
   * with a version whose defaults differ.
   * @param folder Folder of the scene file, to which names of files in the scene are relative; here
   *   they are absolute. */
  std::string
  complete_scene(const Scene &scene, const std::string &folder);
} // namespace Touchstone

#endif
