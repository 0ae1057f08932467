// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/expression.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/suggestion.h>
#include <touchstone/scene/scene_entries.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
// Boost's parser of JSON says on each compilation that this is old.
#ifndef BOOST_BIND_GLOBAL_PLACEHOLDERS
#  define BOOST_BIND_GLOBAL_PLACEHOLDERS
#endif
#include <boost/property_tree/json_parser.hpp>
#include <regex>
#include <set>
#include <sstream>

/**
 * @file
 * Takes the entries of a scene into the ParameterHandler, with errors that name the line, the key
 * and a remedy. deal.II would report unknown keys and wrong values in its own words and without
 * suggestions; therefore all entries are compared with the declared ones before they are set.
 */

namespace Touchstone
{
  using dealii::Utilities::split_string_list;

  namespace
  {
    /** Declared keys by the path of their section. */
    using Declared = std::map<std::string, std::vector<std::string>>;

    /**
     * ParameterHandler has no function that lists its entries, but its short listing is in the
     * format of a scene file and can be parsed like one.
     */
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



    /** Report the undeclared @p section. */
    [[noreturn]] void
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
                                 (parent.empty() ? "" : " of '" + parent + "'") +
                                 " does not name '" + part.substr(prefix.size()) + "' (" +
                                 location + ")" + did_you_mean(part, known),
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



    /**
     * Report an undeclared key: a similar key of the same section is the likeliest meaning, then
     * the same key of another section.
     */
    [[noreturn]] void
    throw_unknown_key(const Declared    &declared,
                      const SceneEntry  &entry,
                      const std::string &location)
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



    /**
     * Undo the mangled names of ParameterHandler ("Body_20inner.Young_20modulus"): _XX is a
     * character by its hexadecimal code, a dot separates sections.
     */
    std::string
    demangle(const std::string &name)
    {
      std::string result;
      for (std::size_t i = 0; i < name.size(); ++i)
        if (name[i] == '_' && i + 2 < name.size())
          {
            // Two hexadecimal digits after the underscore.
            result += static_cast<char>(std::stoi(name.substr(i + 1, 2), nullptr, 16));
            i += 2;
          }
        else
          result += name[i] == '.' ? '/' : name[i];
      return result;
    }



    /** (section, key) of the keys that take a formula. Patterns of declared entries can be had from
     * the listing as JSON alone. */
    std::set<std::pair<std::string, std::string>>
    formula_keys(const dealii::ParameterHandler &prm)
    {
      std::stringstream listing;
      prm.print_parameters(listing, dealii::ParameterHandler::JSON);
      boost::property_tree::ptree tree;
      boost::property_tree::read_json(listing, tree);

      std::set<std::pair<std::string, std::string>> keys;
      std::function<void(const boost::property_tree::ptree &, const std::vector<std::string> &)>
        walk = [&](const auto &node, const auto &path) {
          for (const auto &[name, child] : node)
            if (const auto pattern = child.find("pattern_description");
                pattern != child.not_found())
              {
                if (pattern->second.data() == FormulaPattern().description())
                  keys.emplace(join_path(path), demangle(name));
              }
            else
              {
                std::vector<std::string> inner = path;
                inner.push_back(demangle(name));
                walk(child, inner);
              }
        };
      walk(tree, {});
      return keys;
    }



    /**
     * In words what deal.II's description of a pattern asks for, of a number or of several. Bounds
     * at the limits of the type are no bounds to the user; empty for other patterns.
     */
    std::string
    numbers_in_words(const std::string &pattern, const bool several)
    {
      std::smatch found;
      if (!std::regex_match(pattern,
                            found,
                            std::regex(R"(\[(Integer range|Double) (.*)\.\.\.(.*) \(incl.*)")))
        return "";
      const std::string low = found[2], high = found[3];
      const bool        from = low.find("MAX_") == std::string::npos && low != "-2147483648",
                 to          = high.find("MAX_") == std::string::npos && high != "2147483647";
      return std::string(several ? "" : "a ") + (found[1] == "Double" ? "" : "whole ") + "number" +
             (several ? "s" : "") +
             (from && to ? " from " + low + " to " + high
              : from     ? " of at least " + low
              : to       ? " of at most " + high
                         : "");
    }



    /** The same of lists, and of lists of points. */
    std::string
    list_in_words(const std::string &pattern)
    {
      std::smatch found;
      if (!std::regex_match(pattern,
                            found,
                            std::regex(
                              R"(\[List of <(.*)> of length (\d+)\.\.\.(\d+) \(inclusive\)(.*))")))
        return "";
      const std::string inner = found[1], least = found[2], most = found[3];
      if (inner.compare(0, 6, "[Tuple") == 0)
        return "pairs of numbers, with a colon in each and commas between them";
      std::string items = numbers_in_words(inner, true);
      if (inner.compare(0, 5, "[List") == 0)
        items = "points, each of " + list_in_words(inner) + ",";
      else if (items.empty())
        items = "words";
      // The limit of the type is none to the user.
      const bool        any   = most.size() >= 10;
      const std::string count = least == most         ? least + " "
                                : any && least == "0" ? ""
                                : any                 ? "at least " + least + " "
                                : least == "0"        ? "up to " + most + " "
                                                      : least + " to " + most + " ";
      return count + items + " with " +
             (found[4].str().find(';') == std::string::npos ? "commas" : "semicolons") +
             " between them";
    }



