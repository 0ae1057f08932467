// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/scene/parameter_changes.h>
#include <touchstone/scene/scene.h>
#include <touchstone/scene/scene_text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

/**
 * @file
 * Which keys may differ between a checkpoint and the scene that resumes from it. Those that change
 * how the solution is found or what is written may; those that change the problem may not, since
 * the result would be that of neither scene.
 */

namespace Touchstone
{
  namespace
  {
    /** Sections whose keys do not change the problem, but how it is solved and what is written. */
    const std::set<std::string> free_sections =
      {"Output", "Checkpoints", "Linear solver", "Newton", "Reference solution", "Load stepping"};

    /**
     * Single keys of other sections, as (section, key). The end time has rules of its own in
     * compare_parameters().
     */
    const std::set<std::pair<std::string, std::string>> free_keys = {{"", "Title"},
                                                                     {"Contact", "Linearisation"},
                                                                     {"Discretisation",
                                                                      "Contact weight"}};

    /** The items of a list; a single value is a list of one. */
    std::vector<std::string>
    items(const std::string &value)
    {
      return dealii::Utilities::split_string_list(value, ',');
    }

    /** Numbers are compared by value ("1e3" is "1000"), everything else as text. */
    bool
    same_item(const std::string &a, const std::string &b)
    {
      if (a == b)
        return true;
      char        *end_a = nullptr, *end_b = nullptr;
      const double x = std::strtod(a.c_str(), &end_a), y = std::strtod(b.c_str(), &end_b);
      // Both are numbers to their last character, and equal.
      return !a.empty() && !b.empty() && *end_a == 0 && *end_b == 0 && x == y;
    }

    /** Equal item by item. */
    bool
    same(const std::string &a, const std::string &b)
    {
      const auto of_a = items(a), of_b = items(b);
      return a == b || std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), same_item);
    }

    /** Values by (section, key). */
    using Values = std::map<std::pair<std::string, std::string>, std::string>;

    /** Parse the printed scene of a checkpoint like a scene file. */
    Values
    values(const std::string &text)
    {
      const SceneText entries(text, "parameters.prm");
      Values          result;
      for (const SceneEntry &entry : entries.entries())
        result[{entry.section, entry.key}] = entry.value;
      return result;
    }
  } // namespace



  bool
  may_change(const std::string &section, const std::string &key)
  {
    // "Reference displacement x" of a body says only what the result is compared with.
    // Phases are as free as the end of the run and the number of its steps.
    return free_sections.count(section) > 0 || section.rfind("Load stepping/", 0) == 0 ||
           free_keys.count({section, key}) > 0 || key.rfind("Reference displacement ", 0) == 0;
  }



  std::vector<std::string>
  compare_parameters(const std::string &before, const Scene &scene, const double time)
  {
    const Values             old = values(before), now = values(scene.complete_entries());
    std::vector<std::string> changes;
    // Keys of both scenes: one that is missing on either side is a change as well. The order is
    // that of the names, the same in each run.
    Values all = old;
    all.insert(now.begin(), now.end());
    for (const auto &[place, unused] : all)
      {
        const auto &[section, key] = place;
        const auto of_old = old.find(place), of_now = now.find(place);
        const bool was = of_old != old.end(), is = of_now != now.end();
        if (was && is && same(of_old->second, of_now->second))
          continue;
        const std::string then = was ? "'" + of_old->second + "'" : "not there";
        if (!may_change(section, key))
          // The old value is part of the message: it is what has to be restored.
          throw InputError(section,
                           key,
                           is ? of_now->second : "",
                           "the checkpoint was written with another value, " + then +
                             ", and this one would lead to other results",
                           "set it as it was, or run the scene from its beginning without "
                           "--resume");
        changes.push_back(section + (section.empty() ? "" : "/") + key + " is now '" +
                          (is ? of_now->second : "") + "', was " + then);
      }

    const std::pair<std::string, std::string> end_key("Load stepping", "End time");
    const std::string                        &end = now.at(end_key), &old_end = old.at(end_key);
    // A later end than that of the checkpoint extends the run; an earlier one than its time cannot
    // be reached.
    if (scene.load_stepping.end_time < time * (1. - 1e-12))
      throw InputError(end_key.first,
                       end_key.second,
                       end,
                       "the checkpoint is at the later time " + dealii::Utilities::to_string(time),
                       "set a later end, or run the scene from its beginning without --resume");
    // A ramped initial overlap grows up to the end time: with another end the committed steps would
    // have had another overlap.
    for (const ContactPairParameters &pair : scene.pairs)
      if (pair.initial_overlap == ContactPairParameters::Overlap::ramp && pair.ramp_end == 0. &&
          !same(old_end, end))
        throw InputError(end_key.first,
                         end_key.second,
                         end,
                         "the checkpoint was written with '" + old_end +
                           "', and until then the initial overlap of the pair '" + pair.name +
                           "' grows",
                         "set it as it was, or run the scene from its beginning without --resume");
    return changes;
  }
} // namespace Touchstone
