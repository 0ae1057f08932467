// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_own_moduli_h
#define touchstone_solid_own_moduli_h

#include <touchstone/base/plugin_parameters.h>

namespace Touchstone
{
  /** @brief Keys of a law whose elastic constants are not Young's modulus and Poisson's ratio: the
   * keys "Young modulus", and unless keeps_poisson_ratio() "Poisson ratio", do not exist in a scene
   * where such a law is chosen. Stiffnesses of contact and time steps follow from the isotropic
   * moduli that it gives instead. */
  class OwnModuli : public PluginParameters
  {
  public:
    /** @brief Whether the volume change is given by the key "Poisson ratio". */
    virtual bool
    keeps_poisson_ratio() const
    {
      return true;
    }

    /** @brief Shear modulus at the undeformed state, or the largest where it depends on the
     * direction; force per area. */
    virtual double
    initial_shear_modulus() const = 0;
  };
} // namespace Touchstone

#endif
