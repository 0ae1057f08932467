// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/carried_bodies.h>
#include <touchstone/drive/translations.h>
#include <touchstone/solid/bodies.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

// First guesses of steps for bodies that contact alone holds (doc/theory.md 5).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** By the size of a slave face: how far a translation may be off what holds the body. */
    constexpr double close = 0.01;

    /** By the motions that the holds ask for, in the mean of squares: how far one with a rotation
     * may be off. Faces of a ball that rolls lift off and touch. A block between plates that shear
     * it is off by 0.4, a column twice as high as wide by 0.24. */
    constexpr double near = 0.2;

    /** Guesses turn bodies by no more; radians. */
    constexpr double most = 0.8;



    /** The motion that a guess gives each body, if it is a translation. Collective. */
    Motions
    guessed_motions(const StepOfBodies &step, const Vector &u)
    {
      constexpr double   round_off = 1e-10, none = std::numeric_limits<double>::lowest();
      const unsigned int n                 = step.solid.n_bodies();
      const std::vector<unsigned int> body = bodies_of_unknowns(step.solid);
      // The largest of each component and of its negative, and of the displacement itself.
      std::vector<double> largest(3 * dim * n, none);
      for (std::size_t k = 0; k < body.size(); ++k)
        {
          const unsigned int d       = step.solid.owned.nth_index_in_set(k) % dim;
          const double       change  = u.begin()[k] - step.committed_u.begin()[k];
          double *const      of_body = &largest[3 * (dim * body[k] + d)];
          of_body[0]                 = std::max(of_body[0], change);
          of_body[1]                 = std::max(of_body[1], -change);
          of_body[2]                 = std::max(of_body[2], std::abs(u.begin()[k]));
        }
      Utilities::MPI::max(largest, step.solid.communicator, largest);
      Motions result(n);
      for (unsigned int b = 0; b < n; ++b)
        {
          Tensor<1, dim> motion;
          bool           translates = true;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double *const of_body = &largest[3 * (dim * b + d)];
              motion[d]                   = of_body[0];
              translates = translates && of_body[0] + of_body[1] <= round_off * of_body[2];
            }
          if (translates)
            result[b] = BodyMotion{motion, {}, {}};
        }
      return result;
    }



    /** Which rows would be closed by more than a slave face: of the bodies that move. Collective.
     */
    void
    leave_too_deep(const StepOfBodies &step, const Motions &motions, std::vector<int> &stay)
    {
      for (const ContactRow &row : step.contact.rows())
        if (row.has_partner && motions[row.body])
          {
            const Tensor<1, dim> faced =
              motion_faced(step, row, motions).value_or(Tensor<1, dim>());
            if ((faced - motions[row.body]->at(contact_point(row))) * row.normal >
                std::max(row.gap, 0.) + row.size)
              {
                stay[row.body] = 1;
                if (!row.on_obstacle())
                  stay[row.master_body] = 1;
              }
          }
      Utilities::MPI::max(stay, step.solid.communicator, stay);
    }



    /** The translation of each body that misses no hold. Collective. */
    Motions
    translations_to(const std::vector<Hold> &holds, const StepOfBodies &step)
    {
      const unsigned int n = step.solid.n_bodies();
      Translations       translations(n);
      for (const Hold &hold : holds)
        translations.add(hold.body, hold.direction, hold.motion);
      translations.complete(step.solid.communicator);
      std::vector<BodyMotion> closest(n);
      for (const unsigned int body : step.unsupported)
        closest[body].shift = translations.closest(body);
      std::vector<int> off(n);
      for (const Hold &hold : holds)
        if (const BodyMotion &motion = closest[hold.body];
            std::abs(hold.miss(motion)) > close * std::max(hold.size, motion.shift.norm()))
          off[hold.body] = 1;
      Utilities::MPI::max(off, step.solid.communicator, off);
      Motions result(n);
      for (const unsigned int body : step.unsupported)
        if (off[body] == 0)
          result[body] = closest[body];
      return result;
    }



    /** The rigid motion of each body that is near what its holds ask for. Collective. */
    Motions
    rolls_to(const std::vector<Hold> &holds, const StepOfBodies &step)
    {
      const unsigned int n       = step.solid.n_bodies();
      const auto         closest = closest_rigid_motions(holds, n, step.solid.communicator);
      // Of each body the sums of squares of what holds ask for, and of what is missed; and whether
      // a support is.
      std::vector<double> asked(n), missed(n);
      std::vector<int>    off(n);
      for (const Hold &hold : holds)
        {
          const double miss = hold.miss(closest[hold.body]);
          asked[hold.body] += hold.motion * hold.motion;
          missed[hold.body] += miss * miss;
          if (hold.size == 0. && std::abs(miss) > close * closest[hold.body].shift.norm())
            off[hold.body] = 1;
        }
      for (std::vector<double> *sums : {&asked, &missed})
        Utilities::MPI::sum(*sums, step.solid.communicator, *sums);
      Utilities::MPI::max(off, step.solid.communicator, off);
      Motions result(n);
      for (const unsigned int body : step.unsupported)
        if (off[body] == 0 && closest[body].turn.norm() <= most &&
            missed[body] <= near * near * asked[body])
          result[body] = closest[body];
      return result;
    }
  } // namespace



  bool
  carry_bodies(const StepOfBodies &step, Vector &u)
  {
    if (step.unsupported.empty())
      return false;
    const unsigned int n       = step.solid.n_bodies();
    Motions            motions = guessed_motions(step, u);
    const Holds        holds   = holds_of_bodies(step, u, motions);
    std::vector<int>   stay    = holds.unknown;
    Utilities::MPI::max(stay, step.solid.communicator, stay);
    const Motions translated = translations_to(holds.of_bodies, step),
                  rolled     = rolls_to(holds.of_bodies, step);
    for (const unsigned int body : step.unsupported)
      {
        const std::optional<BodyMotion> &motion =
          translated[body] ? translated[body] : rolled[body];
        // Bodies that have a guess keep it.
        if (!motions[body] || motions[body]->shift.norm() > 0. || !motion || motion->rests())
          stay[body] = 1;
        if (stay[body] == 0)
          motions[body] = motion;
      }
    leave_too_deep(step, motions, stay);
    bool moved = false;
    for (unsigned int body = 0; body < n; ++body)
      if (step.unsupported.count(body) > 0 && stay[body] == 0)
        moved = true;
      else
        motions[body].reset();
    if (moved)
      move_bodies(step.solid, motions, step.committed_u, u);
    return moved;
  }
} // namespace Touchstone
