// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_entered_faces_h
#define touchstone_contact_entered_faces_h

#include <touchstone/algebra/vector.h>
#include <touchstone/contact/geometry/surface.h>

#include <functional>
#include <vector>

namespace Touchstone
{
  /** @brief A point that lies behind a face. */
  struct PointBehindFace
  {
    dealii::Point<dim> x;
    /** Unit outward normal of the face there. */
    dealii::Tensor<1, dim> normal;
    /** Length. */
    double depth;
  };

  /**
   * @brief Of points that lie within a body those that have come through the face which they were
   * found behind. One that lies close to another face, across the first, has come through that: the
   * side of a block that stands a little within another one is deep behind the far sides of this
   * one (doc/theory.md 4.1). Collective.
   *
   * @param points  Of this rank.
   * @param surface Of the body that they lie within; all of its faces are looked at, also of other
   *                ranks.
   * @param u       Displacement with ghosts.
   * @param carries Whether a face of the surface carries a force: what has come through it is
   * resisted.
   * @return One entry for each of the points.
   */
  std::vector<bool>
  have_come_through(const std::vector<PointBehindFace>      &points,
                    const Surface                           &surface,
                    const Vector                            &u,
                    const std::function<bool(const Face &)> &carries,
                    MPI_Comm                                 communicator);
} // namespace Touchstone

#endif
