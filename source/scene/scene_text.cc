// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/scene/scene_text.h>

#include <iterator>
#include <sstream>

/**
 * @file
 * The entries of a scene file as text, with the file and line of each for messages. Reading them is
 * in scene_lines.cc.
 */

namespace Touchstone
{
  std::string
  join_path(const std::vector<std::string> &parts)
  {
    std::string path;
    for (const std::string &part : parts)
      path += (path.empty() ? "" : "/") + part;
    return path;
  }



  std::vector<std::string>
  split_path(const std::string &section)
  {
    std::vector<std::string> parts;
    std::istringstream       stream(section);
    for (std::string part; std::getline(stream, part, '/');)
      parts.push_back(part);
    return parts;
  }



  SceneText::SceneText(const std::string              &text,
                       const std::string              &file_name,
                       const std::vector<std::string> &overrides)
  {
    std::vector<std::string> path;
    read_file(text, file_name, path);
    for (const std::string &override_text : overrides)
      read_override(override_text);
    all_constants.evaluate();
  }



  const std::vector<SceneEntry> &
  SceneText::entries() const
  {
    return all_entries;
  }



  const std::map<std::string, unsigned int> &
  SceneText::sections() const
  {
    return all_sections;
  }



  const Constants &
  SceneText::constants() const
  {
    return all_constants;
  }



  std::string
  SceneText::location(const unsigned int line) const
  {
    return line == 0
             ? "command line"
             : "line " + std::to_string(places[line - 1].second) + " of " + places[line - 1].first;
  }



  const SceneEntry *
  SceneText::find(const std::string &section, const std::string &key) const
  {
    // From the back: overrides follow the file and win.
    for (auto entry = all_entries.rbegin(); entry != all_entries.rend(); ++entry)
      if (entry->section == section && entry->key == key)
        return &*entry;
    return nullptr;
  }



  std::string
  SceneText::value(const std::string &section,
                   const std::string &key,
                   const std::string &otherwise) const
  {
    const SceneEntry *entry = find(section, key);
    return entry == nullptr ? otherwise : entry->value;
  }



  bool
  SceneText::is_set(const std::string &section, const std::string &key) const
  {
    return find(section, key) != nullptr;
  }



  std::vector<SceneEntry>
  SceneText::take(const std::string &section)
  {
    const auto within = [&section](const std::string &other) {
      return other == section || other.compare(0, section.size() + 1, section + '/') == 0;
    };
    std::vector<SceneEntry> taken, kept;
    for (const SceneEntry &entry : all_entries)
      {
        if (within(entry.section))
          all_constants.insert(entry.value);
        (within(entry.section) ? taken : kept).push_back(entry);
      }
    all_entries = kept;
    for (auto other = all_sections.begin(); other != all_sections.end();)
      other = within(other->first) ? all_sections.erase(other) : std::next(other);
    return taken;
  }



  void
  SceneText::note_section(const std::string &section, const unsigned int line)
  {
    // All outer sections of the path exist as well. emplace() keeps the first line of each.
    for (std::size_t end = section.find('/');; end = section.find('/', end + 1))
      {
        all_sections.emplace(section.substr(0, end), line);
        if (end == std::string::npos)
          return;
      }
  }
} // namespace Touchstone
