// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/friction/friction.h>
#include <touchstone/contact/friction/friction_response.h>
#include <touchstone/contact/friction/slip_kinematics.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>

// The friction force of one row, and its derivatives, from the normal force and the slip: the trial
// force of doc/theory.md 6.1, equation (16), the slip direction (17), and the coefficients of the
// linearised force (21). Each enforcement first chooses the formulation (the base t_b and the
// constant c of FrictionForce), then calls friction_response() or evaluate_force(); RowTerms puts
// the response into the linear system.
namespace Touchstone
{
  using namespace dealii;

  Tensor<2, dim>
  tangential_projector(const Tensor<1, dim> &normal)
  {
    return Tensor<2, dim>(unit_symmetric_tensor<dim>()) - outer_product(normal, normal);
  }



  // An iterate can be in tension; a cone of negative radius has no meaning, and the law may assume
  // a pressure. Slip path and slip rate are those at the end of the step (backward Euler,
  // doc/theory.md 6.3), so that the result does not depend on the size of the steps.
  FrictionLimit
  FrictionRow::cone(const double normal_force, const bool sliding, const double slip) const
  {
    FrictionInput input;
    input.normal_force = std::max(normal_force, 0.);
    input.area         = kinematics.area;
    input.slip_length  = history.slip_length + slip;
    input.slip_rate    = kinematics.step > 0. ? slip / kinematics.step : 0.;
    input.time         = kinematics.time;
    input.sliding      = sliding;
    return law->limit(input);
  }



  // The irreversible slip of springs is s_p = (|t_tr| - L) / c, and the limit L may depend on it
  // (doc/theory.md 6.3, "Limits that change with the slip"). The scalar equation is solved at the
  // node, for a limit that lags by an iteration would leave the force off its cone.
  FrictionLimit
  FrictionRow::cone_of_springs(const double normal_force, const double trial, const double c) const
  {
    // c s + L(s) = |t_tr| has a solution between 0 and |t_tr| / c, as L >= 0: Newton's method,
    // and bisection where it leaves what is left of this interval.
    FrictionLimit limit = cone(normal_force, /*sliding=*/true);
    double        low = 0., high = trial / c, slip = (trial - limit.force) / c;
    for (unsigned int i = 0; i < 60 && slip > 0.; ++i)
      {
        limit                 = cone(normal_force, /*sliding=*/true, slip);
        const double residual = c * slip + limit.force - trial;
        if (std::abs(residual) <= 1e-14 * trial)
          break;
        (residual < 0. ? low : high) = slip;
        slip -= residual / (c + slip_derivative(limit));
        if (!(slip > low && slip < high))
          slip = 0.5 * (low + high);
      }
    return limit;
  }



  // The springs of regularised friction were stretched by t_b / alpha_t when the step began and are
  // by t / alpha_t now: this difference is stored and not dissipated (doc/theory.md 6.2). Other
  // formulations have no elastic slip.
  Tensor<1, dim>
  irreversible_slip(const FrictionRow    &friction,
                    const FrictionForce  &f,
                    const Tensor<1, dim> &force)
  {
    const SlipKinematics &k = friction.kinematics;
    return f.carried ? k.slip - (k.start - force) / f.c : k.slip;
  }



  void
  regularise_friction(const ContactRow &row, RowState &state)
  {
    state.friction->constrained = false;
    state.friction->carried     = true;
    // Force and slip of the row of a point are 1 / share and share times those of the point, whose
    // spring must not depend on which of its nodes has the row.
    const double share   = share_of_point(row);
    state.friction->c    = row.friction->alpha / (share * share);
    state.friction->base = row.friction->kinematics.start;
  }



  // Conditions can hold a node only where its tangential force follows from equilibrium. At shared
  // nodes it does not, and the elastic slip of the springs has to divide the force (doc/theory.md
  // 6, "Stick at the edge of two obstacles").
  void
  choose_friction(const ContactRow &row, RowState &state)
  {
    if (!row.friction->exact || state.friction->shared)
      {
        regularise_friction(row, state);
        return;
      }
    state.friction->constrained = true;
    state.friction->carried     = false;
    state.friction->c           = row.stiffness;
  }



