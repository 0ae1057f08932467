// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/forcing_term.h>

#include <algorithm>

namespace Touchstone
{
  ForcingTerm::ForcingTerm(const double usual, const double residual_tolerance, const bool friction)
    : usual(usual)
    , residual_tolerance(residual_tolerance)
    , friction(friction)
  {
  }



  void
  ForcingTerm::begin_step()
  {
    last_residual = 0.;
    has_been_slow = false;
  }



  void
  ForcingTerm::update(const NewtonState &state, const bool leaves_out)
  {
    // A solve that goes far below what Newton needs in the end is wasted. But one
    // that moves supports has a right-hand side much larger than the forces that
    // it leads to, and one that leads to wrong signs of contact forces costs
    // further iterations: these get two digits more, three where stick and slip are
    // told apart by small differences. One that can be the last should be: it aims well
    // below the residual that Newton asks for, with two digits more if it takes them.
    const double last = 0.03 * residual_tolerance / state.residual;
    next              = usual;
    if (!state.prescribed || state.changes > 0)
      next *= friction ? 1e-3 : 1e-2;
    else
      {
        // Symmetric systems leave out how normals change, and Newton converges linearly: to
        // solve much better than what that left of the last residual is wasted. A tenth of it
        // and more would cost another solve now and then.
        double left = 0.;
        if (last_residual > 0. && leaves_out)
          left = 0.03 * state.residual / last_residual;
        if (state.residual > 0. && last >= 1e-2 * usual)
          next = std::min(last, std::max(usual, 0.1));
        next = std::max(next, std::min(left, 1e-2));
      }
    // Frozen normals and contact points usually leave a hundredth of the residual. Where they leave
    // more than this part of it, they would take longer than a system that is not symmetric.
    constexpr double much = 0.3;
    has_been_slow         = has_been_slow || (last_residual > 0. && state.changes == 0 &&
                                      state.residual > much * last_residual);
    last_residual         = state.changes == 0 && state.prescribed ? state.residual : 0.;
  }
} // namespace Touchstone
