// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_forcing_term_h
#define touchstone_drive_forcing_term_h

#include <touchstone/drive/newton.h>

namespace Touchstone
{
  /**
   * @brief The relative residual to which the linear system of a Newton iteration is solved
   * (inexact Newton): accurate enough, but no more than the next iteration can make use of.
   *
   * Eisenstat and Walker (1996), SIAM J. Sci. Comput. 17, the first of their choices.
   */
  class ForcingTerm
  {
  public:
    /** @param usual              Relative residual of a linear solve that nothing else requires.
     * @param residual_tolerance Of Newton's method.
     * @param friction           Stick and slip have to be distinguished, which needs more
     *                           accuracy. */
    ForcingTerm(double usual, double residual_tolerance, bool friction);

    void
    begin_step();

    /** @brief The attempt at the present step is taken back. If its increments gained little, those
     * of the next attempts are not frozen from the start: a state far off is hard to come back
     * from. */
    void
    end_attempt()
    {
      slow_before = has_been_slow;
    }

    /** @brief The present attempt has become slow, so that the next one begins in another way. */
    bool
    next_attempt_differs() const
    {
      return has_been_slow && !slow_before;
    }

    /** @brief The step is made: the next one has another difficulty, if any. */
    void
    end_step()
    {
      slow_before = false;
    }

    /** @brief A state has been evaluated.
     * @param leaves_out The linear system neglects part of the tangent, as symmetric ones do. */
    void
    update(const NewtonState &state, bool leaves_out);

    /** @brief Relative residual that the next linear solve needs. */
    double
    tolerance() const
    {
      return next;
    }

    /** @brief In this step, or in an attempt at it that has failed, an increment with an unchanged
     * active set has reduced the residual too little: frozen normals and contact points neglect too
     * much. */
    bool
    slow() const
    {
      return has_been_slow;
    }

  private:
    const double usual, residual_tolerance;
    const bool   friction;
    double       next = 1e-3;
    /** Residual before the last increment, if nothing but the residual was left to be met; else
     * zero. */
    double last_residual = 0.;
    bool   has_been_slow = false, slow_before = false;
  };
} // namespace Touchstone

#endif
