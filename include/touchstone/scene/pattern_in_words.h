// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_pattern_in_words_h
#define touchstone_scene_pattern_in_words_h

#include <string>

namespace Touchstone
{
  /** @brief A remedy in words, from deal.II's description of a @p pattern that @p value does not
   * match. */
  std::string
  remedy_for_pattern(const std::string &pattern, const std::string &value);
} // namespace Touchstone

#endif
