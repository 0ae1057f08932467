// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_mirror_images_h
#define touchstone_contact_geometry_mirror_images_h

#include <touchstone/base/types.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace Touchstone
{
  /** @brief Unit normals of a face at one of its nodes. */
  struct NormalsAtNode
  {
    /** In the present state. */
    dealii::Tensor<1, dim> present;
    /** In the reference state, turned with the facet: without what bends the face. */
    dealii::Tensor<1, dim> turned;
  };

  /**
   * @brief What the other halves of a body have at a point on planes of symmetry: of each area
   * vector there its images, mirrored at these planes (doc/theory.md 4, "Normals").
   *
   * Nodal normals are means over the faces of the whole body, of which a scene may have a half, a
   * quarter, or any part between planes.
   */
  class MirrorImages
  {
  public:
    /** @brief On no plane: each vector is its only image. */
    MirrorImages() = default;

    /** @param planes Unit normals of the planes that the point lies on; of planes that make no
     *                finite number of images with each other those that are orthogonal to the
     *                first ones count. */
    explicit MirrorImages(const std::vector<dealii::Tensor<1, dim>> &planes);

    bool
    empty() const
    {
      return reflections.empty();
    }

    /** @brief Whether the images of two faces with these unit normals are all averaged with each
     * other and with the faces: none of them meet in a sharp edge. */
    bool
    smooth(const dealii::Tensor<1, dim> &one, const dealii::Tensor<1, dim> &other) const;

    /** @brief The sum over the images of a face with the normals @p other that a face with the
     * normals @p own does not meet in a sharp edge, as a matrix that acts on the area vector of
     * the former: zero if there are none.
     *
     * An edge is sharp by both normals: a node pressed into a smooth surface bends the faces around
     * it, which have not turned (doc/theory.md 4, "Normals"). */
    dealii::Tensor<2, dim>
    averaged_with(const NormalsAtNode &other, const NormalsAtNode &own) const;

    /** @brief The sum over all images as a matrix that acts on the sum of area vectors @p sum: they
     * have no component across the planes. The identity where this would leave nothing: the
     * surface is tangential to a plane. */
    dealii::Tensor<2, dim>
    all(const dealii::Tensor<1, dim> &sum) const;

  private:
    /** All products of reflections at the planes but the identity. */
    std::vector<dealii::Tensor<2, dim>> reflections;
  };
} // namespace Touchstone

#endif
