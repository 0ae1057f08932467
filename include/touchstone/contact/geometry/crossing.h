// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_crossing_h
#define touchstone_contact_geometry_crossing_h

#include <touchstone/contact/geometry/face.h>

#include <optional>

namespace Touchstone
{
  /** @brief A node passes through a face within a step. */
  struct Crossing
  {
    /** When, as a fraction of the step. */
    double time;
    /** To the inside, or back out. */
    bool inward;
  };

  /**
   * @brief Whether and when a node passes through a face.
   *
   * The node moves on a straight line from @p start to @p end while the nodes of the
   * face move from their committed to their present displacements: three equations
   * for the position on the face and the time, by Newton's method. A node that touches
   * the face at the start, up to 1e-6 of its size, has not yet passed.
   * Benson and Hallquist (1990), Comput. Methods Appl. Mech. Engng 78, and the
   * dynamic local search of contact-impact programs.
   */
  std::optional<Crossing>
  crossing(const dealii::Point<dim> &start,
           const dealii::Point<dim> &end,
           const Face               &face,
           const AnalyticSurface    *exact);
} // namespace Touchstone

#endif
