// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_face_geometry_h
#define touchstone_contact_geometry_face_geometry_h

#include <touchstone/contact/geometry/bilinear.h>
#include <touchstone/contact/geometry/facet_rotation.h>
#include <touchstone/contact/geometry/following_arch.h>
#include <touchstone/contact/geometry/gregory_patch.h>
#include <touchstone/contact/geometry/master_normal.h>

#include <optional>
#include <string>
#include <utility>

namespace Touchstone
{
  /**
   * @brief The surface over a face to which gaps are measured, and its normal.
   *
   * Where the exact surface is known it is used, and `smoothed` is the same as
   * `averaged`. Keeps a reference to the face, which must not be moved or destroyed before.
   */
  class FaceGeometry
  {
  public:
    /** @param exact The exact surface, or null.
     *  @param arch  How it turns. */
    FaceGeometry(const Face            &face,
                 const AnalyticSurface *exact,
                 MasterNormal           kind,
                 Arch                   arch = Arch::with_facet);

    const Face &
    face() const
    {
      return data;
    }

    /** @brief Gaps are measured to a Gregory patch. */
    bool
    smooth() const
    {
      return patch.has_value();
    }

    /** @brief Its points depend on the normals of the nodes. */
    bool
    follows_normals() const
    {
      return patch || following;
    }

    /** @brief The normal comes from those of the nodes and not from the face. */
    bool
    interpolates_normals() const
    {
      return kind != MasterNormal::face && !patch;
    }

    const AnalyticSurface *
    exact_surface() const
    {
      return exact;
    }

    /** @brief Position and tangents at @p xi. */
    FacePoint
    evaluate(const std::array<double, 2> &xi) const;

    /** @brief What of its arch follows the normals; nothing without an exact surface. */
    FollowingArch::Part
    following_part(const FaceShapes &shapes, const std::array<double, 2> &xi) const;

    /** @brief Position alone, which costs half. @param shapes Shape functions at @p xi. */
    dealii::Point<dim>
    position(const std::array<double, 2> &xi, const FaceShapes &shapes) const;

    /** @brief normal() from what is known there. @param shapes Shape functions at xi.
     * @param point The evaluate() there. */
    dealii::Tensor<1, dim>
    normal(const FaceShapes &shapes, const FacePoint &point) const
    {
      return interpolates_normals() ? interpolated_normal(shapes, point) : point.normal();
    }

    /** @brief Second derivatives of the position with respect to xi: 11, 12, 22;
     * length. Those of an exact surface are central differences of its projection
     * gradient. */
    std::array<dealii::Tensor<1, dim>, 3>
    second_derivatives(const std::array<double, 2> &xi) const;

    /**
     * @brief Unit outward normal at @p xi.
     *
     * `averaged`: continuous across the edges of faces unless these are sharp. On
     * facets it is interpolated from the averaged normals of the nodes. On an exact
     * surface it is that of the surface moved with the face, with the jumps at the
     * nodes taken out.
     */
    dealii::Tensor<1, dim>
    normal(const std::array<double, 2> &xi) const;

    /** @brief Whether @p xi lies on an edge or a corner of the face at which faces meet in a sharp
     * edge. @param mean Set to the mean of the normals of all faces around, not a unit vector. */
    bool
    sharp(const std::array<double, 2> &xi, dealii::Tensor<1, dim> &mean) const;

  private:
    const Face                  &data;
    const AnalyticSurface       *exact;
    MasterNormal                 kind;
    std::optional<GregoryPatch>  patch;
    std::optional<FollowingArch> following;
    /** With an exact surface, which turns by it: that of the facet. */
    dealii::Tensor<2, dim> rotation;
    /** Displacements of the nodes; with an exact surface relative to the rotation. */
    std::array<dealii::Tensor<1, dim>, Face::max_nodes> moved;
    /** If of degree 1: of the nodes and of `moved`. */
    Bilinear<dim> reference, displacement;

    /** The point with all of the arch turned with the facet. */
    FacePoint
    on_facet(const std::array<double, 2> &xi) const;
    /** The normals of the surface itself at the nodes. */
    using NodeNormals = std::array<dealii::Tensor<1, dim>, Face::max_nodes>;
    const NodeNormals &
    own_normals() const;
    /** Of surfaces that follow the normals, once they have been asked for. */
    mutable std::optional<NodeNormals> following_normals;
    /** @param point The evaluate() there. */
    dealii::Tensor<1, dim>
    interpolated_normal(const FaceShapes &shapes, const FacePoint &point) const;
  };

  /** @brief Result of a closest-point projection. */
  struct Projection
  {
    std::array<double, 2> xi{};
    double                distance_squared = 0.;
    /** How far the point lies beyond the edges at which xi was bounded,
     * as a fraction of the face, for inner and outer edges. */
    double beyond_inner = 0., beyond_outer = 0.;
  };

  /**
   * @brief Closest point of a deformed face, held within the face.
   *
   * Gauss-Newton with the second derivatives of bilinear faces and of smooth
   * patches, and of exact surfaces that are far away, projected to the bounds; from
   * several starts if the first does not converge.
   */
  Projection
  closest_point_projection(const dealii::Point<dim> &x, const FaceGeometry &geometry);
} // namespace Touchstone

#endif
