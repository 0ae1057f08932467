// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/holding_springs.h>
#include <touchstone/drive/motion_in_modes.h>
#include <touchstone/solid/bodies.h>

namespace Touchstone
{
  void
  HoldingSprings::attach(const Solid &solid, const Vector &u)
  {
    constexpr double first = 1e-4;
    fraction               = first;
    this->solid            = &solid;
    held_at                = u;
    modes                  = FreeMotion();
  }



  void
  HoldingSprings::act_on(const FreeMotion &motion)
  {
    modes = motion;
  }



  void
  HoldingSprings::soften()
  {
    constexpr double factor = 0.1, last = 1e-10;
    fraction *= factor;
    if (fraction < last)
      detach();
  }



  Vector
  HoldingSprings::resisted_motion(const Vector &u) const
  {
    return displacement_by_modes(*solid, modes, motion_in_modes(*solid, modes, held_at, u), u);
  }



  Vector
  HoldingSprings::forces(const Vector &u) const
  {
    Vector result = resisted_motion(u);
    result.scale(stiffness());
    result *= -1.;
    return result;
  }



  Vector
  HoldingSprings::stiffness() const
  {
    Vector                          result(solid->zero_vector());
    const std::vector<unsigned int> body = bodies_of_unknowns(*solid);
    for (unsigned int row = 0; row < body.size(); ++row)
      if (modes.bodies.count(body[row]) > 0)
        result.begin()[row] = fraction * solid->stiffness().diagonal(row);
    return result;
  }
} // namespace Touchstone
