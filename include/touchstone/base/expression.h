// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_expression_h
#define touchstone_base_expression_h

#include <deal.II/base/patterns.h>

#include <optional>
#include <string>

namespace Touchstone
{
  /**
   * @brief Try an expression in muParser's language before the run needs it.
   *
   * @param variables "x,y,z,t" or a part of it; the constant pi is also known.
   * @throws InputError in the name of @p section and @p key.
   */
  void
  check_expression(const std::string &section,
                   const std::string &key,
                   const std::string &expression,
                   const std::string &variables = "x,y,z,t");

  /** @brief The value of an expression in numbers and pi; nothing if it cannot be read, is not
   * finite, or depends on x, y, z, t or chance. */
  std::optional<double>
  constant_value(const std::string &expression);

  /**
   * @brief Pattern of keys that take a formula. It matches anything, since check_expression() has
   * better messages; by its description the constants of the scene find the formulas.
   */
  class FormulaPattern : public dealii::Patterns::Anything
  {
  public:
    std::string
    description(const OutputStyle style = Machine) const override;
    std::unique_ptr<dealii::Patterns::PatternBase>
    clone() const override;
  };
} // namespace Touchstone

#endif
