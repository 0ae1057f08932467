#ifndef touchstone_drive_newton_h
#define touchstone_drive_newton_h

#include <touchstone/scene/solver_parameters.h>

#include <algorithm>
#include <cstdint>
#include <functional>

namespace Touchstone
{
  /** @brief How far a state is from a solution. */
  struct NewtonState
  {
    /** Out-of-balance force relative to the forces that act; no unit. */
    double residual = 0.;
    /** Residual that round-off alone can make; no unit. */
    double round_off = 0.;
    /** Largest violation of a gap relative to the faces, and whether prescribed
     * displacements are met; no unit. */
    double gap        = 0.;
    bool   prescribed = false;
    /** Active contact rows, rows that changed, and a number that identifies the
     * active set. */
    unsigned int  active    = 0;
    unsigned int  changes   = 0;
    std::uint64_t signature = 0;
  };

  /** @brief Whether the forces of a state are in balance. */
  inline bool
  balanced(const NewtonState &state, const NewtonParameters &parameters)
  {
    return state.residual <= std::max(parameters.residual_tolerance, state.round_off);
  }

  /** @brief All that the Newton method needs to know of a problem. */
  class NonlinearProblem
  {
  public:
    virtual ~NonlinearProblem() = default;

    /**
     * @brief Evaluate the present state and update the active set.
     * @param caution How reluctantly the active set changes: 0 to begin with,
     *                more each time that a set comes back.
     */
    virtual NewtonState
    residual(unsigned int caution) = 0;

    /** @brief Set up the linear system of the present state. */
    virtual void
    linearize() = 0;

    /** @brief Solve it. @return iterations, negative for a direct solver.
     * @throws NonConvergence */
    virtual int
    solve() = 0;

    /** @brief Go to the next state. */
    virtual void
    update() = 0;
  };

  /**
   * @brief Semismooth Newton method with active set.
   *
   * Converged when residual, gap and prescribed displacements are met and the
   * active set did not change; a residual that round-off holds within 100 times
   * its tolerance, for three iterations, counts as met.
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

    /** @return the number of linear solves.
     * @throws NewtonFailure, ActiveSetCycle, and what the problem throws. */
    unsigned int
    solve(NonlinearProblem &problem, const Observer &observer) const;

  private:
    const NewtonParameters &parameters;
  };
} // namespace Touchstone

#endif
