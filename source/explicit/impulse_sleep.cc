// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/impulse_contact.h>

#include <algorithm>
#include <limits>

// What need not be looked at in a cycle: rows that cannot be in reach, and motions that are too
// small for other rows (doc/explicit.md, section 9.5).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Sides that are farther apart than they come with so many times the highest velocity of their
     * nodes do not meet in the cycle: twice that velocity they come from both sides, and an impact
     * on other rows in the same cycle can double it. */
    constexpr double beyond_reach = 4.;
  } // namespace



  // Most cycles need not look at the motion of single faces and rows: nodes of a surface cannot
  // have moved by more, relative to each other, than the box of their velocities allows.
  bool
  ImpulseContact::renew_if_moved(const NodeField &u,
                                 const NodeField &before,
                                 const NodeField &v,
                                 const double     time,
                                 const double     step)
  {
    if (!surfaces.needed())
      return false;
    travelled.add(last_step, speeds_before);
    const RowTravel ahead(step, speeds);
    if (!motion.must_look(travelled, ahead))
      return false;
    import(u, before, v);
    for (unsigned int node = 0; node < solver.nodes.n(); ++node)
      moved[node] = u_nodes[node] + step * solver.velocity[node] - made_at[node];
    if (!motion.demands_rows(u, v, step, solver, moved, travelled, ahead, largest_weights))
      return true;
    renew(u, time, step);
    return false;
  }



  bool
  ImpulseContact::bring_rows(const NodeField &u,
                             const NodeField &before,
                             const NodeField &v,
                             const double     time,
                             const double     step)
  {
    if (parted)
      {
        if (!stays_parted(u, time, step))
          renew(u, time, step);
        return false;
      }
    return !start_interval(u, time, step) && renew_if_moved(u, before, v, time, step);
  }



  void
  ImpulseContact::part_sides(const NodeField &u, const double time, const double step)
  {
    parted = false;
    if (general || rule.springs())
      return;
    parted_gap    = planes.part(u);
    parted_travel = RowTravel();
    parted        = parted_gap > reach(time, step);
  }



  // The same planes as when the rows of Contact were those of the state: what nodes have passed
  // since is on a straight line on one side of them.
  bool
  ImpulseContact::stays_parted(const NodeField &u, const double time, const double step)
  {
    const double needed = reach(time, step);
    parted_travel.add(last_step, speeds_before);
    if (parted_gap - parted_travel.apart > needed)
      return true;
    parted_gap    = planes.gap(u);
    parted_travel = RowTravel();
    return parted_gap > needed;
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
        way = std::max(way, largest_motion(p, time, step) + step * tools.speed(p));
    return beyond_reach * way;
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
} // namespace Touchstone
