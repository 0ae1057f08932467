// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_informed_solver_h
#define touchstone_drive_informed_solver_h

#include <touchstone/scene/scene.h>

#include <algorithm>

namespace Touchstone
{
  /** @brief The section "Linear solver" with what its solver should know of the materials. With
   * inertia in the system the stiffness alone says little of it. */
  inline LinearSolverParameters
  informed_solver(const Scene &scene)
  {
    LinearSolverParameters result = scene.linear_solver;
    if (!scene.time_integration.dynamic())
      for (const BodyParameters &body : scene.bodies)
        result.bulk_over_shear =
          std::max(result.bulk_over_shear,
                   body.material.bulk_modulus() / body.material.shear_modulus());
    return result;
  }
} // namespace Touchstone

#endif
