// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_expression_h
#define touchstone_base_expression_h

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
} // namespace Touchstone

#endif
