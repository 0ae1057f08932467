// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_early_values_h
#define touchstone_base_early_values_h

#include <functional>
#include <string>

namespace Touchstone
{
  /**
   * @brief Values of a scene before its keys are declared: which class is chosen decides
   * which keys there are.
   */
  class EarlyValues
  {
  public:
    /** Value of a key in a section, or the third argument where the scene sets none. */
    using LookUp = std::function<std::string(const std::string &section,
                                             const std::string &key,
                                             const std::string &otherwise)>;

    /** @brief A scene that sets nothing. */
    EarlyValues() = default;

    EarlyValues(const LookUp &look_up, const std::string &section)
      : look_up(look_up)
      , section(section)
    {
    }

    /** @brief Those of the subsection @p name. */
    EarlyValues
    in(const std::string &name) const
    {
      return {look_up, section.empty() ? name : section + '/' + name};
    }

    /** @brief The value that the scene sets here, or @p otherwise. */
    std::string
    value(const std::string &key, const std::string &otherwise) const
    {
      return look_up ? look_up(section, key, otherwise) : otherwise;
    }

  private:
    LookUp      look_up;
    std::string section;
  };
} // namespace Touchstone

#endif
