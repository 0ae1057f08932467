#include <touchstone/contact/contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The state that a row asks for, and how strongly: a nondimensional gap, 0 if
     * it asks for nothing. */
    struct Wish
    {
      double        strength = 0.;
      ContactStatus status   = ContactStatus::open;
    };

    /** Relative distance from the friction cone at which a node is taken to be on
     * it: keeps nodes from chattering between stick and slip. */
    constexpr double on_the_cone = 1e-8;

    /**
     * How a row that closes begins. What closes the gap and what takes back the
     * slip are estimated with the same stiffness: does friction bear the latter?
     * To begin with sticking would tear nodes open again that have come a long way.
     * Alart and Curnier (1991), Comput. Methods Appl. Mech. Engng 92.
     */
    ContactStatus
    status_of_closing(const ContactRow &row)
    {
      if (!row.friction)
        return ContactStatus::slip;
      const FrictionState &f = *row.friction;
      return (f.start - row.stiffness * f.slip).norm() >
                 f.cone(-row.stiffness * row.gap, /*sliding=*/false).force
               ? ContactStatus::slip
               : ContactStatus::stick;
    }



    /** Slip that friction should not have let happen: all of it while sticking, else what is
     * across the force, or what the error of the force would move an elastic body by. */
    double
    slip_off_direction(const ContactRow &row)
    {
      const FrictionState &f = *row.friction;
      if (row.status == ContactStatus::stick)
        return f.slip.norm();
      const double slip = f.slip.norm();
      if (row.status != ContactStatus::slip || slip == 0.)
        return 0.;
      const double across = (f.slip - (f.slip * f.direction) * f.direction).norm();
      return across * std::min(1., f.limit / (row.stiffness * slip));
    }



    Wish
    wish(const ContactRow &row, const double gap_tolerance)
    {
      if (row.tied || row.status == ContactStatus::no_partner)
        return {};
      if (!row.active())
        return {-row.gap / row.size > gap_tolerance ? -row.gap / row.size : 0.,
                status_of_closing(row)};
      const double scale = row.stiffness * row.size;
      const double trial = row.lambda / scale - row.gap / row.size;
      if (trial < -gap_tolerance)
        return {-trial, ContactStatus::open};
      if (!row.friction || row.dropped())
        return {};
      const FrictionState &f = *row.friction;
      // The second part is what round-off makes of a slip.
      const double tolerance = on_the_cone * f.limit + 1e-4 * gap_tolerance * scale;
      if (row.status == ContactStatus::stick)
        return {f.excess > tolerance ? f.excess / scale : 0., ContactStatus::slip};
      // Slip that turns round within an iteration has come to rest on the way: left
      // to slip, the node would go back and forth for ever.
      const bool turned = f.direction * f.last_direction < 0.;
      return {turned                  ? f.limit / scale
              : f.excess < -tolerance ? -f.excess / scale
                                      : 0.,
              ContactStatus::stick};
    }



    void
    change_status(ContactRow &row, const ContactStatus status)
    {
      const bool was_active = row.active();
      row.status            = status;
      if (!was_active || !row.active())
        {
          row.clear_force();
          if (row.friction && row.active())
            {
              row.friction->base = row.friction->start;
              // Springs of regularised friction resist from the next linear system on; their
              // force acts after it.
              if (row.friction->carried)
                respond(row);
              row.force = Tensor<1, dim>();
            }
          return;
        }
      if (row.status == ContactStatus::stick && !row.friction->carried)
        {
          // The force stays what it is until the next solution.
          row.friction->base           = row.force - row.lambda * row.normal;
          row.friction->last_direction = Tensor<1, dim>();
        }
      respond(row);
    }
  } // namespace



  std::vector<double>
  Contact::order(const ContactRow &row) const
  {
    // Numbers of nodes depend on the partition, places do not.
    const auto      &nodes = pairs[row.pair].slave->owned_nodes();
    const auto       found = std::lower_bound(nodes.begin(),
                                        nodes.end(),
                                        row.slave,
                                        [](const SurfaceNode &node, const Index index) {
                                          return node.node < index;
                                        });
    const Point<dim> x     = found->reference;
    return {static_cast<double>(row.pair), x[0], x[1], x[2]};
  }



  std::vector<double>
  Contact::first_in_order(const std::function<double(const ContactRow &)> &demand) const
  {
    std::vector<double> first;
    for (const auto &pair_rows : rows)
      for (const ContactRow &row : pair_rows)
        if (demand(row) > 0. && (first.empty() || order(row) < first))
          first = order(row);
    for (const auto &other : Utilities::MPI::all_gather(solid.communicator, first))
      if (!other.empty() && (first.empty() || other < first))
        first = other;
    return first;
  }



  Contact::ActiveSetUpdate
  Contact::update_active_set(const double gap_tolerance, const unsigned int caution)
  {
    const auto demand = [&](const ContactRow &row) { return wish(row, gap_tolerance).strength; };

    // With caution only the rows that ask more than half as strongly as the
    // strongest change, then only the first row that asks at all: that rule ends
    // for every linear problem with a unique solution.
    // Murty (1974), Math. Programming 7.
    double              threshold = 0.;
    std::vector<double> only;
    if (caution == 1)
      {
        for (const auto &pair_rows : rows)
          for (const ContactRow &row : pair_rows)
            threshold = std::max(threshold, demand(row));
        threshold = 0.5 * Utilities::MPI::max(threshold, solid.communicator);
      }
    else if (caution > 1)
      only = first_in_order(demand);

    ActiveSetUpdate result;
    for (auto &pair_rows : rows)
      for (ContactRow &row : pair_rows)
        {
          if (row.status == ContactStatus::no_partner)
            {
              if (row.lambda != 0. || row.force.norm() != 0.)
                ++result.changes;
              row.clear_force();
              continue;
            }
          if ((row.tied ? row.refused == 0 : row.normal_accepted) && (row.active() || row.gap < 0.))
            result.gap =
              std::max(result.gap,
                       (row.tied ? row.gap_vector.norm() - row.granted_gap
                                 : std::abs(row.gap - (row.active() ? row.granted_gap : 0.))) /
                         row.size);
          // What is left of a gap is elastic slip of the other rows of a shared node, and so
          // friction.
          if (row.friction && row.friction->shared && row.active() && row.normal_accepted)
            result.gap = std::max(result.gap,
                                  std::abs(row.gap - row.granted_gap) / row.size * row.friction->c /
                                    row.stiffness);
          // What sticks without elastic slip must not have moved.
          if (row.friction && !row.friction->carried && !row.dropped())
            result.gap = std::max(result.gap, slip_off_direction(row) / row.size);
          const Wish next = wish(row, gap_tolerance);
          if (next.strength > 0. && next.strength >= threshold &&
              (only.empty() || only == order(row)))
            {
              change_status(row, next.status);
              ++result.changes;
            }
          if (row.active())
            {
              ++result.active;
              // A sum of well-mixed numbers does not depend on the partition.
              std::uint64_t h = (row.slave + 1) * 0x9E3779B97F4A7C15ull + 8 * row.pair +
                                static_cast<std::uint64_t>(row.status);
              h ^= h >> 31;
              h *= 0xBF58476D1CE4E5B9ull;
              result.signature += h ^ (h >> 27);
            }
        }
    result.gap       = Utilities::MPI::max(result.gap, solid.communicator);
    result.active    = Utilities::MPI::sum(result.active, solid.communicator);
    result.changes   = Utilities::MPI::sum(result.changes, solid.communicator);
    result.signature = Utilities::MPI::sum(result.signature, solid.communicator);
    return result;
  }
} // namespace Touchstone
