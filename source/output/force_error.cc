// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/step_quantity.h>

#include <cmath>

namespace Touchstone
{
  namespace
  {
    /** Estimated error of each contact force, relative, where 'Refinement' estimates it. */
    class ForceError : public StepQuantity
    {
    public:
      void
      evaluate(const ConvergedStep &step, StepValues &values) override
      {
        for (const auto &[pair, error] : step.force_errors)
          if (!std::isnan(error)) // without contact
            values.add(pair, "estimated force error", error);
      }

      unsigned int
      order() const override
      {
        return 11;
      }
    };

    const StepQuantityRegistry::Entry<ForceError> force_error_entry(
      "force error",
      "Estimated error of each contact force, where 'Refinement/Estimator' is 'contact force'.");
  } // namespace
} // namespace Touchstone
