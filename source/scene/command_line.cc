// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/suggestion.h>
#include <touchstone/scene/command_line.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

/**
 * @file
 * Command line and scene file: the first input that is read. Unknown options, missing values and
 * unreadable files end the program with exit code 1 before anything is allocated. All ranks parse
 * the same arguments and come to the same result.
 */

namespace Touchstone
{
  namespace
  {
    const char *const section = "command line";

    /**
     * Arguments of the environment variable TOUCHSTONE_OPTIONS, then those of the command line: of
     * options given twice the later one counts, so the command line overrides the environment.
     */
    std::vector<std::string>
    collect_arguments(const int argc, const char *const *argv)
    {
      std::vector<std::string> arguments;
      if (const char *environment = std::getenv("TOUCHSTONE_OPTIONS"))
        {
          std::istringstream words(environment);
          for (std::string word; words >> word;)
            arguments.push_back(word);
        }
      arguments.insert(arguments.end(), argv + (argc > 0 ? 1 : 0), argv + argc);
      return arguments;
    }
  } // namespace



  CommandLine
  CommandLine::parse(const int argc, const char *const *argv)
  {
    const std::vector<std::string> arguments = collect_arguments(argc, argv);

    CommandLine                         line;
    const std::map<std::string, bool *> switches = {{"--help", &line.help},
                                                    {"-h", &line.help},
                                                    {"--version", &line.version},
                                                    {"--validate", &line.validate},
                                                    {"--preview", &line.preview},
                                                    {"--print-parameters", &line.print_parameters},
                                                    {"--print-own-keys", &line.print_own_keys},
                                                    {"--results-only", &line.results_only},
                                                    {"--resume", &line.resume}};

    for (std::size_t i = 0; i < arguments.size(); ++i)
      {
        const std::string &argument = arguments[i];
        // Options take their value as "--set X=1" or as "--set=X=1"; only the first '=' separates.
        const std::size_t equals = argument.find('=');
        const std::string option = argument.substr(0, equals);
        // What is no option is the scene file. Two of them usually come from a value with blanks
        // that lacks quotation marks.
        if (argument.empty() || argument[0] != '-')
          {
            if (!line.scene_file.empty() || argument.empty())
              throw InputError(section,
                               "",
                               argument,
                               "a run has one scene file, and '" + line.scene_file +
                                 "' is already given",
                               "start one run per scene; a value with blanks needs "
                               "quotation marks: --set \"Section/Key=value\"");
            line.scene_file = argument;
          }
        else if (option == "--set" || option == "--output" || option == "--export-model")
          {
            std::string value;
            if (equals != std::string::npos)
              value = argument.substr(equals + 1);
            else if (i + 1 < arguments.size())
              value = arguments[++i];
            if (value.empty())
              throw InputError(section,
                               option,
                               "",
                               "this option lacks its value",
                               option == "--set"      ? "write --set \"Section/Key=value\""
                               : option == "--output" ? "write --output FOLDER"
                                                      : "write --export-model FILE");
            if (option == "--export-model")
              line.export_model = value;
            else
              // --output is an override of a key like any other: later ones win, and the printed
              // scene shows it.
              line.overrides.push_back(option == "--set" ? value : "Output/Directory=" + value);
          }
        else if (equals == std::string::npos && switches.count(option) > 0)
          *switches.at(option) = true;
        else
          {
            std::vector<std::string> known = {"--set", "--output", "--export-model"};
            for (const auto &[name, flag] : switches)
              if (name != "-h")
                known.push_back(name);
            throw InputError(section,
                             argument,
                             "",
                             "there is no such option" + did_you_mean(option, known),
                             "'touchstone --help' lists the options");
          }
      }

    if (line.scene_file.empty() && !line.help && !line.version && !line.print_own_keys)
      throw InputError(section,
                       "",
                       "",
                       "the scene file is missing",
                       "write: touchstone [options] scene.prm; 'touchstone --help' "
                       "lists the options");
    return line;
  }



  std::string
  CommandLine::usage()
  {
    return "Usage: touchstone [options] scene.prm\n"
           "       mpirun -n 2 touchstone [options] scene.prm\n"
           "\n"
           "Solves the contact problem of the scene file. The exit code is 0 only\n"
           "if every step converged.\n"
           "\n"
           "  --validate              check the scene, mesh and boundaries, then stop\n"
           "  --preview               write the meshes with the names of boundaries, and a\n"
           "                          drawing, into the output folder, then stop\n"
           "  --print-parameters      print the complete scene with all keys, then stop\n"
           "  --print-own-keys        print the keys that only some choices have, of laws,\n"
           "                          pairings and the like, then stop\n"
           "  --set \"Section/Key=value\"  change one key of the scene; can be repeated\n"
           "  --output FOLDER         write there instead of to output/STEM\n"
           "  --resume                go on from the newest checkpoint in the output folder;\n"
           "                          section \"Checkpoints\" has them written\n"
           "  --export-model FILE     write mesh, supports, loads and contact surfaces as\n"
           "                          JSON for other programs, then stop\n"
           "  --results-only          print nothing but the results\n"
           "  --version               print the version, then stop\n"
           "  --help                  print this text, then stop\n"
           "\n"
           "The environment variable TOUCHSTONE_OPTIONS holds options that come\n"
           "before those of the command line.\n";
  }



  namespace
  {
    /** The text of a file. @p refuse throws what is wrong with it, and a remedy. */
    template <class Refuse>
    std::string
    read_text(const std::string &name, const Refuse &refuse)
    {
      // iostreams do not report why they failed; errno usually tells, if it was cleared before.
      errno = 0;
      std::ifstream      file(name, std::ios::binary);
      std::ostringstream content;
      // A folder opens without an error and fails at the first read only, hence peek(). An empty
      // file sets eof(), which is no failure of reading.
      const bool was_read =
        file && (file.peek(), !file.bad()) && (file.eof() || (content << file.rdbuf()));
      if (!was_read)
        refuse(std::string("cannot be read: ") + std::strerror(errno == 0 ? EIO : errno),
               "check the name and the permissions of the file");
      const std::string text = content.str();
      if (text.empty())
        refuse("is empty", "give another");
      // Binary files, such as meshes, have zero bytes.
      if (text.find('\0') != std::string::npos)
        refuse("is not a text file", "give a scene file, whose name usually ends in .prm");
      return text;
    }
  } // namespace



  std::string
  read_scene_file(const std::string &name)
  {
    return read_text(name, [&name](const std::string &problem, const std::string &remedy) {
      throw InputError(section,
                       "",
                       name,
                       (problem == "is not a text file" ? "this " : "this scene file ") + problem,
                       remedy);
    });
  }



  std::string
  read_included_file(const std::string &name,
                     const std::string &open_section,
                     const std::string &location)
  {
    return read_text(name, [&](const std::string &problem, const std::string &remedy) {
      throw InputError(open_section,
                       "",
                       name,
                       "the included file " + problem + " (" + location + ")",
                       remedy + "; names are relative to the file that includes");
    });
  }
} // namespace Touchstone
