// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_row_geometry_h
#define touchstone_explicit_row_geometry_h

#include <touchstone/contact/row.h>
#include <touchstone/explicit/impulse_solver.h>

namespace Touchstone
{
  /**
   * @brief The gap that a row may have at the end of a cycle, zero or negative, from that at its
   * start; length (doc/explicit.md, section 9.1).
   * @param gap     At the start. @param closing By how much the sides came together in the cycle
   *                before, along the present normal, in a time as long as this cycle.
   * @param size    Of the faces.
   */
  double
  allowed_gap(double gap, double closing, double size);

  /** @brief The weight that the slave node has at the point of the slave side that the row is for.
   * A row between nodes is divided by it, while impulses act on the point: by this gaps, weights
   * and nodal forces are less, and areas more, than those of the row. */
  inline double
  weight_of_slave(const ContactRow &row)
  {
    return row.between_nodes ? 1. / row.share : 1.;
  }

  /**
   * @brief Set the lever of a row, which keeps the moment of momentum where its force does not act
   * along the line between its sides (doc/explicit.md, section 9.1).
   * @param x      Position by node of the solver, length.
   * @param normal The direction in which the force acts without friction.
   * @param size   Of the faces, length.
   */
  void
  set_lever(ImpulseSolver                             &solver,
            ImpulseRow                                &row,
            const std::vector<dealii::Tensor<1, dim>> &x,
            const dealii::Tensor<1, dim>              &normal,
            double                                     size);
} // namespace Touchstone

#endif
