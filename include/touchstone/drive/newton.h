// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_newton_h
#define touchstone_drive_newton_h

#include <touchstone/drive/newton_parameters.h>

#include <algorithm>
#include <cstdint>
#include <functional>

namespace Touchstone
{
  /** @brief Measures by which the convergence of a state is judged, doc/theory.md 5, equation
   * (13). */
  struct NewtonState
  {
    /** Out-of-balance force relative to the forces that act; no unit. */
    double residual = 0.;
    /** Norm of the out-of-balance force; the line search compares it, because far from a solution
     * the scale of the relative residual grows with it. */
    double force = 0.;
    /** Residual that round-off alone can cause: a smaller one cannot be expected; no unit. */
    double round_off = 0.;
    /** Largest violation of a gap relative to the faces, and whether prescribed
     * displacements are met; no unit. */
    double gap        = 0.;
    bool   prescribed = false;
    /** Active contact rows, rows that changed, whether they were judged, and a number that
     * identifies the active set. */
    unsigned int  active    = 0;
    unsigned int  changes   = 0;
    bool          judged    = true;
    std::uint64_t signature = 0;
    /** Active rows that touch another face, edge or vertex of the master than in the iteration
     * before, or none any more: in the last of a few iterations in which there were any. */
    unsigned int exchanges = 0;
    /** Part of the last increment that was taken; no unit. */
    double fraction = 1.;
  };

  /** @brief Whether the forces of a state are in balance. */
  inline bool
  balanced(const NewtonState &state, const NewtonParameters &parameters)
  {
    return state.residual <= std::max(parameters.residual_tolerance, state.round_off);
  }

  /** @brief What NewtonState::exchanges says, to be appended to a message; empty without any. */
  std::string
  exchanges_in_words(const NewtonState &state);

  /** @brief Interface of a problem to Newton's method. */
  class NonlinearProblem
  {
  public:
    virtual ~NonlinearProblem() = default;

    /**
     * @brief Evaluate the present state and update the active set.
     * @param damping Damping level of the active set: 0 at first, increased each time that a
     *                set recurs, see Enforcement::update_active_set().
     */
    virtual NewtonState
    residual(unsigned int damping) = 0;

    /** @brief Set up the linear system of the present state. */
    virtual void
    linearize() = 0;

    /** @brief Solve it. @return iterations, negative for a direct solver.
     * @throws NonConvergence */
    virtual int
    solve() = 0;

    /** @brief Apply the increment: displacements and contact forces of the next state. */
    virtual void
    update() = 0;

    /** @brief Apply the fraction @p fraction of the last increment, of displacements and of contact
     * forces, instead of the fraction that is applied at present; 1 is the full increment. The
     * active set is again that of the last linear system. */
    virtual void
    shorten(double fraction) = 0;
  };

  /**
   * @brief Semismooth Newton method with active set.
   *
   * Converged when residual, gap and prescribed displacements are met and the
   * active set did not change; a residual that round-off holds within 100 times
   * its tolerance, for three iterations, counts as met.
   *
   * Line search: the next residual tells whether an increment was good, so that none
   * is evaluated for that purpose alone. If the out-of-balance force is more than twice the
   * highest of the two before, and no row or support has moved it, the increment is
   * halved, up to four times. If none of the fractions helps, not the length of the increment is
   * wrong but its direction; then full increments are taken for the rest of the step.
   * Grippo, Lampariello and Lucidi (1986), SIAM J. Numer. Anal. 23.
   * Hueeber and Wohlmuth (2005), Comput. Methods Appl. Mech. Engng 194.
   */
  class Newton
  {
  public:
    using Observer = std::function<void(unsigned int iteration, const NewtonState &, int linear)>;

    explicit Newton(const NewtonParameters &parameters)
      : parameters(parameters)
    {
    }

    /** @param least Make at least so many linear solves.
     * @return the number of linear solves.
     * @throws NewtonFailure, ActiveSetCycle, and what the problem throws. */
    unsigned int
    solve(NonlinearProblem &problem, const Observer &observer, unsigned int least = 0) const;

  private:
    const NewtonParameters &parameters;
  };
} // namespace Touchstone

#endif
