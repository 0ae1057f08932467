// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_suggestion_h
#define touchstone_base_suggestion_h

#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief The candidate that @p word was probably meant to be, by the number
   * of letters to change; empty if none is near. Case does not count. */
  std::string
  closest(const std::string &word, const std::vector<std::string> &candidates);

  /** @brief ", did you mean 'X'?" for the closest candidate, or nothing. */
  std::string
  did_you_mean(const std::string &word, const std::vector<std::string> &candidates);

  /** @brief The names in quotation marks and with commas: "'a', 'b', 'c'". */
  std::string
  quoted_list(const std::vector<std::string> &names);
} // namespace Touchstone

#endif
