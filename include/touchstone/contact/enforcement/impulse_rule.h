// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_impulse_rule_h
#define touchstone_contact_enforcement_impulse_rule_h

#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief How an enforcement finds the contact forces of a cycle of explicit dynamics
   * (doc/explicit.md, section 9.3). An enforcement that has such a rule serves explicit steps,
   * see Enforcement::impulse_rule().
   */
  struct ImpulseRule
  {
    enum class Method
    {
      /** The impulses after which no gap is negative at the end of the cycle. */
      projection,
      /** The first sweep of them alone. */
      one_sweep,
      /** Multipliers that springs of the size m / h^2 update until no gap is negative. */
      augmentation,
      /** Springs with the stiffness of the cells behind the faces, K A / V per area. */
      bulk_springs,
      /** Springs of the size m / h^2, with the mass of the nodes and the length h of cycles. */
      mass_springs
    };
    Method method = Method::projection;
    /** Of springs and augmentation: multiplies these stiffnesses; no unit. */
    double factor = 1.;

    /** @brief Forces follow from the gaps at the start of the cycle, and penetrations are left. */
    bool
    springs() const
    {
      return method == Method::bulk_springs || method == Method::mass_springs;
    }

    /** @brief Keys of section 'Contact' that it acts on and others do not. */
    std::vector<std::string>
    keys() const
    {
      if (springs())
        return {"Penalty factor", "Tangential factor"};
      if (method == Method::one_sweep)
        return {};
      std::vector<std::string> result{"Contact tolerance", "Contact iterations"};
      if (method == Method::augmentation)
        result.push_back("Penalty factor");
      return result;
    }
  };
} // namespace Touchstone

#endif
