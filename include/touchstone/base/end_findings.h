// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_end_findings_h
#define touchstone_base_end_findings_h

#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief What a check of the last state of a run finds, in words. */
  struct EndFindings
  {
    std::vector<std::string> warnings;
    /** Why the result cannot be right; empty if nothing speaks against it. */
    std::string failure;

    /** @brief Add a finding, a failure or a warning. The first failure is the reason, later ones
     * are warnings. */
    void
    add(const std::string &what, const bool fails)
    {
      if (fails && failure.empty())
        failure = what;
      else
        warnings.push_back(what);
    }
  };
} // namespace Touchstone

#endif
