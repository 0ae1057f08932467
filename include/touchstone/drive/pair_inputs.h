#ifndef touchstone_drive_pair_inputs_h
#define touchstone_drive_pair_inputs_h

#include <touchstone/contact/contact_pair.h>
#include <touchstone/scene/scene.h>

#include <vector>

namespace Touchstone
{
  /** @brief What the contact pairs of a scene are made from, in their order. */
  std::vector<ContactPairInput>
  pair_inputs(const Scene &scene, const Forest &forest, const Solid &solid);
} // namespace Touchstone

#endif
