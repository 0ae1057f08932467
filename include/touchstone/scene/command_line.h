// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_command_line_h
#define touchstone_scene_command_line_h

#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief Options of the command line. */
  struct CommandLine
  {
    bool help             = false;
    bool version          = false;
    bool validate         = false;
    bool preview          = false;
    bool print_parameters = false;
    /** Print the keys that only some choices of a scene have. */
    bool print_own_keys = false;
    /** Print nothing but the results, which do not depend on the machine. */
    bool results_only = false;
    /** Resume from the newest checkpoint in the output folder. */
    bool resume = false;
    /** Entries "Section/Key=value"; "--output DIR" is one of them. */
    std::vector<std::string> overrides;
    std::string              scene_file;
    /** File for the model of the scene; empty: solve the scene. */
    std::string export_model;

    /**
     * @brief Read the options of the environment variable TOUCHSTONE_OPTIONS,
     * which has blanks between them, and then the arguments of main().
     * @throws InputError for options that are unknown or lack their value, and
     * if there is not exactly one scene file (none with help, version or own keys).
     */
    static CommandLine
    parse(int argc, const char *const *argv);

    /** @brief The text of --help. */
    static std::string
    usage();
  };

  /** @brief The contents of a scene file.
   * @throws InputError if it cannot be read, is empty or is not text. */
  std::string
  read_scene_file(const std::string &name);

  /** @brief The contents of a file that another one includes.
   * @param section  The subsections that are open there, for messages.
   * @param location File and line that include it, for messages.
   * @throws InputError as read_scene_file(). */
  std::string
  read_included_file(const std::string &name,
                     const std::string &section,
                     const std::string &location);
} // namespace Touchstone

#endif
