// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/scene/command_line.h>
#include <touchstone/scene/scene_text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>

/**
 * @file
 * The format of scene files: deal.II's .prm, parsed here once more. ParameterHandler reads such
 * files as well, but not before all entries are declared, and which entries there are depends on
 * the file. The parser keeps the line of every entry for messages.
 */

namespace Touchstone
{
  using dealii::Utilities::trim;

  namespace
  {
    /** Several blanks between words count as one, as in ParameterHandler. */
    std::string
    single_blanks(const std::string &text)
    {
      std::istringstream words(text);
      std::string        result, word;
      while (words >> word)
        result += (result.empty() ? "" : " ") + word;
      return result;
    }

    /**
     * Remove the keyword @p word, in upper or lower case, from the beginning of @p line. @return
     * whether it was there.
     */
    bool
    take_word(std::string &line, const std::string &word)
    {
      std::istringstream stream(line);
      std::string        first;
      stream >> first;
      for (char &c : first)
        c = std::tolower(static_cast<unsigned char>(c));
      if (first != word)
        return false;
      line = trim(line.substr(word.size()));
      return true;
    }
  } // namespace



  void
  SceneText::read_file(const std::string        &text,
                       const std::string        &name,
                       std::vector<std::string> &path)
  {
    open_files.push_back({name, std::filesystem::weakly_canonical(name).string()});
    const std::size_t  outside = path.size();
    std::istringstream stream(text);
    std::string        line, physical;
    unsigned int       number = 0, first = 0;
    while (std::getline(stream, physical))
      {
        places.emplace_back(name, ++number);
        if (number == 1 && physical.compare(0, 3, "\xEF\xBB\xBF") == 0)
          physical.erase(0, 3); // the mark with which some editors begin UTF-8
        if (line.empty())
          // The line on which a (continued) entry starts.
          first = places.size();
        // A comment ends with its physical line, even if a backslash precedes the line break. A
        // continued line has the number of its first part in messages.
        physical           = trim(physical.substr(0, physical.find('#')));
        const bool goes_on = !physical.empty() && physical.back() == '\\';
        if (goes_on)
          physical.pop_back();
        line += physical;
        if (goes_on)
          continue;
        const std::string whole = trim(line);
        line.clear();
        read_line(whole, first, path);
        if (path.size() < outside)
          throw InputError(join_path(path),
                           "",
                           whole,
                           "the subsection that this closes was opened in a file that includes "
                           "this one (" +
                             location(first) + ")",
                           "close each subsection in the file that opens it");
      }
    if (!line.empty())
      read_line(trim(line), first, path);
    open_files.pop_back();
    if (path.size() > outside)
      {
        const std::string section = join_path(path);
        throw InputError(section,
                         "",
                         "",
                         "the subsection that begins in " + location(all_sections.at(section)) +
                           " is not closed",
                         "write 'end' after its last entry");
      }
  }



  void
  SceneText::read_line(const std::string        &line,
                       const unsigned int        number,
                       std::vector<std::string> &path)
  {
    std::string rest = line;
    if (rest.empty())
      return;

    const std::string section = join_path(path);
    if (take_word(rest, "subsection"))
      {
        const std::string name = single_blanks(rest);
        if (name.empty() || name.find('/') != std::string::npos)
          throw InputError(section,
                           "",
                           line,
                           "this is no name for a subsection (" + location(number) + ")",
                           "write 'subsection NAME' with a NAME that has no '/'");
        path.push_back(name);
        note_section(join_path(path), number);
      }
    else if (take_word(rest, "end"))
      {
        if (!rest.empty())
          throw InputError(section,
                           "",
                           line,
                           "something follows after 'end' (" + location(number) + ")",
                           "write 'end' on a line of its own");
        if (path.empty())
          throw InputError("",
                           "",
                           line,
                           "no subsection is open that this could close (" + location(number) + ")",
                           "remove this 'end' or look for one too many before it");
        path.pop_back();
      }
    else if (take_word(rest, "set"))
      read_key(rest, number, section);
    else if (take_word(rest, "include"))
      include(rest, number, path);
    else
      throw InputError(section,
                       "",
                       line,
                       "this line cannot be read (" + location(number) + ")",
                       "a line is 'set KEY = VALUE', 'subsection NAME', 'end', 'include FILE' or "
                       "a comment that begins with '#'");
  }



