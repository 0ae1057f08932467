// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_friction_friction_law_h
#define touchstone_contact_friction_friction_law_h

#include <touchstone/base/registry.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Touchstone
{
  /** @brief Arguments of a friction law, at one slave node. */
  struct FrictionInput
  {
    /** Normal contact force, >= 0, force. */
    double normal_force = 0.;
    /** Tributary area in the reference state, as far as it is covered at present. */
    double area = 0.;
    /** Length of the slip path since the start, irreversible slip only, including that of the
     * present step; length. */
    double slip_length = 0.;
    /** Slip of the step divided by its length in time: length per time, >= 0; zero while the
     * node sticks. In statics time is that of the loads. */
    double slip_rate = 0.;
    /** Time at the end of the step. */
    double time = 0.;
    /** Whether the node slips at present or sticks. */
    bool sliding = false;
  };

  /** @brief The largest tangential force that friction can bear. */
  struct FrictionLimit
  {
    /** Force, >= 0. */
    double force = 0.;
    /** Its derivative with respect to the normal force, no unit. */
    double slope = 0.;
    /** Its derivative with respect to the area, force per area. */
    double area_slope = 0.;
    /** Its derivative with respect to the length of the slip path, force per length. */
    double slip_slope = 0.;
    /** Its derivative with respect to the slip rate, force times time per length. */
    double rate_slope = 0.;
  };

  /**
   * @brief The radius of the friction cone: the tangential force of a slave node
   * stays below it while the node sticks, and is equal to it, against the
   * motion, when it slips (doc/theory.md 6.1, equation (15)). Registered by its value of the key
   * "Behaviour" of a contact pair; its parameters are in the subsection "Friction".
   *
   * The law is evaluated at the end of the step (backward Euler): the result of a law that
   * depends on the slip path does not depend on the number of steps that the path is made in.
   */
  class FrictionLaw : public PluginParameters
  {
  public:
    virtual FrictionLimit
    limit(const FrictionInput &input) const = 0;
  };

  using FrictionLawRegistry = Registry<FrictionLaw>;
} // namespace Touchstone

#endif
