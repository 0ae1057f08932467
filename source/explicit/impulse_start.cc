// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/impulse_contact.h>

#include <algorithm>

// Contact at the start of the run and of an output interval (doc/explicit.md, sections 9.1 and
// 9.5).
namespace Touchstone
{
  using namespace dealii;

  void
  ImpulseContact::begin_interval()
  {
    renew_rows = true;
    counted    = ImpulseWork();
    untouched  = false;
    parted     = false;
    if (general)
      general->begin_interval();
    fastest = 0.;
    // Everything from the committed state, which is what a checkpoint has: sweeps begin from no
    // impulses.
    for (const ContactRow &row : contact.rows())
      {
        history[row.index]         = RowHistory();
        history[row.index].sliding = contact.state(row).status == ContactStatus::slip;
      }
  }



  bool
  ImpulseContact::start_interval(const NodeField &u, const double time, const double step)
  {
    if (!renew_rows)
      return false;
    interval_start = time;
    renew_rows     = false;
    // The rows of the committed state are those of the end of the interval before, and a checkpoint
    // has them.
    part_sides(u, time, step);
    if (!parted)
      make_rows(u);
    return true;
  }



  // Loads and stresses at the start that press closed sides together are balanced by contact then
  // as later: without it the velocity half a cycle before would part the sides, and the first cycle
  // would give the energy that brings them back. This is the projection of a cycle with time
  // reversed: gaps half a cycle before were not negative, but for sides that part with the initial
  // velocities.
  void
  ImpulseContact::project_before(const NodeField &u,
                                 const NodeField &start,
                                 NodeField       &v,
                                 const double     time,
                                 const double     step)
  {
    if (rule.springs())
      return;
    if (general)
      {
        general->begin_interval();
        general->begin_cycle(u, start, 0., v, step, /*only_touching=*/true);
      }
    ++counted.renewals;
    update_contact(u, time);
    make_rows(u);
    if (surfaces.needed())
      surfaces.measure({{&start, &speeds_before}, {&v, &speeds}});
    import(u, start, v);
    set_geometry(time, step);
    for (const std::size_t k : solver.near)
      {
        ImpulseRow          &row = solver.rows[k];
        const Tensor<1, dim> w   = solver.relative_velocity(row, v_before);
        // Rows of general contact touch.
        const double gap = k < kept.size() ? kept[k].at_start : 0.;
        row.friction     = nullptr; // made anew with the first cycle
        row.drive *= -1.;
        row.allowed =
          row.tied ? w : (std::max(0., gap) / step + std::max(0., w * row.normal)) * row.normal;
      }
    for (Tensor<1, dim> &velocity : solver.velocity)
      velocity *= -1.;
    solver.solve(control(time, step));
    for (Tensor<1, dim> &velocity : solver.velocity)
      velocity *= -1.;
    take_velocities(v);
  }
} // namespace Touchstone
