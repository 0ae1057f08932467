// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>

namespace Touchstone
{
  namespace
  {
    /** With exactly one full stop or question mark at the end. */
    /** The sentence with exactly one full stop at its end, or its question mark. */
    std::string
    ended(std::string sentence)
    {
      while (!sentence.empty() && (sentence.back() == ' ' || sentence.back() == '.'))
        sentence.pop_back();
      if (!sentence.empty() && sentence.back() != '?')
        sentence += '.';
      return sentence;
    }

    /**
     * One line for all input errors: where (section, key, value), what is wrong, and what to do.
     */
    std::string
    message(const std::string &section,
            const std::string &key,
            const std::string &value,
            const std::string &problem,
            const std::string &remedy)
    {
      std::string place;
      const auto  add = [&place](const std::string &what, const std::string &name) {
        if (!name.empty())
          place += (place.empty() ? " in " : ", ") + what + "'" + name + "'";
      };
      add("section ", section);
      add("key ", key);
      // Without a key the value is a whole line of the file, shown without a label.
      add(key.empty() ? "" : "value ", value);

      std::string text = "Input error" + place + ": " + ended(problem);
      if (!remedy.empty())
        text += " Remedy: " + ended(remedy);
      return text;
    }
  } // namespace

  InputError::InputError(const std::string &section,
                         const std::string &key,
                         const std::string &value,
                         const std::string &problem,
                         const std::string &remedy)
    : std::runtime_error(message(section, key, value, problem, remedy))
  {
  }
} // namespace Touchstone
