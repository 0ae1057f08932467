// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/preview.h>

#include <cerrno>
#include <spawn.h>
#include <sys/wait.h>

extern char **environ;

// The drawing of a preview as an image, by a program that is not part of this one.
namespace Touchstone
{
  namespace
  {
    /** Run a program that is looked for in PATH. @return its exit code, or -1 if it could not be
     * started. */
    int
    run(std::vector<std::string> words)
    {
      std::vector<char *> arguments;
      for (std::string &word : words)
        arguments.push_back(word.data());
      arguments.push_back(nullptr);
      pid_t process;
      if (posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0)
        return -1;
      int status = 0;
      while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR)
          return -1;
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
  } // namespace



  bool
  draw_image(const std::string &drawing, const std::string &image)
  {
    return run({"rsvg-convert", "--zoom=1.5", "--output=" + image, drawing}) == 0;
  }
} // namespace Touchstone
