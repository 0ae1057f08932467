// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/warnings.h>

#include <algorithm>

namespace Touchstone
{
  Warnings::Warnings(Log &log)
    : log(log)
  {
  }



  void
  Warnings::add(const std::string &text)
  {
    // A warning that repeats itself in each step is shown once.
    if (std::find(texts.begin(), texts.end(), text) != texts.end())
      return;
    texts.push_back(text);
    log.line("  Warning: " + text);
  }



  const std::vector<std::string> &
  Warnings::list() const
  {
    return texts;
  }



  void
  Warnings::restore(const std::vector<std::string> &earlier)
  {
    // Not reported again: they are in the log of the run that is resumed.
    texts = earlier;
  }



  void
  Warnings::repeat() const
  {
    // Repeated at the end of the log, where they are seen.
    if (texts.empty())
      return;
    log.line(texts.size() == 1 ? "1 warning:" : std::to_string(texts.size()) + " warnings:");
    for (const std::string &text : texts)
      log.line("  " + text);
  }
} // namespace Touchstone
