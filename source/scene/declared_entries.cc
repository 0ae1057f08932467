// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/suggestion.h>
#include <touchstone/scene/declared_entries.h>

#include <algorithm>
#include <sstream>
#include <utility>

// What a scene may have, and messages for what it may not: what the user may have meant.
namespace Touchstone
{
  namespace
  {
    /** Names of the direct subsections of @p parent, as suggestions. */
    std::vector<std::string>
    subsections(const Declared &declared, const std::string &parent)
    {
      std::vector<std::string> names;
      for (const auto &[section, keys] : declared)
        {
          std::vector<std::string> path = split_path(section);
          if (path.empty())
            continue;
          const std::string name = path.back();
          path.pop_back();
          if (join_path(path) == parent)
            names.push_back(name);
        }
      return names;
    }
  } // namespace



  // ParameterHandler has no function that lists its entries, but its short listing is in the
  // format of a scene file and can be parsed like one.
  Declared
  declared_entries(const dealii::ParameterHandler &prm)
  {
    std::ostringstream listing;
    prm.print_parameters(listing, dealii::ParameterHandler::ShortPRM);
    const SceneText text(listing.str(), "listing");

    Declared declared;
    // Sections without keys are declared, too.
    for (const auto &[section, line] : text.sections())
      declared[section];
    for (const SceneEntry &entry : text.entries())
      declared[entry.section].push_back(entry.key);
    // Taken out of each text, for it is no entry; here so that messages can suggest it.
    declared[""].insert(declared[""].begin(), "Constants");
    return declared;
  }



  void
  throw_unknown_section(const Declared    &declared,
                        const std::string &section,
                        const std::string &location)
  {
    // The outermost unknown part of the path is the mistake; those inside it follow from it.
    std::vector<std::string> path;
    for (const std::string &part : split_path(section))
      {
        const std::string parent = join_path(path);
        path.push_back(part);
        if (declared.count(join_path(path)) > 0)
          continue;

        const std::vector<std::string> known = subsections(declared, parent);
        // A subsection "Body x" without x in the list "Bodies" is a frequent mistake with its own
        // remedy. "Boundary x" lies within a body, the others at the top.
        static const std::vector<std::pair<std::string, std::string>> lists = {
          {"Body ", "Bodies"},
          {"Contact pair ", "Contact pairs"},
          {"Obstacle ", "Obstacles"},
          {"Probe ", "Probes"},
          {"Boundary ", "Boundary conditions"},
          {"Phase ", "Phases"}};
        for (const auto &[prefix, list] : lists)
          if (part.compare(0, prefix.size(), prefix) == 0 &&
              parent.empty() == (prefix != "Boundary " && prefix != "Phase "))
            throw InputError(join_path(path),
                             "",
                             "",
                             "the list '" + list + "'" +
                               (parent.empty() ? "" : " of '" + parent + "'") + " does not name '" +
                               part.substr(prefix.size()) + "' (" + location + ")" +
                               did_you_mean(part, known),
                             "add the name to '" + list + "' or remove this subsection");

        throw InputError(join_path(path),
                         "",
                         "",
                         "there is no such subsection (" + location + ")" +
                           did_you_mean(part, known),
                         "correct the name; " + (known.empty()
                                                   ? "there are no subsections here"
                                                   : "here can stand " + quoted_list(known)));
      }
    throw InputError(section, "", "", "there is no such subsection", "");
  }



  // A similar key of the same section is the likeliest meaning, then the same key of another
  // section.
  void
  throw_unknown_key(const Declared &declared, const SceneEntry &entry, const std::string &location)
  {
    const auto                     keys = declared.find(entry.section);
    const std::vector<std::string> known =
      keys == declared.end() ? std::vector<std::string>() : keys->second;

    std::string hint = did_you_mean(entry.key, known);
    if (hint.empty())
      for (const auto &[section, others] : declared)
        if (std::find(others.begin(), others.end(), entry.key) != others.end())
          {
            hint = ", did you mean the one of section '" + section + "'?";
            break;
          }
    throw InputError(entry.section,
                     entry.key,
                     entry.value,
                     "there is no such key (" + location + ")" + hint,
                     known.empty()
                       ? "this section has no keys of its own"
                       : "the keys " +
                           std::string(entry.section.empty() ? "outside of all subsections"
                                                             : "of this section") +
                           " are " + quoted_list(known));
  }
} // namespace Touchstone