  void
  SceneText::read_key(const std::string &line,
                      const unsigned int number,
                      const std::string &section)
  {
    const std::size_t equals = line.find('=');
    // Only the first '=' separates: values are formulas and may contain comparisons.
    const std::string key = single_blanks(line.substr(0, equals));
    if (equals == std::string::npos || key.empty())
      throw InputError(section,
                       "",
                       "set " + line,
                       "this line cannot be read (" + location(number) + ")",
                       "write 'set KEY = VALUE'");
    const std::string  value = trim(line.substr(equals + 1));
    const unsigned int depth = open_files.size() - 1;
    if (section.empty() && key == "Constants")
      {
        all_constants.define(value, depth, location(number));
        return;
      }
    // Two values for one key in a file are an oversight; the command line may override, and a file
    // may override what it has included before.
    const SceneEntry *other = find(section, key);
    if (other != nullptr && other->depth <= depth)
      throw InputError(section,
                       key,
                       value,
                       "this key is set twice, in " + location(other->line) + " and " +
                         location(number),
                       other->depth < depth
                         ? "keep one of them; a file may change a key that it has included before, "
                           "not the other way round"
                         : "keep one of them");
    all_entries.push_back({section, key, value, number, depth});
  }



  void
  SceneText::include(const std::string        &file,
                     const unsigned int        number,
                     std::vector<std::string> &path)
  {
    namespace fs              = std::filesystem;
    const std::string section = join_path(path);
    const auto        refuse  = [&](const std::string &problem, const std::string &remedy) {
      throw InputError(
        section, "", "include " + file, problem + " (" + location(number) + ")", remedy);
    };
    if (file.empty())
      refuse("there is no file name", "write 'include FILE'");
    // Named relative to the file that includes it: a folder of scenes can be moved as a whole.
    const std::string name =
      (fs::path(open_files.back().name).parent_path() / file).lexically_normal().string();
    const std::string canonical = fs::weakly_canonical(name).string();
    std::string       way;
    for (const OpenFile &open : open_files)
      if (!way.empty() || open.canonical_name == canonical)
        way += open.name + " includes ";
    if (!way.empty())
      refuse("this file includes itself: " + way + name, "remove one of these lines");
    read_file(read_included_file(name, section, location(number)), name, path);
  }



  void
  SceneText::read_override(const std::string &text)
  {
    const std::size_t        equals = text.find('=');
    std::vector<std::string> path   = split_path(text.substr(0, equals));
    // The path ends at the first '=', so values may contain further ones.
    bool is_bad = equals == std::string::npos || path.empty() || text[equals - 1] == '/';
    for (std::string &part : path)
      {
        part   = single_blanks(part);
        is_bad = is_bad || part.empty();
      }
    if (is_bad)
      throw InputError("command line",
                       "--set",
                       text,
                       "this override cannot be read",
                       "write --set \"Section/Subsection/Key=value\", or "
                       "--set \"Key=value\" for a key outside of all sections");
    if (text.find_first_of("#\n", equals) != std::string::npos)
      throw InputError("command line",
                       "--set",
                       text,
                       "a value cannot contain '#' or the end of a line, which "
                       "would not survive in a scene file",
                       "give a value without them");

    const std::string key = path.back();
    path.pop_back();
    const std::string section = join_path(path);
    if (section.empty() && key == "Constants")
      {
        all_constants.define(text.substr(equals + 1), -1, location(0));
        return;
      }
    if (!section.empty())
      // Overrides have line 0: location() then says "command line".
      note_section(section, 0);
    all_entries.push_back({section, key, trim(text.substr(equals + 1)), 0, 0});
  }
} // namespace Touchstone
