// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/moved_side.h>

namespace Touchstone
{
  std::optional<MovedSide>
  moved_side(const std::vector<PairBoundaries> &pairs,
             const std::vector<bool>           &touching,
             const unsigned int                 pair,
             const unsigned int                 n_bodies)
  {
    // Obstacles have no boundaries.
    const auto on_obstacle   = [&pairs](const unsigned int p) { return pairs[p].master.empty(); };
    const unsigned int slave = pairs[pair].slave_body, master = pairs[pair].master_body;
    for (const bool of_slave : {true, false})
      {
        if (!of_slave && on_obstacle(pair))
          break;
        MovedSide side{std::vector<bool>(n_bodies, false), of_slave};
        side.bodies[of_slave ? slave : master] = true;
        bool held                              = false;
        for (bool grows = true; grows;)
          {
            grows = false;
            for (unsigned int p = 0; p < pairs.size(); ++p)
              if (p != pair && touching[p])
                {
                  if (on_obstacle(p))
                    held = held || side.bodies[pairs[p].slave_body];
                  else if (side.bodies[pairs[p].slave_body] != side.bodies[pairs[p].master_body])
                    grows = side.bodies[pairs[p].slave_body] = side.bodies[pairs[p].master_body] =
                      true;
                }
          }
        const bool joined = !on_obstacle(pair) && side.bodies[slave] && side.bodies[master];
        if (!held && !joined)
          return side;
      }
    return std::nullopt;
  }
} // namespace Touchstone
