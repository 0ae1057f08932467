// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/motion_in_modes.h>
#include <touchstone/drive/step_problem.h>

#include <limits>

// Bodies that stand on one or two nodes can turn about the line through them, and what has no
// friction can slide: all these states are balanced, or nearly so, and round-off or facets would
// choose one of them. The least motion of a static step is taken (doc/theory.md 9).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** What springs may carry of the forces that act: without a word, as a sum over the nodes,
     * without being made softer, and at all, both as norms. */
    constexpr double without_a_word = 2e-7, round_off = 1e-6, little = 1e-4;
  } // namespace



  unsigned int
  StepProblem::solve_with_springs(const Newton           &newton,
                                  const Newton::Observer &observer,
                                  const unsigned int      least)
  {
    springs.detach();
    if (!integration->dynamic() && !without_springs && !system->unsupported_bodies().empty())
      springs.attach(solid, committed_u);
    unsigned int n = newton.solve(*this, observer, least);
    // Where the force along a motion stays what it is, the next softer springs let the body move
    // ten times as far. Beyond a twentieth of a cell it would come to where facets make another
    // force.
    constexpr double near = 0.05 / 10.;
    while (springs.act() && spring_share > round_off &&
           springs.resisted_motion(u).linfty_norm() < near * system->smallest_cell())
      {
        springs.soften();
        n += newton.solve(*this, observer, /*least=*/1);
      }
    // What pushes a body so much are no facets: it has to go where that takes it.
    if (springs.act() && spring_share > little)
      {
        springs.detach();
        n += newton.solve(*this, observer, /*least=*/1);
      }
    return n;
  }



  std::vector<std::string>
  StepProblem::check_springs() const
  {
    std::vector<std::string> result;
    if (springs.act() && carried_by_springs > without_a_word)
      for (const unsigned int body : springs.bodies())
        result.push_back(
          "next to nothing resists that body '" + scene.bodies[body].name +
          "' moves along what it touches: springs hold it, which carry up to 1e-4 of "
          "the forces; add friction, a support or springs of its own");
    return result;
  }



  unsigned int
  StepProblem::take_out_free_motion(const Newton &newton, const Newton::Observer &observer)
  {
    if (integration->dynamic())
      return 0;
    constexpr unsigned int most_rounds = 5;
    unsigned int           n           = 0;
    double                 before      = std::numeric_limits<double>::max();
    for (unsigned int round = 0; round < most_rounds; ++round)
      {
        const FreeMotion free = system->undetermined_motion();
        if (free.n_modes == 0)
          break;
        auto parts = motion_in_modes(solid, free, committed_u, u);
        parts *= -1.;
        // What does not get less is determined after all, by what changes with the motion.
        const double size = parts.l2_norm();
        if (size <= scene.newton.gap_tolerance * system->smallest_cell() || size > 0.5 * before)
          break;
        before = size;
        const Vector balanced(u);
        move_bodies(solid, motions_by_modes(solid, free, parts), balanced, u);
        try
          {
            n += newton.solve(*this, observer, /*least=*/1);
          }
        catch (const NonConvergence &)
          {
            // No state next to the start of the step: the one that has been found is as good.
            u = balanced;
            contact.begin_again(committed_u, committed_time);
            return n + newton.solve(*this, observer, /*least=*/1);
          }
      }
    return n;
  }
} // namespace Touchstone
