// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_explicit_parameters_h
#define touchstone_explicit_explicit_parameters_h

#include <touchstone/base/keyword.h>

#include <deal.II/base/parameter_handler.h>

namespace Touchstone
{
  /** @brief Keys of explicit dynamics in the section "Time integration". */
  struct ExplicitParameters
  {
    /** Length of a cycle as a part of the bound of the stable step; no unit. */
    double courant_factor = 0.95;
    /** What bounds the stable step: the largest frequency of any cell by itself, or of all cells
     * together, which is lower. */
    enum class StableStepBound
    {
      cells,
      power_iteration
    };
    Keyword<StableStepBound> stable_step{StableStepBound::cells,
                                         {{"cells", StableStepBound::cells},
                                          {"power iteration", StableStepBound::power_iteration}}};
    /** Cycles after which the stable step is computed anew. */
    unsigned int check_interval = 20;
    /** Bulk viscosity, linear and quadratic in the rate of the volume; no unit. */
    double linear_viscosity = 0.06, quadratic_viscosity = 1.2;
    /** Cells that need a shorter cycle get more mass; 0: none. Time. */
    double mass_scaling_step = 0.;
    /** Mass that may be added, relative to the mass of all bodies; no unit. */
    double largest_added_mass = 0.05;

    void
    declare(dealii::ParameterHandler &prm);

    bool
    viscous() const
    {
      return linear_viscosity > 0. || quadratic_viscosity > 0.;
    }

    /** @brief Whether all keys have their defaults: what else means nothing in implicit runs. */
    bool
    untouched() const;
  };
} // namespace Touchstone

#endif