    /** A remedy in words, from deal.II's description of a pattern that @p value does not match. */
    std::string
    remedy(const std::string &pattern, const std::string &value)
    {
      if (const std::string number = numbers_in_words(pattern, false); !number.empty())
        return "give " + number;
      if (const std::string list = list_in_words(pattern); !list.empty())
        return "give " + list;
      // For a choice of words the nearest word is suggested.
      std::smatch found;
      if (std::regex_match(pattern, found, std::regex(R"(\[Selection (.*?) ?\])")))
        {
          const auto names = split_string_list(found[1], '|');
          return "give one of " + quoted_list(names) + did_you_mean(value, names);
        }
      // Descriptions without a translation are shown as deal.II has them.
      if (pattern.compare(0, 5, "[Bool") == 0)
        return "give 'true' or 'false'";
      return "give " + pattern;
    }



    /**
     * Set the present key. @return an empty text, or the pattern that the value does not match; it
     * is cut out of deal.II's message, the only place that has it.
     */
    std::string
    try_value(const std::string &key, const std::string &value, dealii::ParameterHandler &prm)
    {
      try
        {
          prm.set(key, value);
          return "";
        }
      catch (const dealii::ParameterHandler::ExcValueDoesNotMatchPattern &exception)
        {
          std::ostringstream text;
          exception.print_info(text);
          const std::string start   = "given pattern <";
          std::string       pattern = text.str();
          pattern                   = pattern.substr(pattern.find(start) + start.size());
          return pattern.substr(0, pattern.rfind('>'));
        }
    }



    /** Set one entry; a value that does not match the declared pattern, nor does as an expression
     * where numbers are expected, is an InputError. */
    void
    set_entry(const SceneEntry         &entry,
              const std::string        &location,
              const Constants          &constants,
              const bool                is_formula,
              dealii::ParameterHandler &prm)
    {
      const std::vector<std::string> path = split_path(entry.section);
      for (const std::string &part : path)
        prm.enter_subsection(part);
      std::string pattern =
        try_value(entry.key, is_formula ? constants.insert(entry.value) : entry.value, prm);
      if (!pattern.empty())
        {
          // Numbers, and lists and lists of lists of them.
          static const std::regex number(R"((\[List of <)*\[(Double|Integer) .*)");
          std::smatch             found;
          const bool              is_number = std::regex_match(pattern, found, number);
          const auto              value =
            is_number ? constants.numbers(entry.value, found[2] == "Integer", found[1].matched)
                                   : std::nullopt;
          if (!value || !try_value(entry.key, *value, prm).empty())
            throw InputError(
              entry.section,
              entry.key,
              entry.value,
              (entry.value.empty() ? "an empty value" : "this value") +
                (value && *value != entry.value ? ", which is " + *value + "," : std::string()) +
                " is not possible here (" + location + ")",
              remedy(pattern, entry.value) +
                (is_number && !value && !constants.names().empty()
                   ? ", or an expression in the constants " + quoted_list(constants.names())
                   : ""));
        }
      for (std::size_t i = 0; i < path.size(); ++i)
        prm.leave_subsection();
    }
  } // namespace



  void
  set_entries(const SceneText &text, dealii::ParameterHandler &prm)
  {
    const Declared declared = declared_entries(prm);

    // The first mistake in the file is reported, since later ones often follow from it. Overrides
    // of the command line have line 0 and come last: line - 1 of an unsigned number makes them the
    // largest.
    const auto order   = [](const unsigned int line) { return line - 1U; };
    auto       unknown = text.sections().end();
    for (auto section = text.sections().begin(); section != text.sections().end(); ++section)
      if (declared.count(section->first) == 0 &&
          (unknown == text.sections().end() || order(section->second) < order(unknown->second)))
        unknown = section;

    const auto formulas = formula_keys(prm);
    const auto set      = [&](const SceneEntry &entry) {
      set_entry(entry,
                text.location(entry.line),
                text.constants(),
                formulas.count({entry.section, entry.key}) > 0,
                prm);
    };
    const auto known = [&declared](const SceneEntry &entry) {
      const auto keys = declared.find(entry.section);
      return keys != declared.end() &&
             std::find(keys->second.begin(), keys->second.end(), entry.key) != keys->second.end();
    };
    for (const SceneEntry &entry : text.entries())
      {
        if (unknown != text.sections().end() && order(unknown->second) <= order(entry.line))
          throw_unknown_section(declared, unknown->first, text.location(unknown->second));
        if (!known(entry))
          {
            // If the name of a class is misspelt below, its keys are unknown, and the name is the
            // mistake to report.
            for (const SceneEntry &other : text.entries())
              if (other.section == entry.section && known(other))
                set(other);
            throw_unknown_key(declared, entry, text.location(entry.line));
          }
        set(entry);
      }
    if (unknown != text.sections().end())
      throw_unknown_section(declared, unknown->first, text.location(unknown->second));

    text.constants().check_used();

    // Last of all, since a misspelt key also leaves the right one unset, and the misspelling is the
    // better message.
    for (const std::string &name : prm.get_entries_wrongly_not_set())
      {
        std::vector<std::string> path = split_path(demangle(name));
        const std::string        key  = path.back();
        path.pop_back();
        const std::string section  = join_path(path);
        const bool        is_there = section.empty() || text.sections().count(section) > 0;
        throw InputError(section,
                         key,
                         "",
                         std::string("this key is required, but not set") +
                           (is_there ? "" : ": the whole subsection is missing"),
                         "write 'set " + key + " = ...'" +
                           (section.empty() ? "" : " in the subsection '" + section + "'"));
      }
  }
} // namespace Touchstone
