// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/impulse_contact.h>

#include <algorithm>

// Where the kept rows stand at the start of a cycle: gaps, and the velocity that they leave free
// (doc/explicit.md, sections 9.1 and 9.5).
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
} // namespace Touchstone
