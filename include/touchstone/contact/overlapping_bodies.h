// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_overlapping_bodies_h
#define touchstone_contact_overlapping_bodies_h

#include <touchstone/contact/contact.h>
#include <touchstone/contact/tolerances.h>

#include <set>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief A point of the surface of a body in another body, or in the same. */
  struct BodyOverlap
  {
    /** Bodies of the point and of the cell that it lies in. */
    unsigned int body = 0, other = 0;
    /** Of the point in the other body, at least; length. */
    double             depth = 0.;
    dealii::Point<dim> x;

    /** @brief Bodies, place and depth in words. */
    std::string
    place(const Solid &solid) const;

    /** @brief The same with why that may be. */
    std::string
    text(const Solid &solid) const;
  };

  /**
   * @brief Bodies that reach into each other or into themselves, whether or not a contact pair
   * names them: for each two bodies the node or face centre of a surface that lies deepest in
   * a cell.
   *
   * A pair that a scene forgets, a side of a body that no pair names or a node that has passed
   * through a face in a single step would otherwise go unnoticed: rows know nothing of them. Points
   * count from a quarter of the thickness of a cell on, as coarse surfaces that touch overlap by
   * the height of arcs over their faces, see Tolerances::deep_in_body. Bodies whose overlap at the
   * start is adjusted or grows with time are left out, and the layer that pretension takes out of a
   * bolt.
   *
   * @param u Displacement, with ghosts.
   * @param bodies Those that are looked at.
   * @param least The depth from which on points count, by the thickness of the cell.
   * @return the same on all ranks and any number of them. Collective.
   */
  std::vector<BodyOverlap>
  overlapping_bodies(const Contact                &contact,
                     const Vector                 &u,
                     const std::set<unsigned int> &bodies,
                     double                        least = Tolerances::deep_in_body);

  /** @brief A point of the surface of a body. */
  struct PointOfBody
  {
    unsigned int body = 0;
    /** First degree of freedom of a node, else invalid_index. */
    Index              node = invalid_index;
    dealii::Point<dim> x;
  };

  /** @brief The same of a choice of points. @param points Of this rank. Collective. */
  std::vector<BodyOverlap>
  points_in_bodies(const Contact                &contact,
                   const Vector                 &u,
                   const std::set<unsigned int> &bodies,
                   std::vector<PointOfBody>      points,
                   double                        least);

  /** @brief The same of all bodies, in words; nodes on boundaries that no pair names
   * count from a twentieth of the thickness on, unless they were half as deep at the start.
   * Collective. */
  std::vector<std::string>
  overlapping_bodies(const Contact &contact, const Vector &u);
} // namespace Touchstone

#endif
