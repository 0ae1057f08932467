// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_hardening_law_h
#define touchstone_solid_hardening_law_h

#include <touchstone/base/registry.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Touchstone
{
  /** @brief The yield stress at some equivalent plastic strain. */
  struct YieldStress
  {
    /** Force per area. */
    double value;
    /** Derivative by the plastic strain, >= 0, force per area. */
    double slope;
    /** Integral over the plastic strain from zero, energy per volume. */
    double work;
  };

  /**
   * @brief Isotropic hardening: the yield stress as a function of the equivalent plastic
   * strain. Registered by the name that the key "Hardening" takes; its parameters stand
   * beside that, in the subsection "Plasticity" of a material.
   */
  class HardeningLaw : public PluginParameters
  {
  public:
    /** @param plastic_strain >= 0, no unit. */
    virtual YieldStress
    at(double plastic_strain) const = 0;
  };

  using HardeningLawRegistry = Registry<HardeningLaw>;
} // namespace Touchstone

#endif
