// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/body_motion.h>
#include <touchstone/solid/bodies.h>

namespace Touchstone
{
  using namespace dealii;

  void
  move_bodies(const Solid &solid, const Motions &motions, const Vector &start, Vector &u)
  {
    const Vector                    position = present_positions(solid, start);
    const std::vector<unsigned int> body     = bodies_of_unknowns(solid);
    for (std::size_t i = 0; i < body.size(); i += dim)
      if (const std::optional<BodyMotion> &motion = motions[body[i]])
        {
          const Tensor<1, dim> moved =
            motion->at({position.begin()[i], position.begin()[i + 1], position.begin()[i + 2]});
          for (unsigned int d = 0; d < dim; ++d)
            u.begin()[i + d] += moved[d];
        }
  }
} // namespace Touchstone
