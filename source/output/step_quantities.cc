// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/step_quantity.h>

/**
 * @file
 * The built-in columns of the table `statistics`, one class for each group, registered by name.
 * Values are results of the whole model: what a quantity adds must be the same on all ranks,
 * although rank 0 alone writes the table.
 */

namespace Touchstone
{
  namespace
  {
    /**
     * A built-in group of columns, sorted by @p number. They are not repeated in summary.json from
     * here: RunSummary has these results already, with counts of the whole run instead of the last
     * step.
     */
    template <unsigned int number>
    class BuiltInQuantity : public StepQuantity
    {
    public:
      bool
      in_summary() const override
      {
        return false;
      }

      bool
      at_start() const override
      {
        return true;
      }

      unsigned int
      order() const override
      {
        return number;
      }
    };



    /**
     * Position in time and cost of the step: step size and cuts tell where the run had
     * difficulties.
     */
    class StepCounters : public BuiltInQuantity<0>
    {
    public:
      void
      evaluate(const ConvergedStep &step, StepValues &values) override
      {
        values.add("step", step.number);
        values.add("time", step.time);
        values.add("step size", step.step_size);
        values.add("Newton iterations", step.newton_iterations);
        values.add("linear iterations", step.linear_iterations);
        values.add("cuts", step.cuts);
        if (step.phase > 0)
          values.add("phase", step.phase);
        if (step.cycles)
          {
            values.add("cycles", step.cycles->first);
            values.add("shortest cycle", step.cycles->second);
          }
        if (step.contact_work)
          {
            values.add("contact sweeps", step.contact_work->mean_sweeps());
            values.add("most contact sweeps",
                       static_cast<unsigned int>(step.contact_work->most_sweeps));
            values.add("contact renewals", static_cast<unsigned int>(step.contact_work->renewals));
          }
      }
    };



    /**
     * Resultants of each contact pair: force on the slave body, moment about the origin, area,
     * extremes, and numbers of nodes by status.
     */
    class PairResults : public BuiltInQuantity<10>
    {
    public:
      void
      evaluate(const ConvergedStep &step, StepValues &values) override
      {
        for (const auto &[pair, result] : step.pairs)
          {
            values.add(pair, "force", result.force);
            values.add(pair, "moment", result.moment);
            values.add(pair, "area", result.area);
            values.add(pair, "max pressure", result.max_pressure);
            values.add(pair, "max penetration", result.max_penetration);
            values.add(pair, "active nodes", result.active);
            values.add(pair, "stick nodes", result.stick);
            values.add(pair, "slip nodes", result.slip);
          }
      }
    };



    /** What tightened bolts have come to, also in summary.json. */
    class PretensionResults : public BuiltInQuantity<15>
    {
    public:
      bool
      in_summary() const override
      {
        return true;
      }

      void
      evaluate(const ConvergedStep &step, StepValues &values) override
      {
        for (const auto &[pair, result] : step.pretension)
          {
            values.add(pair, "shortening", result.first);
            values.add(pair, "tension", result.second);
          }
      }
    };



    /** Where obstacles are that forces move, and what acts on them; also in summary.json. */
    class ToolResults : public BuiltInQuantity<16>
    {
    public:
      bool
      in_summary() const override
      {
        return true;
      }

      void
      evaluate(const ConvergedStep &step, StepValues &values) override
      {
        for (const auto &[name, result] : step.tools)
          {
            values.add("obstacle " + name, "displacement", result.displacement);
            values.add("obstacle " + name, "rotation", result.rotation);
            values.add("obstacle " + name, "force", result.force);
            values.add("obstacle " + name, "moment", result.moment);
            if (!result.dynamic)
              continue;
            values.add("obstacle " + name, "velocity", result.velocity);
            values.add("obstacle " + name, "angular velocity", result.angular_velocity);
          }
      }
    };



    /** Forces that supports exert on the bodies. */
    class Reactions : public BuiltInQuantity<20>
    {
    public:
      void
      evaluate(const ConvergedStep &step, StepValues &values) override
      {
        for (const auto &[boundary, force] : step.reactions)
          values.add(boundary, "reaction", force);
      }
    };



    /**
     * Terms of the balance of energy (doc/time_integration.md, "The energy ledger"); in statics
     * those that are known.
     */
    class EnergyTerms : public BuiltInQuantity<30>
    {
    public:
      void
      evaluate(const ConvergedStep &step, StepValues &values) override
      {
        for (const auto &[name, energy] : step.energies)
          values.add("energy: " + name, energy);
      }
    };



    /**
     * Linear and angular momentum of all bodies, to check conservation; only where there is
     * inertia.
     */
    class Momenta : public BuiltInQuantity<40>
    {
    public:
      void
      evaluate(const ConvergedStep &step, StepValues &values) override
      {
        if (!step.momentum)
          return;
        values.add("momentum", *step.momentum);
        values.add("angular momentum", *step.angular_momentum);
      }
    };

    const StepQuantityRegistry::Entry<StepCounters>
      step_counters_entry("counters", "Number, time and length of the step, and iterations.");
    const StepQuantityRegistry::Entry<PairResults>
      pair_results_entry("pair results", "Force, area, pressure and nodes of each contact pair.");
    const StepQuantityRegistry::Entry<PretensionResults>
      pretension_entry("pretension", "Shortening and tension of pairs with pretension.");
    const StepQuantityRegistry::Entry<ToolResults>
      tools_entry("tools", "Motion of obstacles that forces move, and what acts on them.");
    const StepQuantityRegistry::Entry<Reactions> reactions_entry("reactions",
                                                                 "Forces of supports on bodies.");
    const StepQuantityRegistry::Entry<EnergyTerms>
      energy_terms_entry("energies", "Energies, force times length.");
    const StepQuantityRegistry::Entry<Momenta>
      momenta_entry("momenta", "Momentum and angular momentum, where there is inertia.");
  } // namespace
} // namespace Touchstone
