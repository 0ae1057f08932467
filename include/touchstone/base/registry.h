#ifndef touchstone_base_registry_h
#define touchstone_base_registry_h

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

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
   * @tparam Base      Abstract interface.
   * @tparam Arguments Types of the constructor's arguments.
   */
  template <class Base, class... Arguments>
  class Registry
  {
  public:
    using Maker = std::function<std::shared_ptr<Base>(Arguments...)>;

    struct Record
    {
      std::string documentation;
      Maker       make;
    };

    /** @brief All entries by name. */
    static std::map<std::string, Record> &
    records()
    {
      static std::map<std::string, Record> all;
      return all;
    }

    /** @brief The names joined by "|", as deal.II's Patterns::Selection wants
     * them. */
    static std::string
    selection()
    {
      std::string names;
      for (const auto &[name, record] : records())
        names += (names.empty() ? "" : "|") + name;
      return names;
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

    /** @brief Make the one called @p name. @throws std::out_of_range */
    static std::shared_ptr<Base>
    make(const std::string &name, Arguments... arguments)
    {
      return records().at(name).make(arguments...);
    }

    /** @brief An object of this type at namespace scope registers Derived. */
    template <class Derived>
    struct Entry
    {
      Entry(const std::string &name, const std::string &documentation)
      {
        records()[name] = {documentation, [](Arguments... arguments) {
                             return std::make_shared<Derived>(arguments...);
                           }};
      }
    };
  };
} // namespace Touchstone

#endif
