// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/explicit/impulse_contact.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

// Where the kept rows stand at the start of a cycle: gaps, the velocity that they leave free, what
// drives obstacles, and the levers that keep the moment of momentum (doc/explicit.md, sections 9.1
// and 9.5).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** An overlap that contact has not caused, of bodies as they are placed or after a change of
     * partners, is undone by at most this part of a face in a cycle: the wave that this sends has
     * a strain of as much. */
    constexpr double undone = 1e-3;

    /** And no more than this part of it: what a change of weights or normals makes of a gap that
     * was closed is undone over many cycles, so that the work is no matter of one of them. */
    constexpr double undone_of_overlap = 0.05;

    /** Sides that are farther apart than they come with so many times the highest velocity of their
     * nodes do not meet in the cycle: twice that velocity they come from both sides, and an impact
     * on other rows in the same cycle can double it. */
    constexpr double beyond_reach = 4.;

    /** A lever shorter than this, relative to the size of the faces, is round-off. */
    constexpr double no_lever = 1e-13;

    /** How far the obstacle of a pair moves in a cycle. */
    Tensor<1, dim>
    motion_of_obstacle(const ContactPair &pair, const double time, const double step)
    {
      return pair.pairing().shift(time + step) - pair.pairing().shift(time);
    }



    /** The directions that friction acts along: tangential, and in planes of symmetry
     * (doc/theory.md 6). */
    Tensor<2, dim>
    directions_of_friction(const FrictionRow &friction, const Tensor<1, dim> &normal)
    {
      Tensor<2, dim> result = tangential_projector(normal);
      for (const Tensor<1, dim> &mirror : friction.mirrors)
        if (const Tensor<1, dim> out = result * mirror; out.norm() > 1e-3)
          result -= outer_product(out, out) / out.norm_square();
      return result;
    }
  } // namespace



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



  double
  ImpulseContact::reach(const double time, const double step) const
  {
    // Springs need the mobility of all rows, and rows with obstacles always take part.
    if (rule.springs() || !surfaces.needed())
      return std::numeric_limits<double>::max();
    double way = step * std::max(speeds.highest, speeds_before.highest);
    // An obstacle may drive a node that has rows with other bodies, too.
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const ContactPair &pair = contact.pair(p); !pair.master())
        way = std::max(way, motion_of_obstacle(pair, time, step).norm());
    return beyond_reach * way;
  }



  void
  ImpulseContact::set_geometry(const double time, const double step)
  {
    const double far = reach(time, step);
    find_near_rows(far);
    for (const std::size_t k : solver.near)
      {
        ImpulseRow       &row  = solver.rows[k];
        const RowHistory &h    = history[kept[k].index];
        const ContactRow &from = contact.rows()[kept[k].index];
        row.impulse            = h.impulse;
        row.sliding            = h.sliding;
        if (from.stencil.empty())
          set_obstacle_geometry(row, kept[k], time, step);
        else
          {
            set_pair_geometry(row, kept[k], time, step, far);
            set_time_to_sleep(k);
          }
        if (row.friction && !row.distant)
          {
            row.tangential  = directions_of_friction(*row.friction, row.normal);
            row.slip_length = row.friction->history.slip_length + h.path;
          }
      }
  }



  // A row that was distant stays so at least until its sides can have come together by what was
  // beyond reach. It is as the last look left it, without an impulse.
  void
  ImpulseContact::find_near_rows(const double reach)
  {
    solver.near.clear();
    const double needed = largest_weights * travelled.apart + reach;
    for (std::size_t k = 0; k < kept.size(); ++k)
      if (!(asleep_until[k] > needed))
        solver.near.push_back(k);
  }



  void
  ImpulseContact::set_time_to_sleep(const std::size_t k)
  {
    // Round-off of gaps and travels.
    constexpr double  safe = 1. - 1e-9;
    const ContactRow &of   = contact.rows()[kept[k].index];
    const bool        overlaps =
      contact.pair(of).overlap(of.index - contact.pair(of).rows().front().index) != 0.;
    asleep_until[k] = solver.rows[k].distant && !overlaps
                        ? safe * kept[k].at_start + largest_weights * travelled.apart
                        : 0.;
  }



  bool
  ImpulseContact::all_asleep(const double time, const double step) const
  {
    return all_asleep_until > largest_weights * travelled.apart + reach(time, step);
  }



  Tensor<1, dim>
  ImpulseContact::velocity_before(const ImpulseRow &row, const RowHistory &h) const
  {
    // Of an obstacle the velocity that it had then.
    return solver.relative_velocity(row, v_before) + (row.drive - h.drive_before);
  }



  // The gap that the end of the cycle may have, from that at its start: zero, or what is left of an
  // overlap. As far as the sides were closing, along the present normal, undoing it takes no work:
  // an impulse does work on the mean of the velocities before and after. So a node that slides in a
  // hollow comes back to its surface for nothing.
  // Where sides move apart by more than the gap has grown, as its normal has turned, the gap may
  // end as far within as takes no work, and comes back in this way.
  double
  ImpulseContact::gap_allowed(const ImpulseRow &row,
                              const ContactRow &of,
                              const double      gap,
                              const double      step) const
  {
    const double closing = -step * (velocity_before(row, history[of.index]) * row.normal);
    if (gap >= 0.)
      return std::min(0., gap + std::min(0., closing));
    const double pressed = std::min(undone * of.size, -undone_of_overlap * gap);
    return std::min(0., gap + std::max(pressed, closing));
  }



  void
  ImpulseContact::set_pair_geometry(ImpulseRow  &row,
                                    KeptRow     &from,
                                    const double time,
                                    const double step,
                                    const double reach)
  {
    const ContactRow &of = contact.rows()[from.index];
    row.normal           = of.normal;
    row.distant          = false;
    Tensor<1, dim> by_motion;
    for (unsigned int i = 0; i < row.n_nodes; ++i)
      {
        const std::size_t s = solver.slot(row, i);
        by_motion += solver.weights[s] * u_nodes[solver.nodes.node(s)];
      }
    if (row.tied)
      {
        set_lever(row, of);
        row.allowed = (from.gap_vector + by_motion) / step;
      }
    else
      {
        const ContactPair &pair    = contact.pair(of);
        const double       overlap = pair.overlap(of.index - pair.rows().front().index);
        // The row was made with the part of an initial overlap that counted then.
        const double gap =
          from.gap + by_motion * row.normal + (from.part - pair.part_of_overlap(time)) * overlap;
        const double grows =
          (pair.part_of_overlap(time) - pair.part_of_overlap(time + step)) * overlap;
        from.at_start  = gap;
        row.distant    = std::min(gap, gap + grows) > reach && row.impulse.norm_square() == 0.;
        row.levered    = false;
        double allowed = 0.; // gap at the end of the cycle
        if (!row.distant)
          {
            set_lever(row, of);
            allowed = gap_allowed(row, of, gap, step);
          }
        row.allowed = ((gap - allowed + grows) / step) * row.normal;
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
    h.drive                    = row.drive;
    h.driven                   = true;
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



  // The forces of a row on its nodes, f and -w_m f, have the moment d x f about any point, with d
  // from the contact point to the slave node: none if f acts along d. Forces c (y x J^-1 (d x f))
  // on the n nodes around the slave node, at y from their mean, with c = 1/n and J = sum c (|y|^2 I
  // - y y), take it up. Zywicz and Puso (1999), Int. J. Numer. Methods Engng 44, have a moment arm
  // for the same purpose.
  // With small sliding partners stay as they were in the reference state, and the line from the
  // contact point to the slave node grows with the sliding: such a lever would turn the rate of the
  // gap into something else. These pairs keep linear momentum alone, as in implicit runs.
  void
  ImpulseContact::set_lever(ImpulseRow &row, const ContactRow &of)
  {
    row.levered = false;
    if (contact.pair(of).small_sliding() && !row.tied)
      return;
    Tensor<1, dim> d;
    for (unsigned int i = 0; i < row.n_nodes; ++i)
      {
        const std::size_t  s    = solver.slot(row, i);
        const unsigned int node = solver.nodes.node(s);
        d += solver.weights[s] * (reference[node] + u_nodes[node]);
      }
    // Along the normal it has no moment with a normal force.
    const double across = (d - (d * of.normal) * of.normal).norm();
    row.levered         = (row.friction || row.tied ? d.norm() : across) > no_lever * of.size;
    if (!row.levered)
      return;
    const std::size_t first = row.first + row.n_nodes, last = first + row.n_lever;
    const double      c = 1. / row.n_lever;
    Tensor<1, dim>    mean;
    const auto        position = [&](const std::size_t s) {
      return reference[solver.nodes.node(s)] + u_nodes[solver.nodes.node(s)];
    };
    for (std::size_t s = first; s < last; ++s)
      mean += c * position(s);
    Tensor<2, dim> inertia;
    for (std::size_t s = first; s < last; ++s)
      {
        const Tensor<1, dim> y = position(s) - mean;
        inertia += c * (y.norm_square() * Tensor<2, dim>(unit_symmetric_tensor<dim>()) -
                        outer_product(y, y));
      }
    const Tensor<2, dim> turn = invert(inertia) * cross_matrix(d);
    for (std::size_t s = first; s < last; ++s)
      solver.levers[s] = c * cross_matrix(position(s) - mean) * turn;
  }
} // namespace Touchstone
