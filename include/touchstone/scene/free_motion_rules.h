// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_free_motion_rules_h
#define touchstone_scene_free_motion_rules_h

namespace Touchstone
{
  class Scene;

  /** @brief Refuse obstacles that are moved by forces where the rest of the scene does not go with
   * them. @throws InputError */
  void
  check_free_motions(const Scene &scene);
} // namespace Touchstone

#endif
