// SPDX-License-Identifier: LGPL-2.1-or-later
// A column of the table `statistics`, which is in summary.json too, to start from. Copy to
// source/output/NAME.cc and change what is marked TODO: nothing else need be edited.

#include <touchstone/output/step_quantity.h>

namespace Touchstone
{
  namespace
  {
    /** TODO: what the quantity is: here the integral of the normal part of the contact force
     * over time, for each pair. */
    class ContactImpulse : public StepQuantity
    {
    public:
      void
      evaluate(const ConvergedStep &step, StepValues &values) override
      {
        for (const auto &[pair, result] : step.pairs)
          {
            impulse[pair] += step.step_size * result.force.norm();
            values.add(pair, "impulse", impulse[pair]);
          }
      }

      // What is summed over the steps goes into checkpoints.
      Memory
      memory() const override
      {
        return impulse;
      }

      void
      restore(const Memory &memory) override
      {
        impulse = memory;
      }

    private:
      /** By pair, force times time. */
      Memory impulse;
    };

    // TODO: a name of its own, and what it is, with its unit.
    const StepQuantityRegistry::Entry<ContactImpulse>
      contact_impulse("contact impulse",
                      "Integral of the contact force over time; force times time.");
  } // namespace
} // namespace Touchstone
