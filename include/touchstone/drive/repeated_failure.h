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
    /**
     * @param parameters Their tolerances: residuals and gaps that meet them do not distinguish
     * attempts.
     */
    explicit RepeatedFailure(const NewtonParameters &parameters)
      : parameters(parameters)
    {
    }

    /** @brief A step has converged: forget the failure of earlier attempts. */
    void
    forget();

    /**
     * @brief A step has failed.
     * @param failure The reason.
     * @param last State of the last Newton iteration; its residual is NaN if there was none.
     * @param place Text that identifies the position of the failure in the model.
     * @return whether the previous attempt failed with the same reason, at the same position,
     * equally bad and far from a solution, and with as many active and changing contact rows. All
     * iterations that end in balance are alike: after these the measure of the failure must be the
     * same, and one without a measure never counts as repeated.
     */
    bool
    add(const NonConvergence &failure, const NewtonState &last, const std::string &place);

  private:
    struct Attempt
    {
      std::type_index       type;
      std::optional<double> measure;
      std::string           place;
      NewtonState           last;
    };
    const NewtonParameters &parameters;
    std::optional<Attempt>  before;
  };
} // namespace Touchstone

#endif
