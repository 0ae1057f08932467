#ifndef touchstone_scene_expression_h
#define touchstone_scene_expression_h

#include <touchstone/types.h>

#include <deal.II/base/function_parser.h>

#include <memory>
#include <string>

namespace Touchstone
{
  /** @brief The function of x, y, z and t that an expression in muParser's language
   * stands for; the constant pi is also known. */
  std::unique_ptr<dealii::FunctionParser<dim>>
  make_function(const std::string &expression);

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
} // namespace Touchstone

#endif
