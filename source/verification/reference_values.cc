// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/verification/reference_parameters.h>
#include <touchstone/verification/reference_values.h>

namespace Touchstone
{
  namespace
  {
    /** Names with commas between them, for messages. */
    std::string
    joined(const std::set<std::string> &names)
    {
      std::string result;
      for (const std::string &name : names)
        result += (result.empty() ? "" : ", ") + name;
      return result;
    }
  } // namespace



  ReferenceValues::ReferenceValues(const std::string &text)
    : text(text)
  {
    ReferenceParameters parameters;
    parameters.values = text;
    values            = parameters.numbers("Reference solution");
  }



  bool
  ReferenceValues::has(const std::string &name) const
  {
    return values.find(name) != values.end();
  }



  double
  ReferenceValues::number(const std::string &name)
  {
    known.insert(name);
    if (!has(name))
      fail("The number \"" + name + "\" is missing.", "Add \"" + name + ": NUMBER\".");
    return values.at(name);
  }



  double
  ReferenceValues::positive_number(const std::string &name)
  {
    const double value = number(name);
    if (!(value > 0.))
      fail("\"" + name + "\" must be positive.", "Correct the number.");
    return value;
  }



  double
  ReferenceValues::number(const std::string &name, const double default_value)
  {
    known.insert(name);
    return has(name) ? values.at(name) : default_value;
  }



  void
  ReferenceValues::fail(const std::string &problem, const std::string &remedy) const
  {
    throw InputError("Reference solution", "Values", text, problem, remedy);
  }



  void
  ReferenceValues::finish() const
  {
    // Every look-up has noted its name: a value that nobody looked up is a misspelt or superfluous
    // one.
    for (const auto &[name, value] : values)
      if (known.count(name) == 0)
        fail("\"" + name + "\" means nothing to this reference solution.",
             known.empty() ? "Leave the entry empty." : "It knows " + joined(known) + ".");
  }
} // namespace Touchstone
