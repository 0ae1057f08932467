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
  ImpulseContact::motion_of_obstacle(const ContactPair &pair,
                                     const Point<dim>  &x,
                                     const double       time,
                                     const double       step)
  {
    return -1. * pair.pairing().motion(time).since(pair.pairing().motion(time + step), x);
  }



  double
  ImpulseContact::largest_motion(const unsigned int p, const double time, const double step) const
  {
    const Pairing    &pairing = contact.pair(p).pairing();
    const RigidMotion now = pairing.motion(time), then = pairing.motion(time + step);
    // The axis may be anywhere: that of the centre of the slave surface, and what the turn adds.
    return (now.since(then, centre[p])).norm() +
           (then.turn - now.turn).norm() * (now.turned || then.turned ? radius[p] : 0.);
  }



  // A jump of an obstacle is a mistake of its formula: nodes that it passes would be pressed apart
  // on the wrong side, or thrown at a speed that nothing survives.
  void
  ImpulseContact::check_obstacles(const double time, const double step) const
  {
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const ContactPair &pair = contact.pair(p); !pair.master())
        {
          const double way = largest_motion(p, time, step);
          if (way <= smallest_face[p])
            continue;
          const RigidMotion now     = pair.pairing().motion(time),
                            then    = pair.pairing().motion(time + step);
          const Tensor<1, dim> move = then.shift - now.shift;
          unsigned int         axis = 0;
          for (unsigned int d = 1; d < dim; ++d)
            if (std::abs(move[d]) > std::abs(move[axis]))
              axis = d;
          char text[200];
          std::snprintf(text,
                        sizeof(text),
                        "moves the obstacle by %.4g within the cycle of %.4g at time %.6g, which "
                        "is more than a face of the body that it meets (%.4g)",
                        way,
                        step,
                        time,
                        smallest_face[p]);
          const ObstacleParameters &obstacle  = *pair.obstacle();
          const std::string *const  motions[] = {&obstacle.motion_x,
                                                 &obstacle.motion_y,
                                                 &obstacle.motion_z};
          const bool                turns     = now.turned || then.turned;
          throw InputError(obstacle.section(),
                           turns ? "Rotate angle" : "Motion " + std::string(1, "xyz"[axis]),
                           turns ? obstacle.rotate_angle : *motions[axis],
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
    row.drive      = motion_of_obstacle(pair, Point<dim>(x - here->gap_vector), time, step) / step;
    RowHistory &h  = history[of.index];
    h.drive_before = h.driven ? h.drive : row.drive;
    row.normal     = here->normal;
    if (tools.shift_dof(of.pair) != invalid_index)
      {
        row.levered = true;
        // Behind the slave node and the obstacle's own.
        const std::size_t slot = row.first + row.n_nodes;
        // About the node: at the obstacle's point the forces of friction on both would have a
        // moment.
        const Tensor<2, dim> lever = tools.lever(of.pair, x, time);
        if (row.along_normal)
          solver.on_normals[slot] = lever * row.normal;
        else
          solver.levers[slot] = lever;
      }
    if (row.tied)
      {
        // The point of the obstacle that the node had when the rows were made.
        const RigidMotion now = pair.pairing().motion(time);
        row.drive             = motion_of_obstacle(pair, x, time, step) / step;
        row.allowed           = (from.gap_vector + u_nodes[node] -
                       now.since(of.motion, now.place(of.motion.back(of.position)))) /
                      step;
        return;
      }
    const double gap   = here->gap_vector * here->normal - pair.part_of_overlap(time) * overlap;
    const double grows = (pair.part_of_overlap(time) - pair.part_of_overlap(time + step)) * overlap;
    from.at_start      = gap;
    row.allowed        = ((gap - gap_allowed(row, of, gap, step) + grows) / step) * row.normal;
  }
} // namespace Touchstone
