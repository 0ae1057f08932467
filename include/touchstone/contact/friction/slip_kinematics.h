// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_friction_slip_kinematics_h
#define touchstone_contact_friction_slip_kinematics_h

#include <touchstone/algebra/vector.h>
#include <touchstone/contact/friction/friction.h>
#include <touchstone/contact/row.h>

namespace Touchstone
{
  /** @brief Positions of nodes, now and when the step began, with the ghosts that rows refer
   * to. Reference positions and displacements are apart: slip is a difference of displacements,
   * which would have the round-off of positions, large where a scene lies far from the origin. */
  struct NodePositions
  {
    /** Reference positions, and displacements now and when the step began. */
    Vector reference, present, start;

    /** @brief Present position. */
    dealii::Tensor<1, dim>
    at(Index node) const;

    /** @brief Displacement since the step began. */
    dealii::Tensor<1, dim>
    displacement(Index node) const;

    /** @brief Present position of @p node relative to that of @p other. */
    dealii::Tensor<1, dim>
    between(Index other, Index node) const;
  };

  /** @brief Displacement v of the slave node relative to its convected contact point, with its
   * normal component, length; doc/theory.md 6.2, equation (18). */
  dealii::Tensor<1, dim>
  displacement_since_anchor(const ContactRow      &row,
                            const FrictionHistory &history,
                            const NodePositions   &positions);

  /** @brief Two material vectors of the slave surface where the row is. */
  const std::array<Stencil, 2> &
  material_tangents(const ContactRow &row);

  /** @brief ContactRow::share of a point inside a slave face, which the slip of its row is times
   * that of the point, and the force a part of that of the point; 1 of other rows. */
  inline double
  share_of_point(const ContactRow &row)
  {
    return row.tangents ? row.share : 1.;
  }

  /** @brief Slip and frame of a row with a partner, doc/theory.md 6.2: a function of the
   * history and of present positions alone. @param step Length of the step in time. */
  SlipKinematics
  slip_kinematics(const ContactRow &row, const NodePositions &positions, double time, double step);

  /** @brief Set the gradients of slip and frame of a row with a derivative. */
  void
  differentiate_slip(const ContactRow    &row,
                     const NodePositions &positions,
                     SlipKinematics      &kinematics);

  /** @brief Let slip count from the present contact point, doc/theory.md 6.2. */
  void
  set_anchor(const ContactRow     &row,
             const SlipKinematics &kinematics,
             const NodePositions  &positions,
             FrictionHistory      &history);
} // namespace Touchstone

#endif
