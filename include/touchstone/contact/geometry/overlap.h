// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_overlap_h
#define touchstone_contact_geometry_overlap_h

#include <touchstone/contact/geometry/face.h>

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
    /** Weight: area of the slave face. Zero for corners of the overlap, at
     * which the gap between plane faces has its extrema. */
    double weight;
  };

  /**
   * @brief Quadrature on the overlap of two faces in their current position.
   *
   * Both faces are projected onto the tangent plane at the centre of the slave
   * face; the polygons are clipped there exactly, and each piece of more than four corners is
   * divided into triangles from its centroid, with rules that do not depend on the order of
   * corners. Biquadratic faces are divided into four bilinear ones first. Puso (2004), Int. J.
   * Numer. Meth. Engng 59.
   */
  std::vector<OverlapPoint>
  overlap(const Face &slave, const Face &master);

  /** @brief The same with each of several masters, in their order; the slave face is projected
   * only once. */
  std::vector<std::vector<OverlapPoint>>
  overlap(const Face &slave, const std::vector<const Face *> &masters);

  /** @brief Whether two faces overlap, or may do so after each of their nodes has moved
   * by no more than @p motion (length). */
  bool
  may_overlap(const Face &slave, const Face &master, double motion);

  /** @brief An OverlapPoint with derivatives with respect to the positions of the
   * slave nodes and then of the master nodes: component d of node m is variable
   * dim * m + d.
   * @tparam n Nodes of a face, 4 or 9. */
  template <unsigned int n>
  struct OverlapPointDerivative : OverlapPoint
  {
    static constexpr unsigned int n_variables = 2 * n * dim;

    using Gradient = std::array<double, n_variables>;
    std::array<Gradient, 2> d_slave, d_master;
    Gradient                d_weight;
  };

  /** @brief overlap() with derivatives, while the corners of the clipped polygons
   * stay on the same edges. */
  template <unsigned int n>
  std::vector<OverlapPointDerivative<n>>
  differentiated_overlap(const Face &slave, const Face &master);
} // namespace Touchstone

#endif
