// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_scene_entries_h
#define touchstone_scene_scene_entries_h

#include <touchstone/scene/scene_text.h>

#include <deal.II/base/parameter_handler.h>

namespace Touchstone
{
  /**
   * @brief Give every entry of a scene to the handler, which hands it to the
   * members that it was declared with.
   *
   * @throws InputError for a subsection or key that is not declared (with the
   * nearest that is), for a value that its pattern refuses, and for a required
   * key that is not set.
   */
  void
  set_entries(const SceneText &text, dealii::ParameterHandler &prm);
} // namespace Touchstone

#endif
