// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pressing_rows.h>
#include <touchstone/drive/carried_bodies.h>
#include <touchstone/drive/driven_bodies.h>
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
    /** By the size of a slave face: how far a guess may be off what holds the body. */
    constexpr double close = 0.01;

    using Motions = std::vector<std::optional<Tensor<1, dim>>>;



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
            result[b] = motion;
        }
      return result;
    }



    /** The motion of what a row faces, if it is known. @param motions Of the bodies. */
    std::optional<Tensor<1, dim>>
    motion_faced(const StepOfBodies &step, const ContactRow &row, const Motions &motions)
    {
      if (!row.on_obstacle())
        return motions[row.master_body];
      const RigidMotion obstacle = step.contact.pair(row).pairing().motion(step.time);
      return obstacle.since(row.motion, contact_point(row));
    }



    /** A direction in which something holds a body, and the motion in it that it asks for. */
    struct Hold
    {
      unsigned int   body;
      Tensor<1, dim> direction;
      /** Length. */
      double motion, size;
    };



    /** What holds bodies, and bodies of which it does not tell the motion. */
    struct Holds
    {
      std::vector<Hold> of_bodies;
      std::vector<int>  unknown;
    };



    void
    add_supports(const StepOfBodies &step, const Vector &u, Holds &holds)
    {
      for (const auto &support : step.conditions.prescribed_directions())
        if (step.unsupported.count(support.body) > 0)
          holds.of_bodies.push_back(
            {support.body, support.direction, missing_displacement(support, step.time, u), 0.});
    }



    void
    add_rows(const StepOfBodies &step, const Motions &motions, Holds &holds)
    {
      // All ranks ask for all of them, so that each finds the same formula without a value.
      for (unsigned int p = 0; p < step.contact.n_pairs(); ++p)
        step.contact.pair(p).pairing().motion(step.time);
      const PressingRows pressing(step.contact);
      for (const ContactRow &row : step.contact.rows())
        {
          if (!row.tied && !pressing.contain(row))
            continue;
          const bool slave  = step.unsupported.count(row.body) > 0,
                     master = !row.on_obstacle() && step.unsupported.count(row.master_body) > 0;
          if (!slave && !master)
            continue;
          const unsigned int                  body = slave ? row.body : row.master_body;
          const std::optional<Tensor<1, dim>> motion =
            slave ? motion_faced(step, row, motions) : motions[row.body];
          if ((slave && master) || !motion)
            {
              holds.unknown[body] = 1;
              if (slave && master)
                holds.unknown[row.master_body] = 1;
            }
          else if (step.contact.state(row).status == ContactStatus::slip)
            holds.of_bodies.push_back({body, row.normal, row.normal * *motion, row.size});
          else
            for (unsigned int d = 0; d < dim; ++d)
              {
                Tensor<1, dim> axis;
                axis[d] = 1.;
                holds.of_bodies.push_back({body, axis, (*motion)[d], row.size});
              }
        }
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
            if ((faced - *motions[row.body]) * row.normal > std::max(row.gap, 0.) + row.size)
              {
                stay[row.body] = 1;
                if (!row.on_obstacle())
                  stay[row.master_body] = 1;
              }
          }
      Utilities::MPI::max(stay, step.solid.communicator, stay);
    }
  } // namespace



  bool
  carry_bodies(const StepOfBodies &step, Vector &u)
  {
    if (step.unsupported.empty())
      return false;
    const unsigned int n       = step.solid.n_bodies();
    Motions            motions = guessed_motions(step, u);
    Holds              holds;
    holds.unknown.resize(n);
    add_rows(step, motions, holds);
    add_supports(step, u, holds);
    Translations translations(n);
    for (const Hold &hold : holds.of_bodies)
      translations.add(hold.body, hold.direction, hold.motion);
    translations.complete(step.solid.communicator);
    std::vector<Tensor<1, dim>> closest(n);
    for (const unsigned int body : step.unsupported)
      closest[body] = translations.closest(body);
    std::vector<int> stay = holds.unknown;
    for (const Hold &hold : holds.of_bodies)
      if (std::abs(hold.motion - hold.direction * closest[hold.body]) >
          std::max(close * hold.size, close * closest[hold.body].norm()))
        stay[hold.body] = 1;
    Utilities::MPI::max(stay, step.solid.communicator, stay);
    for (const unsigned int body : step.unsupported)
      {
        // Bodies that have a guess keep it.
        if (!motions[body] || motions[body]->norm() > 0. || closest[body].norm() == 0.)
          stay[body] = 1;
        if (stay[body] == 0)
          motions[body] = closest[body];
      }
    leave_too_deep(step, motions, stay);
    bool moved = false;
    for (unsigned int body = 0; body < n; ++body)
      if (step.unsupported.count(body) > 0 && stay[body] == 0)
        moved = true;
      else
        closest[body] = 0.;
    translate_bodies(step.solid, closest, u);
    return moved;
  }
} // namespace Touchstone
