// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_gregory_patch_h
#define touchstone_contact_geometry_gregory_patch_h

#include <touchstone/contact/geometry/face.h>

namespace Touchstone
{
  /**
   * @brief A smooth surface over a bilinear face, from the positions and the
   * averaged normals of its four nodes.
   *
   * Boundary curves are cubics with tangents in the tangent planes of the nodes.
   * Along each edge the tangent plane is computed from data that both adjacent faces have, so
   * neighbours meet with the same plane (G1). Each of the four inner control points
   * is blended from two, one for each adjacent edge.
   *
   * Nodal normals stop at sharp edges, so there each face has a boundary curve of
   * its own; between plane faces it is the straight edge.
   *
   * At the edge of the whole surface normals are mirrored from the next nodes inward.
   *
   * Chiyokura and Kimura (1983), Design of solids with free-form surfaces, Comput.
   * Graph. 17; Puso and Laursen (2002), A 3D contact smoothing method using Gregory
   * patches, Int. J. Numer. Meth. Engng 54, 1161-1194.
   */
  class GregoryPatch
  {
  public:
    static constexpr unsigned int n_control_points = 20;

    /** @param face A face of degree 1, with its nodal normals. */
    explicit GregoryPatch(const Face &face);

    /** @brief Weights of the control points with first derivatives, and second
     * ones in the order 11, 12, 22, with respect to xi. */
    struct Basis
    {
      std::array<double, n_control_points>                value{};
      std::array<std::array<double, 2>, n_control_points> gradient{};
      std::array<std::array<double, 3>, n_control_points> hessian{};

      explicit Basis(const std::array<double, 2> &xi);
    };

    /** @brief Position and tangents at @p xi. */
    FacePoint
    evaluate(const std::array<double, 2> &xi) const;

    /** @brief Second derivatives of the position: 11, 12, 22; length. At the
     * corners, where they are not unique, the mean. */
    std::array<dealii::Tensor<1, dim>, 3>
    second_derivatives(const std::array<double, 2> &xi) const;

    /** @brief Derivatives of the control points: [k][m] with respect to the
     * position of node m (no unit) for m < 4, to the normal of node m - 4
     * (length) otherwise. */
    using Derivative = std::array<std::array<dealii::Tensor<2, dim>, 8>, n_control_points>;

    static Derivative
    differentiate(const Face &face);

  private:
    std::array<dealii::Tensor<1, dim>, n_control_points> points;
  };
} // namespace Touchstone

#endif