  // Uzawa's update t_k <- t_k - k s_T, only along those tangents for which the graph refused a
  // condition (doc/theory.md 6, "Stick where the slave node is not free"). Where nothing can move,
  // updates would go on for ever: there the force stays as it was when the step began.
  void
  augment_unconstrained(const ContactRow &row, RowState &state)
  {
    const SlipKinematics &k    = row.friction->kinematics;
    Tensor<1, dim>       &base = state.friction->base;
    for (const Tensor<1, dim> &tangent : state.friction->unconstrained)
      {
        const double slip = k.slip * tangent;
        base -= state.spring.of(row.stiffness) * slip * tangent;
        state.spring.found(std::abs(slip));
      }
    for (const Tensor<1, dim> &tangent : state.friction->held)
      base += ((k.start - base) * tangent) * tangent;
  }



  void
  judge_springs(const ContactRow &row, RowState &state)
  {
    if (row.friction && state.status == ContactStatus::slip && state.friction->bounded &&
        !state.friction->carried)
      {
        const Tensor<1, dim> &slip = row.friction->kinematics.slip,
                             &last = state.friction->last_direction;
        state.spring.found((slip - (slip * last) * last).norm());
      }
    constexpr double part_of_face = 1e-11;
    state.spring.judge(
      std::max(part_of_face * row.size,
               64. * std::numeric_limits<double>::epsilon() * row.position.norm()));
  }



  // Tangents without a condition: their springs carry the augmented force. Together it is the base
  // t_b of the next trial force, (16).
  void
  set_stick(RowState &state, const Tensor<1, dim> &normal)
  {
    for (const auto &tangents : {state.friction->unconstrained, state.friction->held})
      for (const Tensor<1, dim> &tangent : tangents)
        state.force += (state.friction->base * tangent) * tangent;
    state.friction->base = state.force - state.lambda * normal;
  }



  namespace
  {
    /** A trial force below this fraction of E A is round-off of the slip, and its direction is
     * arbitrary: no friction acts then. */
    constexpr double nothing = 1e-12;



    /** Derivatives of the force of stick on springs, doc/theory.md 6.3. */
    void
    linearise_springs(const ContactRow &row, const Tensor<1, dim> &trial, FrictionForce &f)
    {
      // The trial force holds at the present slip; with the increment it changes by -c T_n ds. A
      // base that is carried along turns with the frame as well: omega n x t_b = -omega (t_b x n).
      f.constant = trial;
      f.tangent  = f.c * row.friction->kinematics.tangential;
      if (f.carried)
        f.d_spin = cross_product_3d(row.friction->kinematics.start, row.normal);
    }



    /** Derivatives of the force L trial / |trial| in slip, doc/theory.md 6.3.
     * @param stiffest Bound of the stiffness kappa_T across the slip direction: kappa_T grows like
     * 1 / |s| where slip begins, and would spoil the condition of the system. */
    void
    linearise_slip(const ContactRow     &row,
                   const double          lambda,
                   const FrictionLimit  &limit,
                   const Tensor<1, dim> &trial,
                   const double          stiffest,
                   FrictionForce        &f)
    {
      const SlipKinematics &k         = row.friction->kinematics;
      const double          size      = trial.norm();
      const Tensor<1, dim>  direction = trial / size;
      f.direction                     = direction;
      // On springs a change of the limit changes the irreversible slip and so the limit again, see
      // cone_of_springs(): dL is divided by 1 + L_s / alpha_t (doc/theory.md 6.3). If the limit
      // falls faster with the slip than the springs unload, the denominator is not positive and
      // no equilibrium is near; it is bounded from below.
      const double by_slip = row.friction->slip_derivative(limit);
      const double part    = f.carried ? 1. / std::max(0.1, 1. + by_slip / f.c) : 1.;
      // In tension the cone is a point, see FrictionRow::cone(). Rows in tension open, but not
      // before the others are in balance where a set is solved before it is judged (doc/theory.md
      // 5).
      const double slope = lambda < 0. ? 0. : limit.slope;
      f.d_lambda         = part * slope * direction;
      f.d_area           = part * limit.area_slope * direction;
      // The constant t_0 is such that t_0 + d_lambda lambda is the present force at the present
      // lambda; the part with lambda follows lambda within the linear solve.
      f.constant = (limit.force - part * slope * std::max(lambda, 0.)) * direction;
      // Stiffness across the slip direction: kappa = L c / (|t_tr| - L), equation (17), for exact
      // and augmented friction; L alpha_t / |t_tr|, the tangent of radial return, for springs. The
      // comparison is written as a product, so that a vanishing denominator gives the bound.
      const double distance         = f.carried ? size : std::max(f.excess, 0.);
      f.bounded                     = !(limit.force * f.c < stiffest * distance);
      const double         kappa    = f.bounded ? stiffest : limit.force * f.c / distance;
      const Tensor<2, dim> across   = k.tangential - outer_product(direction, direction);
      const bool           has_slip = f.c * k.slip.norm() > nothing * row.stiffness * row.size;
      f.tangent                     = kappa * across;
      // At the start of a step the slip is zero, and kappa would resist any change of the direction
      // that was taken over from the last step (doc/theory.md 6.4).
      if (!f.carried && f.last_direction.norm() > 0. && !has_slip)
        f.tangent = Tensor<2, dim>();
      // Equation (17) sets the force by the total slip across it, that of springs by its change.
      if (!f.carried)
        f.constant -= f.tangent * k.slip;
      else
        f.d_spin = limit.force / size * (across * cross_product_3d(k.start, row.normal));
      if (by_slip != 0. && f.carried)
        {
          // dL = part by_slip / c d|t_tr|, with t_tr = start - c s.
          f.d_slip         = -part * by_slip * direction;
          f.slip_direction = direction;
          f.d_spin +=
            part * by_slip / f.c * (direction * cross_product_3d(k.start, row.normal)) * direction;
        }
      else if (by_slip != 0. && has_slip)
        {
          f.d_slip         = by_slip * direction;
          f.slip_direction = k.slip / k.slip.norm();
        }
    }
  } // namespace



