// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_balls_in_cell_h
#define touchstone_contact_pairing_balls_in_cell_h

#include <touchstone/contact/geometry/face.h>

#include <array>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The balls that stand for the cell behind a face of degree 1 (doc/theory.md 3.5): one in
   * the middle of the cell, or those at the face after some splittings, each into 2 x 2 x 2.
   */
  class BallsInCell
  {
  public:
    /** Nodes of a cell: those of the face, and of Face::behind. */
    static constexpr unsigned int n_nodes = 8;

    explicit BallsInCell(unsigned int splittings);

    unsigned int
    size() const
    {
      return centres.size();
    }

    /** @brief Coordinates of the point of the face above the centre of a ball. */
    const std::array<double, 2> &
    above(const unsigned int ball) const
    {
      return centres[ball];
    }

    /** @brief The trilinear shape function of a node of the cell at the centre of a ball. */
    double
    weight(const unsigned int ball, const unsigned int node) const
    {
      return weights[ball][node];
    }

    /** @brief The ball below a point of the face; beyond an edge the one closest to it. */
    unsigned int
    below(const std::array<double, 2> &xi) const;

    /** @brief The node of the face that is closest to a ball, of equal ones the first. */
    unsigned int
    closest_node(const unsigned int ball) const
    {
      return (centres[ball][0] > 0. ? 1 : 0) + (centres[ball][1] > 0. ? 2 : 0);
    }

  private:
    /** Along an edge. */
    unsigned int                             n;
    std::vector<std::array<double, 2>>       centres;
    std::vector<std::array<double, n_nodes>> weights;
  };
} // namespace Touchstone

#endif
