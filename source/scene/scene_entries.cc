// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/expression.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/suggestion.h>
#include <touchstone/scene/declared_entries.h>
#include <touchstone/scene/pattern_in_words.h>
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
  namespace
  {
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
     * the listing as JSON alone, in which names are not mangled. */
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
                  keys.emplace(join_path(path), name);
              }
            else
              {
                std::vector<std::string> inner = path;
                inner.push_back(name);
                walk(child, inner);
              }
        };
      walk(tree, {});
      return keys;
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
              remedy_for_pattern(pattern, entry.value) +
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
