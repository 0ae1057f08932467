// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_line_and_face_h
#define touchstone_contact_pairing_line_and_face_h

#include <touchstone/contact/geometry/face_geometry.h>

#include <array>
#include <optional>

namespace Touchstone
{
  /** @brief Where a line meets a face. */
  struct LineOnFace
  {
    /** Coordinates on the face, outside of [-1, 1] if it is missed. */
    std::array<double, 2> xi{};
    /** Distance along the line, length; negative against its direction. */
    double along = 0.;
    /** Position and tangents there. */
    FacePoint point;
  };

  /**
   * @brief The point at which the line x + l n meets the surface over a face from outside
   * (doc/theory.md 3.4, equation (33)).
   *
   * A bilinear surface is met at two points at most, at one of them from outside: the solution is
   * unique and in closed form. On exact surfaces, smooth patches and faces of degree 2 it is the
   * start of Newton's method.
   * @param x A point of the line.
   * @param n Its direction, a unit vector: the outward normal of the other surface.
   * @return Nothing if the line does not meet the surface, or far from the face only.
   */
  std::optional<LineOnFace>
  meet_from_outside(const dealii::Point<dim>     &x,
                    const dealii::Tensor<1, dim> &n,
                    const FaceGeometry           &geometry);

  /** @brief How far @p xi lies beyond the edges of a face, as a fraction of the face: beyond edges
   * to other faces, and beyond those at which the whole surface ends. At most zero within. */
  struct BeyondEdges
  {
    double inner = 0., outer = 0.;

    BeyondEdges(const Face &face, const std::array<double, 2> &xi);
  };
} // namespace Touchstone

#endif
