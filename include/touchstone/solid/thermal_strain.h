// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_thermal_strain_h
#define touchstone_solid_thermal_strain_h

#include <touchstone/base/formula.h>
#include <touchstone/solid/material_law.h>

#include <memory>

namespace Touchstone
{
  struct MaterialParameters;
  class Solid;

  /** @brief @p law with the thermal strain that the material has; the same law if it has none. */
  std::shared_ptr<const MaterialLaw>
  with_thermal_strain(const MaterialParameters                 &material,
                      const std::shared_ptr<const MaterialLaw> &law);

  /** @brief The temperatures at which the material has a size: 1 + aT > 0. */
  FormulaBounds
  possible_temperatures(const MaterialParameters &material);

  /** @brief Tell, after a material law has failed, whether a temperature is to blame: laws know
   * numbers only. Collective.
   * @throws InputError on all ranks if a temperature is not possible at time @p t. */
  void
  check_temperatures(const Solid &solid, double t);
} // namespace Touchstone

#endif
