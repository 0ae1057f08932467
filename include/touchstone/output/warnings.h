// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_warnings_h
#define touchstone_output_warnings_h

#include <touchstone/output/log.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief What the user should know of a run that has results: told when it happens,
   * and again at the end, in the log and in summary.json. */
  class Warnings
  {
  public:
    /** @param log Must outlive this object. */
    explicit Warnings(Log &log);

    /** @brief Report @p text, unless it has been reported already. To be called on all ranks. */
    void
    add(const std::string &text);

    /** @brief All of them, in the order in which they came. */
    const std::vector<std::string> &
    list() const;

    /** @brief Set the warnings of the run that is resumed. */
    void
    restore(const std::vector<std::string> &earlier);

    /** @brief Report all of them again. */
    void
    repeat() const;

  private:
    Log                     &log;
    std::vector<std::string> texts;
  };
} // namespace Touchstone

#endif
