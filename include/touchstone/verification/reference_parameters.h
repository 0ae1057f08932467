// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_verification_reference_parameters_h
#define touchstone_verification_reference_parameters_h

#include <touchstone/base/choice.h>

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>

namespace Touchstone
{
  class ReferenceSolution;
  class Scene;

  /**
   * @brief Section "Reference solution": the exact solution that the result is compared with;
   * errors are in summary.json under `errors`.
   */
  struct ReferenceParameters
  {
    /** Name under which the reference is registered ("none",
     * "interference fit", "hertz", "uniform stress", ...). */
    Choice<Registry<ReferenceSolution, const Scene &>> type{"none"};
    /** The contact pair that is compared; empty: the first. */
    std::string pair;
    /** Named numbers of the type ("radius: 10, pressure: 5"). */
    std::string values;
    /** Expression in x, y, z, t: the contact pressure of the reference "formula". */
    std::string pressure;

    /** @brief The named numbers. @throws InputError in the name of @p section. */
    std::map<std::string, double>
    numbers(const std::string &section) const;

    /** @param values Of this section: the type decides on other keys. */
    void
    declare(dealii::ParameterHandler &prm, const EarlyValues &values);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif
