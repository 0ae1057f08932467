// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_repeated_failure_h
#define touchstone_drive_repeated_failure_h

#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/newton.h>

#include <optional>
#include <string>
#include <typeindex>

namespace Touchstone
{
  /**
   * @brief Notices that a step fails in the same way with half its size: then the size is
   * not the cause, and further cuts cannot help.
   */
  class RepeatedFailure
  {
  public:
    /** @param parameters A residual that they take for met does not tell attempts apart. */
    explicit RepeatedFailure(const NewtonParameters &parameters)
      : parameters(parameters)
    {
    }

    /** @brief A step has converged: what failed before does not count any more. */
    void
    forget();

    /**
     * @brief A step has failed.
     * @param failure The reason.
     * @param last    State of the last Newton iteration; a residual that is no number for none.
     * @param place   Where it failed, the same text for the same place.
     * @return whether the attempt before failed with the same reason, at the same place,
     * as far from a solution, and with as many active and changing contact rows.
     */
    bool
    add(const NonConvergence &failure, const NewtonState &last, const std::string &place);

  private:
    struct Attempt
    {
      std::type_index type;
      std::string     place;
      NewtonState     last;
    };
    const NewtonParameters &parameters;
    std::optional<Attempt>  before;
  };
} // namespace Touchstone

#endif
