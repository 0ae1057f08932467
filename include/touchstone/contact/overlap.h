#ifndef touchstone_contact_overlap_h
#define touchstone_contact_overlap_h

#include <touchstone/contact/face.h>

#include <array>
#include <vector>

namespace Touchstone
{
  /** @brief A quadrature point on the part of a slave face that a master face
   * covers. */
  struct OverlapPoint
  {
    /** Coordinates on the slave and on the master face. */
    std::array<double, 2> slave, master;
    /** Weight: area of the slave face. */
    double weight;
  };

  /**
   * @brief Quadrature on the overlap of two faces in their current position.
   *
   * Both faces are projected onto the tangent plane at the centre of the slave
   * face; the polygons are clipped there exactly, and each piece is divided into
   * triangles with a rule of degree 5. Biquadratic faces are divided into four
   * bilinear ones first. Puso (2004), Int. J. Numer. Meth. Engng 59.
   */
  std::vector<OverlapPoint>
  overlap(const Face &slave, const Face &master);
} // namespace Touchstone

#endif
