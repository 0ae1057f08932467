// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_contact_checks_h
#define touchstone_contact_contact_checks_h

#include <touchstone/algebra/vector.h>

#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  class Contact;
  class ContactPair;

  /** @brief Normal forces of a pair on its slave nodes where they press, with the ghosts of the
   * surfaces. Collective. */
  Vector
  normal_forces(const Contact &contact, const ContactPair &pair);

  /** @brief Text on gaps and overlaps as the bodies are placed, a line per pair. Collective. */
  std::vector<std::string>
  start_report(const Contact &contact);

  /** @brief Tied pairs whose rows hand a uniform traction on to interior nodes of the master in
   * other parts than their areas, as pointwise rows of meshes that do not match do (doc/theory.md
   * 3), and those across gaps that are wider than the cells behind them (4.6): a sentence for each.
   * Collective. */
  std::vector<std::string>
  doubtful_ties(const Contact &contact);

  /** @brief Contact in the state of the last update that rows of slave nodes and master faces
   * cannot describe, in words; empty if there is none. Collective. */
  std::string
  unresolved_contact(const Contact &contact);

  /** @brief The part of unresolved_contact() that overlaps show: edges that have passed through
   * each other, vertices within slave faces. Collective. */
  std::string
  unresolved_overlap(const Contact &contact);

  /** @brief What passes between the slave nodes of a pair. */
  struct MissedByRows
  {
    /** Pair, place and remedy. */
    std::string text;
    /** By more than the height of arcs over coarse faces, which rows make good once they touch. */
    bool deep = false;
    /** Area of the faces on which it was missed, by that and the area which carries a force; 1 if
     * nothing does. */
    double share = 0.;

    /** @brief For checkpoints. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &text &deep &share;
    }
  };

  /** @brief What rows have missed, by the names of the pairs, see MissedContact. Collective. */
  std::map<std::string, MissedByRows>
  missed_contact(const Contact &contact);

  /** @brief Penetration that springs have left in a pair. */
  struct LeftPenetration
  {
    /** The largest, length, and by the size of the slave faces, no unit. */
    double length = 0., relative = 0.;
    /** Energy of the springs, force times length. */
    double energy = 0.;
  };

  /** @brief What springs have left, by the names of the pairs; pairs that are closed as far as
   * tolerances go are left out. Collective. */
  std::map<std::string, LeftPenetration>
  left_penetration(const Contact &contact);

  /** @brief Whether a pair has a contact force that is far from normal to the slave surface, the
   * other part of unresolved_contact(). Collective. */
  bool
  has_oblique_force(const Contact &contact, const ContactPair &pair);
} // namespace Touchstone

#endif
