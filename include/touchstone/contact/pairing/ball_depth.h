// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_ball_depth_h
#define touchstone_contact_pairing_ball_depth_h

#include <touchstone/contact/pairing/balls_in_cell.h>
#include <touchstone/solid/solid.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief How much closer to its face the centre of a ball has come (doc/theory.md 3.5).
   *
   * Balls keep their size while cells are pressed flat. Cells may belong to any rank.
   */
  class BallDepth
  {
  public:
    /** @param solid Must live as long. */
    BallDepth(const Solid &solid, const BallsInCell &balls);

    /** @brief Get the positions of the nodes of the cells behind some faces. Collective.
     * @param u With ghosts. @param faces Those of cells that are neither owned nor ghosts here. */
    void
    update(const Vector &u, const std::vector<const Face *> &faces);

    /** @brief The distance of the centre of a ball from its face, less that in the reference state;
     * length. */
    double
    change(const Face &face, const unsigned int ball) const
    {
      return depth(face, ball, true) - depth(face, ball, false);
    }

  private:
    const Solid       &solid;
    const BallsInCell &balls;
    /** Reference coordinates by owned dof; and displacements and these with the dofs needed. */
    Vector coordinates, known_coordinates, known_displacement;

    double
    depth(const Face &face, unsigned int ball, bool present) const;
  };
} // namespace Touchstone

#endif
