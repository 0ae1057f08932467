// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/repeated_failure.h>

#include <algorithm>
#include <cmath>
#include <typeinfo>

namespace Touchstone
{
  namespace
  {
    /**
     * Equal to 2 per cent. Quantities that depend on the step size change by a factor of about two
     * when it is halved, so values this close do not depend on it.
     */
    bool
    unchanged(const double a, const double b)
    {
      return std::abs(a - b) <= 0.02 * std::max(std::abs(a), std::abs(b));
    }
  } // namespace



  void
  RepeatedFailure::forget()
  {
    before.reset();
  }



  bool
  RepeatedFailure::add(const NonConvergence &failure,
                       const NewtonState    &last,
                       const std::string    &place)
  {
    const Attempt now{typeid(failure), failure.measure(), place, last};
    // Residuals and gaps below their tolerances are round-off and do not tell two attempts apart,
    // hence "both are met" counts as equal.
    const auto closed = [this](const NewtonState &state) {
      return state.gap <= parameters.gap_tolerance;
    };
    const bool solved =
      balanced(last, parameters) && closed(last) && last.changes == 0 && last.prescribed;
    const bool same_measure = before && before->measure.has_value() == now.measure.has_value() &&
                              (now.measure ? unchanged(*before->measure, *now.measure) : !solved);
    const bool same_state =
      before &&
      (unchanged(before->last.residual, last.residual) ||
       (balanced(before->last, parameters) && balanced(last, parameters))) &&
      (unchanged(before->last.gap, last.gap) || (closed(before->last) && closed(last))) &&
      before->last.changes == last.changes && before->last.active == last.active;
    const bool same =
      same_state && same_measure && before->type == now.type && before->place == now.place;
    before.emplace(now);
    return same;
  }
} // namespace Touchstone
