// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_keyword_h
#define touchstone_base_keyword_h

#include <deal.II/base/parameter_handler.h>

#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The value of a key that takes one of a few words, each of which stands for a value
   * of an enumeration: words are read here once, and nowhere compared.
   *
   * Must stay where it is once its key is declared, for the handler refers to it.
   */
  template <class Enum>
  class Keyword
  {
    // A string literal would become true.
    static_assert(!std::is_same_v<Enum, bool>);

  public:
    /** @param value Default of the key.
     * @param words All words with what they stand for, in the order of messages. */
    Keyword(const Enum value, const std::vector<std::pair<std::string, Enum>> &words)
      : value(value)
      , words(words)
    {
    }

    operator Enum() const
    {
      return value;
    }

    Keyword &
    operator=(const Enum other)
    {
      value = other;
      return *this;
    }

    /** @brief As if the scene had set @p word. @throws std::invalid_argument */
    Keyword &
    operator=(const std::string &word)
    {
      for (const auto &[name, meaning] : words)
        if (name == word)
          {
            value = meaning;
            return *this;
          }
      throw std::invalid_argument("unknown word '" + word + "'");
    }

    /** @brief The word for the present value. */
    const std::string &
    word() const
    {
      for (const auto &[name, meaning] : words)
        if (meaning == value)
          return name;
      throw std::invalid_argument("a value without a word");
    }

    /** @brief Declare the key. */
    void
    declare(dealii::ParameterHandler &prm, const std::string &key, const std::string &help)
    {
      std::string names;
      for (const auto &[name, meaning] : words)
        names += (names.empty() ? "" : "|") + name;
      prm.declare_entry(key, word(), dealii::Patterns::Selection(names), help);
      prm.add_action(key, [this](const std::string &word) { *this = word; });
    }

  private:
    Enum                                      value;
    std::vector<std::pair<std::string, Enum>> words;
  };
} // namespace Touchstone

#endif
