// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_scene_text_h
#define touchstone_scene_scene_text_h

#include <touchstone/scene/constants.h>

#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief One "set KEY = VALUE" of a scene file or of the command line. */
  struct SceneEntry
  {
    /** Subsections joined by "/"; empty at the top level. */
    std::string section;
    std::string key;
    std::string value;
    /** Line of the scene file, counted on through the files that it includes (location() says
     * which it is); 0 for an override of the command line. */
    unsigned int line;
    /** How many files include the one that the entry stands in. */
    unsigned int depth = 0;
  };

  /**
   * @brief A scene file and its overrides taken apart into entries.
   *
   * The syntax is that of deal.II's ParameterHandler. The lines are read here
   * and not there because a message that helps needs the section, the key and
   * the line all at once, and because the names of the subsections are only
   * known when the lists that name them have been read.
   *
   * 'include FILE' reads another file in its place. A key that it sets may be
   * set once more by the file that includes it, after that line.
   */
  class SceneText
  {
  public:
    /** @throws InputError for lines that cannot be read, subsections that are
     * not closed, keys that are set twice and malformed overrides. */
    SceneText(const std::string              &text,
              const std::string              &file_name,
              const std::vector<std::string> &overrides = {});

    /** @brief In the order of the file, then the overrides. */
    const std::vector<SceneEntry> &
    entries() const;

    /** @brief The subsections that occur, each with its (first) line. */
    const std::map<std::string, unsigned int> &
    sections() const;

    /** @brief The value that counts, or @p otherwise where nothing is set. */
    std::string
    value(const std::string &section, const std::string &key, const std::string &otherwise) const;

    /** @brief Whether a value is given in the file or on the command line. */
    bool
    is_set(const std::string &section, const std::string &key) const;

    /** @brief Remove a subsection and all within it. Constants that it uses count as used.
     * @return its entries. */
    std::vector<SceneEntry>
    take(const std::string &section);

    /** @brief What the keys "Constants" define; they are no entries. */
    const Constants &
    constants() const;

    /** @brief "line 12 of x.prm" or "command line". */
    std::string
    location(unsigned int line) const;

  private:
    /** A file that is being read: its name, and one that is the same for all ways to it. */
    struct OpenFile
    {
      std::string name, canonical_name;
    };
    std::vector<OpenFile> open_files;
    /** File and line of each line, in the order in which they are read. */
    std::vector<std::pair<std::string, unsigned int>> places;

    std::vector<SceneEntry>             all_entries;
    Constants                           all_constants;
    std::map<std::string, unsigned int> all_sections;

    /** @param path The subsections that are open. */
    void
    read_file(const std::string &text, const std::string &name, std::vector<std::string> &path);
    void
    include(const std::string &file, unsigned int number, std::vector<std::string> &path);
    void
    read_key(const std::string &line, unsigned int number, const std::string &section);
    void
    read_line(const std::string &line, unsigned int number, std::vector<std::string> &path);
    void
    read_override(const std::string &text);
    /** Also the subsections around it occur. */
    void
    note_section(const std::string &section, unsigned int line);
    const SceneEntry *
    find(const std::string &section, const std::string &key) const;
  };

  /** @brief "A/B" from its parts. */
  std::string
  join_path(const std::vector<std::string> &parts);

  /** @brief The parts of "A/B". */
  std::vector<std::string>
  split_path(const std::string &section);
} // namespace Touchstone

#endif
