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



  // Residuals of another step say nothing about this one, and slow convergence may be over.
  void
  ForcingTerm::begin_step()
  {
    last_residual = 0.;
    has_been_slow = slow_before;
  }



  void
  ForcingTerm::update(const NewtonState &state, const bool leaves_out)
  {
    // A linear solve that is much more accurate than Newton's method needs is wasted. Two kinds
    // of solve need more: if supports move, the right-hand side is much larger than the forces
    // that result; and if the active set changes, an error in the sign of a contact force costs
    // further iterations. They get two more digits, and three with friction, where stick and slip
    // are distinguished by small differences. A solve that may be the last one of the step is made
    // accurate enough to be it, with up to two more digits than usual.
    const double last = 0.03 * residual_tolerance / state.residual;
    next              = usual;
    if (!state.prescribed || state.changes > 0)
      next *= friction ? 1e-3 : 1e-2;
    else
      {
        // Symmetric systems neglect how normals change, so that Newton's method converges linearly
        // and accuracy beyond its contraction rate is wasted (Eisenstat and Walker 1996). The
        // factor 0.03 leaves a margin: with a tenth, an additional solve is needed now and then.
        double left = 0.;
        if (last_residual > 0. && leaves_out)
          left = 0.03 * state.residual / last_residual;
        if (state.residual > 0. && last >= 1e-2 * usual)
          next = std::min(last, std::max(usual, 0.1));
        next = std::max(next, std::min(left, 1e-2));
      }
    // Frozen normals and contact points usually reduce the residual to about a hundredth per
    // iteration. Where more than this part of it is left, the unsymmetric consistent system is
    // faster, see slow().
    constexpr double much = 0.3;
    has_been_slow         = has_been_slow || (last_residual > 0. && state.changes == 0 &&
                                      state.residual > much * last_residual);
    last_residual         = state.changes == 0 && state.prescribed ? state.residual : 0.;
  }
} // namespace Touchstone
