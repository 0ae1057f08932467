// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_declared_entries_h
#define touchstone_scene_declared_entries_h

#include <touchstone/scene/scene_text.h>

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief Declared keys by the path of their section. */
  using Declared = std::map<std::string, std::vector<std::string>>;

  /** @brief Sections and keys that a scene may have. */
  Declared
  declared_entries(const dealii::ParameterHandler &prm);

  /** @brief Report a section that is not declared. @param location Of it, for the message. @throws
   * InputError that says what there is. */
  [[noreturn]] void
  throw_unknown_section(const Declared    &declared,
                        const std::string &section,
                        const std::string &location);

  /** @brief The same for a key. */
  [[noreturn]] void
  throw_unknown_key(const Declared &declared, const SceneEntry &entry, const std::string &location);
} // namespace Touchstone

#endif