  Tensor<1, dim>
  friction_response(const ContactRow &row, const double lambda, RowState &state)
  {
    FrictionForce        &f       = *state.friction;
    const SlipKinematics &k       = row.friction->kinematics;
    const bool            slipped = state.status == ContactStatus::slip;
    FrictionLimit         limit =
      row.friction->cone(lambda, slipped, slipped && !f.carried ? k.slip.norm() : 0.);

    // An exact slip force has no state of its own but its direction: that of the
    // last linearisation, corrected by the slip across it.
    Tensor<1, dim> base = k.tangential * f.base;
    if (!f.carried && slipped && f.last_direction.norm() > 0.)
      // The force that (17) gave in the iteration before, with its direction and kappa, at the
      // present slip.
      base = k.tangential * (limit.force * f.last_direction - f.last_tangent * k.slip);
    const Tensor<1, dim> trial = base - f.c * k.slip;
    const double         size  = trial.norm();
    if (f.carried && slipped)
      limit = row.friction->cone_of_springs(lambda, size, f.c);
    f.bounded   = false;
    f.limit     = limit.force;
    f.excess    = size - limit.force;
    f.direction = f.constant = f.d_lambda = f.d_area = f.d_spin = Tensor<1, dim>();
    f.d_slip = f.slip_direction = Tensor<1, dim>();
    f.tangent                   = Tensor<2, dim>();
    if (!slipped)
      {
        // Conditions hold the node: the base is the force of the last linear solve, and the next
        // solve finds a new one.
        if (f.constrained)
          return base;
        linearise_springs(row, trial, f);
        return trial;
      }
    if (size <= nothing * row.stiffness * row.size)
      return Tensor<1, dim>();
    // Closed in this iteration, and the friction that takes back its slip is within the cone: the
    // row goes on to stick. A force on the cone would have the direction of what an iterative
    // solver leaves of a slip, and stay where no condition can replace it.
    const bool sticks_next = !f.carried && f.last_direction.norm() == 0. && f.excess < 0.;
    linearise_slip(row, lambda, limit, trial, state.spring.of(row.stiffness), f);
    return sticks_next ? trial : limit.force * f.direction;
  }



  void
  evaluate_force(const ContactRow &row, RowState &state)
  {
    if (row.tied)
      return;
    state.force = state.lambda * row.normal;
    if (row.friction)
      state.force += friction_response(row, state.lambda, state);
  }



  // The part d_lambda lambda of equation (21) makes the system unsymmetric, for it acts along the
  // tangent while the condition acts along the normal. At a given lambda it is a load: a fixed
  // point over Tresca problems (doc/theory.md 6.3, "Lagged friction").
  void
  lag_friction(const ContactRow &row, RowState &state, const double lambda)
  {
    if (!row.friction || !state.active() || row.tied)
      return;
    const double lagged = std::max(lambda, 0.);
    friction_response(row, lagged, state);
    state.friction->constant += lagged * state.friction->d_lambda;
    state.friction->d_lambda = Tensor<1, dim>();
  }
} // namespace Touchstone
