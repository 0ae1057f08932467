#include <touchstone/contact/friction/friction.h>
#include <touchstone/contact/row.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  Tensor<2, dim>
  tangential_projector(const Tensor<1, dim> &normal)
  {
    return Tensor<2, dim>(unit_symmetric_tensor<dim>()) - outer_product(normal, normal);
  }



  void
  FrictionState::find_tangents(const Vec &normal)
  {
    tangential = tangential_projector(normal);
    tangents.assign(frame.begin(), frame.end());
    for (const Vec &mirror : mirrors)
      {
        // What of the plane's normal is tangential, and not taken out by another plane.
        Vec          out    = tangential * mirror;
        const double length = out.norm();
        if (length < 1e-3)
          continue;
        out /= length;
        tangential -= outer_product(out, out);
        tangents.resize(tangents.size() - 1);
        if (tangents.size() == 1)
          tangents[0] = cross_product_3d(normal, out);
      }
  }



  void
  FrictionState::clear_force()
  {
    base = direction = last_direction = rest = coupling = area_coupling = turn = Vec();
    slip_coupling = slip_direction = Vec();
    unheld.clear();
    slope = last_slope = Mat();
    limit = excess = 0.;
  }



  FrictionLimit
  FrictionState::cone(const double normal_force, const bool sliding, const double slip) const
  {
    FrictionInput input;
    input.normal_force = std::max(normal_force, 0.);
    input.area         = area;
    input.slip_length  = slip_length + slip;
    input.slip_rate    = step > 0. ? slip / step : 0.;
    input.time         = time;
    input.sliding      = sliding;
    return law->limit(input);
  }



  FrictionLimit
  FrictionState::cone_of_springs(const double normal_force, const double trial) const
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



  FrictionState::Vec
  FrictionState::irreversible_slip(const Vec &force) const
  {
    return carried ? slip - (start - force) / c : slip;
  }



  void
  choose_friction(ContactRow &row)
  {
    FrictionState &f = *row.friction;
    if (!f.exact || f.shared)
      {
        f.regularise();
        return;
      }
    f.hold    = true;
    f.carried = false;
    f.c       = row.stiffness;
  }



  namespace
  {
    /** Bound of the stiffness across the slip direction over that along the
     * normal: it grows like 1 / |s| where slip begins. */
    constexpr double stiffest = 1e2;

    /** A trial force that is smaller, over the scale of contact forces, is what
     * round-off makes of the slip: it has no direction. */
    constexpr double nothing = 1e-12;
  } // namespace



  void
  respond(ContactRow &row)
  {
    if (row.tied)
      return;
    if (!row.friction)
      {
        row.force = row.lambda * row.normal;
        return;
      }
    using Vec                 = FrictionState::Vec;
    using Mat                 = FrictionState::Mat;
    FrictionState &f          = *row.friction;
    const bool     slipped    = row.status == ContactStatus::slip;
    const Mat     &tangential = f.tangential;
    FrictionLimit  limit = f.cone(row.lambda, slipped, slipped && !f.carried ? f.slip.norm() : 0.);

    // An exact slip force has no state of its own but its direction: that of the
    // last linearisation, corrected by the slip across it.
    Vec base = tangential * f.base;
    if (!f.carried && slipped && f.last_direction.norm() > 0.)
      base = tangential * (limit.force * f.last_direction - f.last_slope * f.slip);
    const Vec    trial = base - f.c * f.slip;
    const double size  = trial.norm();
    if (f.carried && slipped)
      limit = f.cone_of_springs(row.lambda, size);
    f.limit  = limit.force;
    f.excess = size - limit.force;
    Vec force;
    f.direction = f.rest = f.coupling = f.area_coupling = f.turn = Vec();
    f.slip_coupling = f.slip_direction = Vec();
    f.slope                            = Mat();
    if (!slipped)
      {
        force = f.hold ? base : trial;
        if (!f.hold)
          {
            f.rest  = trial;
            f.slope = f.c * tangential;
            if (f.carried)
              f.turn = cross_product_3d(f.start, row.normal);
          }
      }
    else if (size > nothing * row.stiffness * row.size)
      {
        const Vec direction = trial / size;
        force               = limit.force * direction;
        f.direction         = direction;
        // Springs take back part of what changes the limit, see cone_of_springs(). A limit that
        // falls faster than they unload has no solution nearby, and hence no derivative.
        const double by_slip = f.slip_derivative(limit);
        const double part    = f.carried ? 1. / std::max(0.1, 1. + by_slip / f.c) : 1.;
        f.coupling           = part * limit.slope * direction;
        f.area_coupling      = part * limit.area_slope * direction;
        f.rest = (limit.force - part * limit.slope * std::max(row.lambda, 0.)) * direction;
        const double room   = f.carried ? size : std::max(f.excess, 0.);
        const double kappa  = limit.force < stiffest * row.stiffness / f.c * room
                                ? limit.force * f.c / room
                                : stiffest * row.stiffness;
        const Mat    across = tangential - outer_product(direction, direction);
        f.slope             = kappa * across;
        if (!f.carried && f.last_direction.norm() > 0. &&
            f.c * f.slip.norm() <= nothing * row.stiffness * row.size)
          f.slope = Mat();
        if (!f.carried)
          f.rest -= f.slope * f.slip;
        else
          f.turn = limit.force / size * (across * cross_product_3d(f.start, row.normal));
        if (by_slip != 0. && f.carried)
          {
            // dL = part by_slip / c d|t_tr|, with t_tr = start - c s.
            f.slip_coupling  = -part * by_slip * direction;
            f.slip_direction = direction;
            f.turn += part * by_slip / f.c * (direction * cross_product_3d(f.start, row.normal)) *
                      direction;
          }
        else if (by_slip != 0. && f.c * f.slip.norm() > nothing * row.stiffness * row.size)
          {
            f.slip_coupling  = by_slip * direction;
            f.slip_direction = f.slip / f.slip.norm();
          }
      }
    row.force = row.lambda * row.normal + force;
  }
} // namespace Touchstone
