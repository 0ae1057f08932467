// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_moving_faces_h
#define touchstone_explicit_general_moving_faces_h

#include <touchstone/explicit/general/moving_points.h>

namespace Touchstone
{
  /** @brief The four corners of a face on straight paths, coordinates of all four one behind the
   * other, so that processors work on them at once. */
  struct MovingCorners
  {
    /** By axis and corner, length. */
    std::array<std::array<double, 4>, dim> from{}, to{};
    /** In what directions that turn with the face are said. */
    TurningFrame frame;
    /** The largest size at a corner, length. */
    double size = 0.;

    void
    set(const std::array<dealii::Point<dim>, 4> &from,
        const std::array<dealii::Point<dim>, 4> &to,
        double                                   size);

    dealii::Point<dim>
    corner(unsigned int a, bool at_end) const;
  };



  /** @brief Two faces, with what stay_apart() of general contact asks of groups of points. */
  struct TwoFaces
  {
    const MovingCorners &one, &other;

    /** @brief As distance_in_front() of groups of points: of @p one in front of @p other. */
    double
    distance_in_front(const TurningDirection &direction, double margin) const;
    /** @brief As shortest_difference(). */
    dealii::Tensor<1, dim>
    shortest_difference(bool at_end) const;
  };



  /** @brief The same of a node and a face. */
  struct NodeAndFace
  {
    dealii::Point<dim>   from, to;
    const MovingCorners &face;

    double
    distance_in_front(const TurningDirection &direction, double margin) const;
    dealii::Tensor<1, dim>
    shortest_difference(bool at_end) const;

    /**
     * @brief Which of the four triangles around the middle of the face the node may come through,
     * by bits: those that it stays on one side of, by their normal, or beyond an edge of, by the
     * normal of that edge in the plane, it does not. Directions turn with the triangle, as in
     * distance_in_front(); and @p margin is that.
     */
    unsigned int
    triangles_in_reach(const dealii::Point<dim> &middle_from,
                       const dealii::Point<dim> &middle_to,
                       double                    margin) const;
  };
} // namespace Touchstone

#endif
