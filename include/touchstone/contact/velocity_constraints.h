// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_velocity_constraints_h
#define touchstone_contact_velocity_constraints_h

#include <touchstone/algebra/constraint_graph.h>

#include <cstddef>
#include <vector>

namespace Touchstone
{
  class Contact;

  /** @brief Velocity constraint of an active contact node: an impact without rebound. */
  struct VelocityConstraint
  {
    /** Of the node and what it touches, with the velocity that they should have,
     * length per time. */
    Condition condition;
    /** That they should have, length per time squared. */
    double acceleration;
    /** Of the obstacle, times the share of the row; length per time. */
    dealii::Tensor<1, dim> of_obstacle;
    /** Along the normal; otherwise along a tangent. */
    bool normal;
    /** ContactRow::index. */
    std::size_t row;
    /** The impulse that enforces it, force times time; subtracted from the momentum of the node
     * along Condition::force(). */
    double impulse = 0.;
    /** The force that enforces the acceleration, in the same way; the next step begins without it.
     */
    double excess_force = 0.;
  };

  /** @brief Velocity constraints of all nodes that are active at velocity level, at the end
   * @p time of a step of length @p step: along normals, and across them where nodes stick; those
   * implied by @p supports are omitted. */
  std::vector<VelocityConstraint>
  velocity_constraints(const Contact         &contact,
                       const ConstraintGraph &supports,
                       double                 time,
                       double                 step);
} // namespace Touchstone

#endif
