// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_registry_h
#define touchstone_base_registry_h

#include <touchstone/base/plugin_parameters.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Formulations by name: whoever extends the program writes one class
   * and registers it under the name that the scene file uses.
   *
   * @code
   * namespace
   * {
   *   const Registry<Geometry>::Entry<Box> entry("box", "A box with ...");
   * }
   * @endcode
   *
   * A class can have keys of its own: see PluginParameters. Choice is the key that names
   * one of the classes.
   *
   * @tparam Base      Abstract interface.
   * @tparam Arguments Types of the constructor's arguments.
   */
  template <class Base, class... Arguments>
  class Registry
  {
  public:
    using Interface = Base;

    /** @brief A registered class. */
    struct Record
    {
      std::string documentation;
      /** Its own keys with their defaults. */
      std::function<std::shared_ptr<PluginParameters>()> make_parameters;
      /** An object from keys that make_parameters() has made. */
      std::function<std::shared_ptr<Base>(const std::shared_ptr<PluginParameters> &, Arguments...)>
        make;
    };

    /** @brief All entries by name. */
    static std::map<std::string, Record> &
    records()
    {
      static std::map<std::string, Record> all;
      return all;
    }

    /** @brief Whether a class is registered as @p name. */
    static bool
    knows(const std::string &name)
    {
      return records().count(name) > 0;
    }

    /** @brief The names in alphabetical order. */
    static std::vector<std::string>
    names()
    {
      std::vector<std::string> result;
      for (const auto &[name, record] : records())
        result.push_back(name);
      return result;
    }

    /** @brief The names joined by "|", as deal.II's Patterns::Selection wants
     * them. */
    static std::string
    selection()
    {
      std::string result;
      for (const std::string &name : names())
        result += (result.empty() ? "" : "|") + name;
      return result;
    }

    /** @brief Name and documentation of each entry, for the key's help text. */
    static std::string
    documentation()
    {
      std::string text;
      for (const auto &[name, record] : records())
        text += (text.empty() ? "'" : " '") + name + "': " + record.documentation;
      return text;
    }

    /** @brief Make the one called @p name, with the defaults of its own keys.
     * @throws std::out_of_range */
    static std::shared_ptr<Base>
    make(const std::string &name, Arguments... arguments)
    {
      const Record &record = records().at(name);
      return record.make(record.make_parameters(), arguments...);
    }

    /** @brief Make the one called @p name from values of its own keys. @throws std::out_of_range */
    static std::shared_ptr<Base>
    make_with(const std::string                       &name,
              const std::shared_ptr<PluginParameters> &parameters,
              Arguments... arguments)
    {
      const Record &record = records().at(name);
      return record.make(parameters ? parameters : record.make_parameters(), arguments...);
    }

    /** @brief An object of this type at namespace scope registers Derived. The program ends at its
     * start if the name is taken: one class would silently stand for the other. */
    template <class Derived>
    struct Entry
    {
      Entry(const std::string &name, const std::string &documentation)
      {
        if (knows(name))
          {
            // Before main(), where nobody could catch an exception.
            std::fprintf(stderr, "Two classes of one kind are registered as '%s'.\n", name.c_str());
            std::exit(1);
          }
        Record &record       = records()[name];
        record.documentation = documentation;
        if constexpr (std::is_base_of_v<PluginParameters, Derived>)
          {
            // The object is made first and holds the values of its keys.
            record.make_parameters = [] { return std::make_shared<Derived>(); };
            record.make            = [](const std::shared_ptr<PluginParameters> &object) {
              return std::dynamic_pointer_cast<Derived>(object);
            };
          }
        else if constexpr (HasParameters<Derived>::value)
          {
            using Own              = typename Derived::Parameters;
            record.make_parameters = [] { return std::make_shared<Own>(); };
            record.make            = [](const std::shared_ptr<PluginParameters> &parameters,
                             Arguments... arguments) {
              return std::make_shared<Derived>(dynamic_cast<const Own &>(*parameters),
                                               arguments...);
            };
          }
        else
          {
            record.make_parameters = [] { return std::make_shared<PluginParameters>(); };
            record.make = [](const std::shared_ptr<PluginParameters> &, Arguments... arguments) {
              return std::make_shared<Derived>(arguments...);
            };
          }
      }
    };

  private:
    template <class Derived, class = void>
    struct HasParameters : std::false_type
    {
    };
    template <class Derived>
    struct HasParameters<Derived, std::void_t<typename Derived::Parameters>>
      : std::is_base_of<PluginParameters, typename Derived::Parameters>
    {
    };
  };
} // namespace Touchstone

#endif
