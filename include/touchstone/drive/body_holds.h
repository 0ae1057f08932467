// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_body_holds_h
#define touchstone_drive_body_holds_h

#include <touchstone/contact/contact.h>
#include <touchstone/drive/body_motion.h>
#include <touchstone/solid/boundary_conditions.h>

#include <optional>
#include <set>
#include <vector>

namespace Touchstone
{
  /** @brief What carry_bodies() has to know of a step. */
  struct StepOfBodies
  {
    const BoundaryConditions &conditions;
    /** At the start of the step. */
    const Contact &contact;
    const Solid   &solid;
    /** Those that supports alone leave a motion. */
    const std::set<unsigned int> &unsupported;
    /** Displacement at the start of the step, owned dofs. */
    const Vector &committed_u;
    /** At its end. */
    double time;
  };

  /** @brief The motion of what a row faces, if it is known; length. @param motions Of the bodies.
   */
  std::optional<dealii::Tensor<1, dim>>
  motion_faced(const StepOfBodies &step, const ContactRow &row, const Motions &motions);

  /** @brief A direction in which something holds a body at a point, and the motion in it that it
   * asks for. */
  struct Hold
  {
    unsigned int           body;
    dealii::Point<dim>     position;
    dealii::Tensor<1, dim> direction;
    double                 motion; // length
    /** Of the slave face; length. Zero for supports. */
    double size;

    /** @brief By what a motion of the body misses it; length. The rotation counts by the velocity
     * that it begins with. */
    double
    miss(const BodyMotion &of_body) const
    {
      return motion - direction *
                        (of_body.shift + cross_product_3d(of_body.turn, position - of_body.centre));
    }
  };

  /** @brief What holds the bodies that supports leave a motion, of this rank. */
  struct Holds
  {
    std::vector<Hold> of_bodies;
    /** By body: 1 where something holds it of which the motion is not known. */
    std::vector<int> unknown;
  };

  /** @brief The holds of a step: rows that press or are tied, and supports. Collective.
   * @param u Guess for the displacement, in which driven bodies have moved by @p motions. */
  Holds
  holds_of_bodies(const StepOfBodies &step, const Vector &u, const Motions &motions);

  /** @brief The rigid motion of each body of least length that comes closest to what holds it;
   * rotations count in mean distances of the holds from their centre. Collective. */
  std::vector<BodyMotion>
  closest_rigid_motions(const std::vector<Hold> &holds,
                        unsigned int             n_bodies,
                        MPI_Comm                 communicator);
} // namespace Touchstone

#endif
