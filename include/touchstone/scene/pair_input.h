// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_pair_input_h
#define touchstone_scene_pair_input_h

#include <touchstone/contact/contact_pair.h>
#include <touchstone/explicit/general/impact_surface.h>

#include <vector>

namespace Touchstone
{
  class Scene;

  /** @brief Input of a contact pair of a scene. @param number Index of the pair. */
  ContactPairInput
  pair_input(const Scene &scene, const Forest &forest, const Solid &solid, unsigned int number);

  /** @brief The same for all pairs, in their order. */
  std::vector<ContactPairInput>
  pair_inputs(const Scene &scene, const Forest &forest, const Solid &solid);

  /** @brief The surface of the general contact of a scene that has one.
   * @throws InputError for boundaries that do not exist. */
  ImpactSurfaceInput
  general_contact_input(const Scene &scene, const Forest &forest);
} // namespace Touchstone

#endif
