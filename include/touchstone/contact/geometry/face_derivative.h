// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_face_derivative_h
#define touchstone_contact_geometry_face_derivative_h

#include <touchstone/contact/geometry/face_geometry.h>

#include <memory>
#include <vector>

namespace Touchstone
{
  /** @brief How the averaged normal of a node of a face changes with the position
   * of one of the nodes around it. */
  struct NormalDerivative
  {
    /** Local number of the node whose normal changes. */
    unsigned int m;
    /** The node that moves. */
    Index node;
    /** Per length. */
    dealii::Tensor<2, dim> value;
  };

  /** @brief A point of a FaceGeometry with all that it changes with: xi, the
   * positions of the nodes of the face, and their averaged normals. */
  struct FaceDerivative
  {
    FaceShapes             shapes;
    FacePoint              point;
    dealii::Tensor<1, dim> normal;
    /** Derivatives of the normal with respect to xi. */
    std::array<dealii::Tensor<1, dim>, 2> normal_xi;
    /** Of the normal with respect to positions (per length) and nodal normals. */
    NodeMatrices normal_position, normal_normal;
    /** Of the point at a fixed xi with respect to positions and to nodal normals
     * (length). The latter are zero unless the geometry follows normals. */
    NodeMatrices x_position, x_normal;
    /** The same of the tangents. */
    std::array<NodeMatrices, 2> tangent_position, tangent_normal;
  };

  /** @brief The part of FaceDerivative that does not need the normal. */
  struct FacePosition
  {
    FaceShapes   shapes;
    FacePoint    point;
    NodeMatrices x_position, x_normal;
  };

  /** @brief Evaluates derivatives of a FaceGeometry; keeps what all points of the
   * face share. */
  class FaceDifferentiator
  {
  public:
    /** @param geometry Must live as long. */
    explicit FaceDifferentiator(const FaceGeometry &geometry);

    FaceDerivative
    at(const std::array<double, 2> &xi) const;

    FacePosition
    position(const std::array<double, 2> &xi) const;

    const FaceGeometry &geometry;

  private:
    /** Of exact surfaces: facet_rotation_derivative(). */
    std::unique_ptr<NodeMatrices> turn;
    /** Averaged less own normals at the nodes, and derivatives of the own ones:
     * [m][k] of the normal at node m with respect to the position of node k. For
     * interpolated normals on exact surfaces. */
    std::array<dealii::Tensor<1, dim>, Face::max_nodes> jumps;
    std::array<NodeMatrices, Face::max_nodes>           own;
    /** The same by the averaged normal at node k. */
    std::array<NodeMatrices, Face::max_nodes> own_by_normal;

    std::unique_ptr<GregoryPatch::Derivative> patch;

    /** Set the derivatives of the tangents. */
    void
    differentiate_tangents(FaceDerivative &result, const std::array<double, 2> &xi) const;
    /** Set normal_xi, normal_position and normal_normal to those of t_1 x t_2 / |t_1 x t_2|. */
    void
    differentiate_own_normal(FaceDerivative &result, const std::array<double, 2> &xi) const;
    /** Set the interpolated normal and its derivatives from those of the surface itself. */
    void
    differentiate_interpolated_normal(FaceDerivative               &result,
                                      const dealii::Tensor<1, dim> &own_normal) const;
  };

  /** @brief Derivatives of the tangents of a face, at a fixed xi, with respect to the positions of
   * its nodes. Not for smooth patches.
   * @param shapes Shape functions there.
   * @param tangents Of the exact surface, if there is one.
   * @param turn facet_rotation_derivative() if there is one, else null.
   * @param part What of the arch turns with the normals. */
  std::array<NodeMatrices, 2>
  tangent_derivatives(const Face                                  &face,
                      const FaceShapes                            &shapes,
                      const std::array<dealii::Tensor<1, dim>, 2> &tangents,
                      const NodeMatrices                          *turn,
                      const FollowingArch::Part                   &part = {});

  /** @brief The matrix A of the cross product, A b = a x b. */
  dealii::Tensor<2, dim>
  cross_matrix(const dealii::Tensor<1, dim> &a);

  /** @brief Derivative of v / |v| with respect to v. */
  dealii::Tensor<2, dim>
  normalisation_derivative(const dealii::Tensor<1, dim> &v);
} // namespace Touchstone

#endif
