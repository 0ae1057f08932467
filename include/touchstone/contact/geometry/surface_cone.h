// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_surface_cone_h
#define touchstone_contact_geometry_surface_cone_h

#include <touchstone/contact/geometry/surface.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief The directions that are normal to a surface at a node, in its present position: on
   * a smooth surface one, at an edge or a vertex all between the normals of the faces that meet.
   *
   * Where the surface ends the body may end in an edge: there the directions away from the
   * surface within its tangent plane belong to them.
   */
  class SurfaceCone
  {
  public:
    /** @param node Owned by this rank. */
    SurfaceCone(const Surface &surface, Index node);

    /** @brief Add what the other halves of the body have beyond planes of symmetry that the node
     * lies on. @param planes Their normals, unit vectors. */
    void
    mirror(const std::vector<dealii::Tensor<1, dim>> &planes);

    /** @brief The node and those that share a face with it. */
    const std::vector<Index> &
    nodes() const
    {
      return around;
    }

    /** @brief Distance of the unit vector @p direction from the closest of the directions:
     * the sine of the angle between them, 1 if that is no acute one. */
    double
    distance(const dealii::Tensor<1, dim> &direction) const;

  private:
    std::vector<Index>                  around;
    std::vector<dealii::Tensor<1, dim>> normals;
  };
} // namespace Touchstone

#endif
