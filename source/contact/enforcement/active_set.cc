// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/first_of_ranks.h>
#include <touchstone/base/orthogonal.h>
#include <touchstone/base/reduction.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/contact/friction/friction_response.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The status that a row should have, and how strongly its present one is violated: a
     * nondimensional gap, 0 if it is not. */
    struct StatusViolation
    {
      double        size   = 0.;
      ContactStatus status = ContactStatus::open;
    };

    /** Relative distance from the friction cone at which a node is taken to be on
     * it: keeps nodes from chattering between stick and slip. */
    constexpr double on_the_cone = 1e-8;

    /** Gap over the size of a face up to which a row that the last linear system had closed is
     * open only because normals and contact points have changed with the increment. Whether it
     * opens is for the sign of its force to say: scaled by the stiffness of a cell this gap
     * outweighs the force of a thin body, and a band on a drum would lose all its rows whenever it
     * slides. A row that is farther off has not met what it was linearised about. */
    constexpr double gap_of_linearisation = 0.1;

    /**
     * The status with which a row closes. The normal force that closes the gap and the tangential
     * force that takes back the slip are estimated with the same stiffness E A / h: the row sticks
     * if its friction cone can bear the latter. If all rows stuck at first, nodes with a large slip
     * would be pulled back so strongly that they open again.
     * Alart and Curnier (1991), Comput. Methods Appl. Mech. Engng 92.
     */
    ContactStatus
    status_of_closing(const ContactRow &row)
    {
      if (!row.friction)
        return ContactStatus::slip;
      const SlipKinematics &k = row.friction->kinematics;
      return (k.start - row.stiffness * k.slip).norm() >
                 row.friction->cone(-row.stiffness * row.gap, /*sliding=*/false).force
               ? ContactStatus::slip
               : ContactStatus::stick;
    }



    /** Slip along tangents in which supports hold both sides of the row: nothing can take it back.
     */
    Tensor<1, dim>
    forced_slip(const ContactRow &row, const RowState &state)
    {
      const Tensor<1, dim> &slip = row.friction->kinematics.slip;
      return slip - orthogonal_part(slip, state.friction->held);
    }



    /** Slip that violates the friction law (length): all of it while sticking. While slipping, its
     * part across the force, but no more than the displacement L / (E A / h) that a force of the
     * size of the limit causes: where the limit is small, its direction matters little. */
    double
    slip_off_direction(const ContactRow &row, const RowState &state)
    {
      const FrictionForce  &f    = *state.friction;
      const Tensor<1, dim> &slip = row.friction->kinematics.slip;
      const double          size = slip.norm();
      if (state.status == ContactStatus::stick)
        return orthogonal_part(slip, f.held).norm();
      if (state.status != ContactStatus::slip || size == 0.)
        return 0.;
      const double across = (slip - (slip * f.direction) * f.direction).norm();
      return across * std::min(1., f.limit / (row.stiffness * size));
    }



    /** @param solved The state is the outcome of a linear system, in which the gaps of active rows
     * were closed. */
    StatusViolation
    status_violation(const ContactRow &row,
                     const RowState   &state,
                     const double      gap_tolerance,
                     const bool        solved)
    {
      if (row.tied || state.status == ContactStatus::no_partner)
        return {};
      if (!state.active())
        return {-row.gap / row.size > gap_tolerance ? -row.gap / row.size : 0.,
                status_of_closing(row)};
      const double scale = row.stiffness * row.size;
      const double gap   = row.gap / row.size;
      const bool   closed =
        solved && state.accepted > 0 && state.normal_accepted && gap < gap_of_linearisation;
      const double trial = state.lambda / scale - (closed ? 0. : gap);
      if (trial < -gap_tolerance)
        return {-trial, ContactStatus::open};
      if (!row.friction || state.dropped())
        return {};
      const FrictionForce &f = *state.friction;
      // The second part is what round-off makes of a slip.
      const double tolerance = on_the_cone * f.limit + 1e-4 * gap_tolerance * scale;
      if (state.status == ContactStatus::stick)
        {
          const bool forced = forced_slip(row, state).norm() > gap_tolerance * row.size;
          return {forced                 ? f.limit / scale
                  : f.excess > tolerance ? f.excess / scale
                                         : 0.,
                  ContactStatus::slip};
        }
      // A slip whose direction reverses within an iteration has come to rest in between: if the row
      // kept slipping, its direction would alternate for ever (doc/theory.md 6.4).
      const bool turned = f.direction * f.last_direction < 0.;
      return {turned                  ? f.limit / scale
              : f.excess < -tolerance ? -f.excess / scale
                                      : 0.,
              ContactStatus::stick};
    }



    /** How far a tied row is from its place in the directions that it decides on, one of them at a
     * symmetry plane less than elsewhere. */
    double
    tied_gap(const ContactRow &row, const RowState &state)
    {
      if (state.dropped())
        return 0.;
      Tensor<1, dim> gap = row.gap_vector;
      for (unsigned int d = 0; d < dim; ++d)
        if (state.refuses(d))
          gap[d] = 0.;
      return gap.norm();
    }



    /** By how much the conditions of a row are violated, relative to the size of the faces: gap,
     * and slip that friction does not permit. Newton's method judges it by the gap tolerance. */
    double
    violated_gap(const ContactRow &row, const RowState &state)
    {
      if (row.tied)
        return std::max(tied_gap(row, state) - state.admissible_gap, 0.) / row.size *
               state.spring.strictness();
      double gap = 0.;
      if (state.normal_accepted && (state.active() || row.gap < 0.))
        gap = std::abs(row.gap - (state.active() ? state.admissible_gap : 0.)) / row.size;
      if (!row.friction)
        return gap * state.spring.strictness();
      // A gap that is left in this row is elastic slip of the other rows of a shared node, where it
      // causes friction of c times the gap; so it is judged c / (E A / h) times as strictly.
      if (state.friction->shared && state.active() && state.normal_accepted)
        gap = std::max(gap,
                       std::abs(row.gap - state.admissible_gap) / row.size * state.friction->c /
                         row.stiffness);
      // Stick without elastic slip admits no slip at all.
      if (!state.friction->carried && !state.dropped())
        gap = std::max(gap, slip_off_direction(row, state) / row.size);
      return gap * state.spring.strictness();
    }



    /** A position of a row in an order that does not depend on the partition, as the numbers of
     * nodes do. */
    std::vector<double>
    order(const ContactRow &row)
    {
      const Point<dim> &x = row.reference;
      return {
        static_cast<double>(row.pair), x[0], x[1], x[2], static_cast<double>(row.between_nodes)};
    }



    /** The first row in this order, over all ranks, whose status is violated. */
    std::vector<double>
    first_violated(const ContactRows                               &rows,
                   const std::function<double(const ContactRow &)> &violation,
                   const MPI_Comm                                   communicator)
    {
      std::vector<double> first;
      for (const ContactRow &row : rows)
        if (violation(row) > 0. && (first.empty() || order(row) < first))
          first = order(row);
      return first_of_ranks(first, 5, communicator);
    }



    /** A number that identifies the status of a row; a sum of well-mixed numbers does not depend
     * on the partition. */
    std::uint64_t
    signature(const ContactRow &row, const ContactStatus status)
    {
      std::uint64_t h = (row.slave + 1) * 0x9E3779B97F4A7C15ull + 8 * row.pair +
                        4 * row.between_nodes + static_cast<std::uint64_t>(status);
      h ^= h >> 31;
      h *= 0xBF58476D1CE4E5B9ull;
      return h ^ (h >> 27);
    }
  } // namespace



  void
  Enforcement::change_status(const ContactRow &row, const ContactStatus status)
  {
    RowState  &state      = row_states[row];
    const bool was_active = state.active();
    state.status          = status;
    if (!was_active || !state.active())
      {
        clear(row);
        if (row.friction && state.active())
          {
            state.friction->base = row.friction->kinematics.start;
            // Springs of regularised friction resist from the next linear system on; their
            // force acts after it.
            if (state.friction->carried)
              friction_response(row, state.lambda, state);
          }
        return;
      }
    if (state.status == ContactStatus::stick && !state.friction->carried)
      {
        // From slip to stick: the force remains the same until the next linear solution.
        state.friction->base           = state.force - state.lambda * row.normal;
        state.friction->last_direction = Tensor<1, dim>();
      }
    evaluate_force(row, state);
  }



  ActiveSetUpdate
  Enforcement::update_active_set(const Contact     &contact,
                                 const double       gap_tolerance,
                                 const unsigned int damping,
                                 const bool         in_balance)
  {
    const MPI_Comm     communicator = contact.communicator();
    const ContactRows &rows         = contact.rows();
    // Damping level 3 and more: no row changes before the conditions of the present set are met.
    bool solve_first = false;
    if (damping > 2)
      {
        double gap = 0.;
        for (const ContactRow &row : rows)
          if (row_states[row].active())
            gap = std::max(gap, violated_gap(row, row_states[row]));
        solve_first = !in_balance || Utilities::MPI::max(gap, communicator) > gap_tolerance;
      }
    const auto violation = [&](const ContactRow &row) {
      return solve_first ? 0.
                         : status_violation(row, row_states[row], gap_tolerance, after_solve).size;
    };

    // Damping level 1: only rows change whose violation is at least half of the largest one.
    // Level 2 and more: only the first violated row, in an order that is fixed by geometry. That
    // rule (Murty 1974, Math. Programming 7) ends for every linear problem with a unique solution;
    // see doc/theory.md 5, "Cycles". It takes each set to be solved before it is judged, which one
    // linear solve does where the problem is linear.
    double              threshold = 0.;
    std::vector<double> only;
    if (damping == 1)
      {
        for (const ContactRow &row : rows)
          threshold = std::max(threshold, violation(row));
        threshold = 0.5 * Utilities::MPI::max(threshold, communicator);
      }
    else if (damping > 1)
      only = first_violated(rows, violation, communicator);

    ActiveSetUpdate result;
    double          largest = 0.;
    result.judged           = !solve_first;
    for (const ContactRow &row : rows)
      {
        RowState &state = row_states[row];
        if (exchanged(row))
          result.exchanged.push_back(&row);
        if (state.status == ContactStatus::no_partner)
          {
            if (state.lambda != 0. || state.force.norm() != 0.)
              ++result.changes;
            clear(row);
            continue;
          }
        result.gap                 = std::max(result.gap, violated_gap(row, state));
        const StatusViolation next = status_violation(row, state, gap_tolerance, after_solve);
        if (!solve_first && next.size > 0. && next.size >= threshold &&
            (only.empty() || only == order(row)))
          {
            // What is forced to slip begins with its force on the cone, or that of stick, which is
            // none, would lead back to stick.
            if (state.status == ContactStatus::stick && row.friction)
              if (const Tensor<1, dim> forced = forced_slip(row, state); forced.norm() > 0.)
                state.friction->last_direction = -forced / forced.norm();
            change_status(row, next.status);
            ++result.changes;
            result.changed.push_back(&row);
          }
        if (state.active())
          {
            ++result.active;
            largest =
              std::max(largest,
                       std::max(state.lambda, state.force.norm()) / (row.stiffness * row.size));
            result.signature += signature(row, state.status);
          }
      }
    after_solve          = false;
    std::uint64_t active = result.active, changes = result.changes,
                  exchanges = result.exchanged.size();
    Reduction all;
    all.max(result.gap);
    all.max(largest);
    all.sum(active);
    all.sum(changes);
    all.sum(exchanges);
    all.sum(result.signature);
    all.over(communicator);
    result.gap *= weight_of_gaps(largest);
    result.active    = active;
    result.changes   = changes;
    result.exchanges = exchanges;
    return result;
  }
} // namespace Touchstone
