// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_json_h
#define touchstone_output_json_h

#include <deal.II/base/tensor.h>

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Touchstone
{
  /**
   * @brief A JSON value to be written: number, text, truth value, array, or
   * object whose members keep the order in which they were set.
   *
   * Boost.JSON does not exist in the Boost 1.74 of the reference platform, and
   * the program writes JSON but never reads it.
   */
  class Json
  {
  public:
    /** @brief null */
    Json() = default;

    /** @brief A number; NaN and infinity, which JSON does not know, become
     * null. */
    template <class Number, class = std::enable_if_t<std::is_arithmetic<Number>::value>>
    Json(const Number value)
      : kind(std::is_same<Number, bool>::value       ? Kind::boolean
             : std::is_floating_point<Number>::value ? Kind::number
                                                     : Kind::literal)
      , number(static_cast<double>(value))
      // Integers above 2^53 would lose digits as double.
      , text(std::is_floating_point<Number>::value ? std::string() : std::to_string(value))
    {
    }

    /** @brief A text in UTF-8. */
    Json(const std::string &value);
    Json(const char *value);

    /** @brief An array of the components. */
    Json(const dealii::Tensor<1, 3> &value);

    /** @brief {} */
    static Json
    object();

    /** @brief [] */
    static Json
    array();

    /** @brief Add a member to this object, or replace it. @return this object,
     * so that calls can be chained. */
    Json &
    set(const std::string &key, const Json &value);

    /** @brief Add an element to this array. @return this array. */
    Json &
    append(const Json &value);

    /** @brief The text of the value, objects indented by two blanks a level.
     * @param max_digits Significant digits of floating-point numbers. */
    std::string
    print(unsigned int max_digits = 12) const;

  private:
    enum class Kind
    {
      null,
      boolean,
      number,
      literal,
      string,
      array,
      object
    };

    Kind                                      kind   = Kind::null;
    double                                    number = 0.;
    std::string                               text;
    std::vector<std::pair<std::string, Json>> members;

    explicit Json(Kind kind);

    /** @brief Print at an indentation of @p level. */
    std::string
    print(unsigned int max_digits, unsigned int level) const;
  };
} // namespace Touchstone

#endif
