// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/impulse_contact.h>
#include <touchstone/explicit/row_geometry.h>

#include <algorithm>

// Where the kept rows stand at the start of a cycle: gaps, and the velocity that they leave free
// (doc/explicit.md, sections 9.1 and 9.5).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
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
    if (general)
      general->set_geometry(solver, kept.size(), x_nodes, v_before, step);
  }



  Tensor<1, dim>
  ImpulseContact::velocity_before(const ImpulseRow &row, const RowHistory &h) const
  {
    // Of an obstacle the velocity that it had then.
    return solver.relative_velocity(row, v_before) + (row.drive - h.drive_before);
  }



  double
  ImpulseContact::gap_allowed(const ImpulseRow &row,
                              const ContactRow &of,
                              const double      gap,
                              const double      step) const
  {
    const double closing = -step * (velocity_before(row, history[of.index]) * row.normal);
    return allowed_gap(gap, closing, of.size);
  }



  // With small sliding partners stay as they were in the reference state, and the line from the
  // contact point to the slave node grows with the sliding: such a lever would turn the rate of the
  // gap into something else. These pairs keep linear momentum alone, as in implicit runs.
  void
  ImpulseContact::set_lever(ImpulseRow &row, const ContactRow &of)
  {
    row.levered = false;
    if (!contact.pair(of).small_sliding() || row.tied)
      Touchstone::set_lever(solver, row, x_nodes, of.normal, of.size);
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
        const ContactPair &pair = contact.pair(of);
        const double       overlap =
          weight_of_slave(of) * pair.overlap(of.index - pair.rows().front().index);
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
