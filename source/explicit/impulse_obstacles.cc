// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/explicit/impulse_contact.h>

#include <cmath>
#include <cstdio>
#include <string>

// Obstacles in a cycle: how they move, and where nodes meet them (doc/explicit.md, section 9.1).
namespace Touchstone
{
  using namespace dealii;

  Tensor<1, dim>
  ImpulseContact::motion_of_obstacle(const ContactPair &pair, const double time, const double step)
  {
    return pair.pairing().shift(time + step) - pair.pairing().shift(time);
  }



  // A jump of an obstacle is a mistake of its formula: nodes that it passes would be pressed apart
  // on the wrong side, or thrown at a speed that nothing survives.
  void
  ImpulseContact::check_obstacles(const double time, const double step) const
  {
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const ContactPair &pair = contact.pair(p); !pair.master())
        {
          const Tensor<1, dim> move = motion_of_obstacle(pair, time, step);
          if (move.norm() <= smallest_face[p])
            continue;
          unsigned int axis = 0;
          for (unsigned int d = 1; d < dim; ++d)
            if (std::abs(move[d]) > std::abs(move[axis]))
              axis = d;
          char text[200];
          std::snprintf(text,
                        sizeof(text),
                        "moves the obstacle by %.4g within the cycle of %.4g at time %.6g, which "
                        "is more than a face of the body that it meets (%.4g)",
                        move.norm(),
                        step,
                        time,
                        smallest_face[p]);
          const ObstacleParameters &obstacle  = *pair.obstacle();
          const std::string *const  motions[] = {&obstacle.motion_x,
                                                 &obstacle.motion_y,
                                                 &obstacle.motion_z};
          throw InputError(obstacle.section(),
                           "Motion " + std::string(1, "xyz"[axis]),
                           *motions[axis],
                           text,
                           "let it move smoothly, as 'min(v*t, d)' or 'd*(1-cos(pi*t/T))/2' do");
        }
  }



  // The shape is met where the node is: curved obstacles need no criterion of motion.
  void
  ImpulseContact::set_obstacle_geometry(ImpulseRow  &row,
                                        KeptRow     &from,
                                        const double time,
                                        const double step)
  {
    const ContactRow  &of   = contact.rows()[from.index];
    const ContactPair &pair = contact.pair(of);
    const unsigned int node = solver.nodes.node(row.first);
    const Point<dim>   x(reference[node] + u_nodes[node]);
    const auto         here    = pair.pairing().at(x, time);
    const double       overlap = pair.overlap(of.index - pair.rows().front().index);
    row.drive                  = motion_of_obstacle(pair, time, step) / step;
    RowHistory &h              = history[of.index];
    h.drive_before             = h.driven ? h.drive : row.drive;
    row.normal                 = here->normal;
    if (row.tied)
      {
        row.allowed =
          (from.gap_vector + u_nodes[node] - (pair.pairing().shift(time) - of.shift)) / step;
        return;
      }
    const double gap   = here->gap_vector * here->normal - pair.part_of_overlap(time) * overlap;
    const double grows = (pair.part_of_overlap(time) - pair.part_of_overlap(time + step)) * overlap;
    from.at_start      = gap;
    row.allowed        = ((gap - gap_allowed(row, of, gap, step) + grows) / step) * row.normal;
  }
} // namespace Touchstone
