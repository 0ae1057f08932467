// SPDX-License-Identifier: LGPL-2.1-or-later
// Options, and what is said to those that do not exist.

#include <touchstone/base/input_error.h>
#include <touchstone/scene/command_line.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

using namespace Touchstone;

namespace
{
  void
  try_line(std::vector<const char *> arguments)
  {
    std::cout << "* touchstone";
    for (const char *argument : arguments)
      std::cout << ' ' << argument;
    std::cout << "\n  ";
    arguments.insert(arguments.begin(), "touchstone");
    try
      {
        const CommandLine line = CommandLine::parse(arguments.size(), arguments.data());
        std::cout << "scene '" << line.scene_file << "'" << (line.help ? ", help" : "")
                  << (line.version ? ", version" : "") << (line.validate ? ", validate" : "")
                  << (line.print_parameters ? ", print parameters" : "")
                  << (line.results_only ? ", results only" : "") << (line.resume ? ", resume" : "");
        if (!line.export_model.empty())
          std::cout << ", export model '" << line.export_model << "'";
        for (const std::string &override_text : line.overrides)
          std::cout << ", [" << override_text << "]";
        std::cout << std::endl;
      }
    catch (const InputError &error)
      {
        std::cout << error.what() << std::endl;
      }
  }

  void
  try_file(const std::string &name)
  {
    std::cout << "* file " << name << "\n  ";
    try
      {
        std::cout << read_scene_file(name).size() << " characters" << std::endl;
      }
    catch (const InputError &error)
      {
        std::cout << error.what() << std::endl;
      }
  }
} // namespace

int
main()
{
  unsetenv("TOUCHSTONE_OPTIONS"); // the tests of scenes are run with it
  try_line({"x.prm"});
  try_line({"--validate", "x.prm", "--print-parameters"});
  try_line({"--set", "A/B=1", "--set=C = 2", "x.prm", "--output", "here"});
  try_line({"--output=there", "x.prm", "--results-only"});
  try_line({"--export-model", "model.json", "x.prm"});
  try_line({"x.prm", "--export-model"});
  try_line({"--help"});
  try_line({"-h"});
  try_line({"--version"});
  try_line({});
  try_line({"--validate"});
  try_line({"x.prm", "y.prm"});
  try_line({"--valdate", "x.prm"});
  try_line({"--validate=yes", "x.prm"});
  try_line({"-x", "x.prm"});
  try_line({"x.prm", "--set"});
  try_line({"x.prm", "--output="});
  try_line({"--resume", "x.prm"});

  setenv("TOUCHSTONE_OPTIONS", "--results-only  --output results", 1);
  try_line({"x.prm", "--output", "mine"});

  std::ofstream("scene.txt") << "set Title = x\n";
  std::ofstream("empty.txt");
  std::ofstream("binary.txt") << std::string("a\0b", 3);
  try_file("scene.txt");
  try_file("empty.txt");
  try_file("binary.txt");
  try_file("missing.prm");
  try_file(".");
  return 0;
}
