// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_choice_h
#define touchstone_base_choice_h

#include <touchstone/base/early_values.h>
#include <touchstone/base/registry.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace Touchstone
{
  /**
   * @brief A key of a scene that names a registered class, with the keys that this class
   * has of its own. The one mechanism for all kinds of classes that can be added.
   *
   * Must stay where it is once its key is declared, for the handler refers to it.
   * @tparam Registries One Registry or several, in whose order names are looked for.
   */
  template <class... Registries>
  class Choice
  {
    using First = std::tuple_element_t<0, std::tuple<Registries...>>;

  public:
    /** Value of the key: a registered name, or one of those that stand for no class. */
    std::string name;

    /** @param name Default of the key. */
    Choice(const std::string &name)
      : name(name)
      , chosen_name(name)
    {
      choose();
    }

    /** @brief As if the scene had chosen @p other, with the defaults of its keys. */
    Choice &
    operator=(const std::string &other)
    {
      name = chosen_name = other;
      choose();
      return *this;
    }

    /**
     * @brief Declare the key.
     * @param values   Of the section in which the key stands.
     * @param help     To which is added what those classes say of themselves that it does
     *                 not name in quotation marks.
     * @param no_class Further names that the key takes, and that stand for no class.
     */
    void
    declare_key(dealii::ParameterHandler       &prm,
                const EarlyValues              &values,
                const std::string              &key,
                std::string                     help,
                const std::vector<std::string> &no_class = {})
    {
      choose(values, key);
      std::string names;
      for (const std::string &other : no_class)
        names += other + '|';
      const auto add = [&](const auto &records) {
        for (const auto &[other, record] : records)
          {
            names += other + '|';
            const std::string quoted = '\'' + other + '\'';
            if (help.find(quoted) == std::string::npos)
              help += ' ' + quoted + ": " + record.documentation;
          }
      };
      (add(Registries::records()), ...);
      names.pop_back();
      prm.add_parameter(key, name, help, dealii::Patterns::Selection(names));
    }

    /** @brief Choose what the scene sets, for a key that is declared otherwise.
     * @param values Of the section in which the key stands. */
    void
    choose(const EarlyValues &values, const std::string &key)
    {
      chosen_name = values.value(key, name);
      choose();
    }

    /** @brief Declare the keys of the class that is chosen, in the present section. */
    void
    declare_own_keys(dealii::ParameterHandler &prm)
    {
      if (parameters)
        parameters->declare(prm);
    }

    /** @brief What the scene chooses, while keys are declared and the default is still in
     * #name. */
    const std::string &
    chosen() const
    {
      return chosen_name;
    }

    /** @brief The own keys as an object of type @p Keys; null if they are something else. */
    template <class Keys>
    std::shared_ptr<Keys>
    own_keys() const
    {
      return std::dynamic_pointer_cast<Keys>(parameters);
    }

    /** @param section Where its own keys stand. @throws InputError */
    void
    check(const std::string &section) const
    {
      if (parameters)
        parameters->check(section);
    }

    /** @brief Make an object of what is chosen, or null if that is not in the Registry. Where a
     * class is its own parameters this is always the same object.
     * @param arguments Of the constructor, after the parameters. */
    template <class RegistryOf = First, class... Arguments>
    std::shared_ptr<typename RegistryOf::Interface>
    make(Arguments &&...arguments) const
    {
      if (!RegistryOf::knows(chosen_name))
        return nullptr;
      return RegistryOf::make_with(chosen_name, parameters, std::forward<Arguments>(arguments)...);
    }

  private:
    std::string                       chosen_name;
    std::shared_ptr<PluginParameters> parameters;

    void
    choose()
    {
      parameters         = nullptr;
      const auto look_in = [&](const auto &records) {
        const auto record = records.find(chosen_name);
        if (!parameters && record != records.end())
          parameters = record->second.make_parameters();
      };
      (look_in(Registries::records()), ...);
    }
  };
} // namespace Touchstone

#endif
