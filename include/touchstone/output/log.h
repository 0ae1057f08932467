// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_log_h
#define touchstone_output_log_h

#include <touchstone/base/folder.h>

#include <fstream>
#include <iosfwd>
#include <string>

namespace Touchstone
{
  /** @brief Lines for the user, on the terminal and in the file `log`. */
  class Log
  {
  public:
    /**
     * @param folder   Must outlive this object.
     * @param terminal Where lines are shown as well; null shows nothing.
     * @param append   Go on with a file that is there.
     * @throws OutputError if the file cannot be opened. Collective.
     */
    Log(const OutputFolder &folder, std::ostream *terminal, bool append = false);

    /** @brief Write one line, or several separated by newlines. Only rank 0
     * does, the others may call or not. A failing write is not reported here,
     * since this is not collective, but by check(). */
    void
    line(const std::string &text = "");

    /** @brief Collective. @throws OutputError if a line could not be written. */
    void
    check();

  private:
    const OutputFolder &folder;
    std::ostream       *terminal;
    std::ofstream       file;
  };
} // namespace Touchstone

#endif
