// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/log.h>

#include <cerrno>
#include <cstring>
#include <ostream>

namespace Touchstone
{
  namespace
  {
    // The remedy of all write errors of the log.
    const char *const remedy =
      "Check the folder and the space on its disk, or choose another one with --output DIR.";
  } // namespace



  Log::Log(const OutputFolder &folder, std::ostream *terminal, const bool append)
    : folder(folder)
    , terminal(terminal)
  {
    folder.together([this, append]() {
      if (this->folder.rank != 0)
        return;
      const std::string path = this->folder.path("log");
      errno                  = 0;
      file.open(path, append ? std::ios::app : std::ios::trunc);
      if (!file)
        throw OutputError(path, std::strerror(errno), remedy);
    });
  }



  void
  Log::line(const std::string &text)
  {
    if (folder.rank != 0)
      return;
    if (terminal != nullptr)
      *terminal << text << std::endl;
    // std::endl flushes: the last lines are what matters if a run dies.
    file << text << std::endl;
  }



  void
  Log::check()
  {
    // line() does not throw, as the failure is on rank 0 alone: the state of the stream is checked
    // once per step, and the error thrown on all ranks together.
    folder.together([this]() {
      if (folder.rank == 0 && !file)
        throw OutputError(folder.path("log"), "a write failed", remedy);
    });
  }
} // namespace Touchstone
