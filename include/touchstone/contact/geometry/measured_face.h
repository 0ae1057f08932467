// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_measured_face_h
#define touchstone_contact_geometry_measured_face_h

#include <touchstone/algebra/vector.h>
#include <touchstone/contact/geometry/face_geometry.h>

#include <deal.II/base/bounding_box.h>

#include <array>
#include <optional>

namespace Touchstone
{
  /** @brief A face with what tells how deep points lie behind it. Keeps a reference to the face,
   * which must not be moved or destroyed before. */
  class MeasuredFace
  {
  public:
    using Xi = std::array<double, 2>;

    /** @brief Coordinates, in each direction, of the points of a face that are tried. */
    static constexpr std::array<double, 5> samples = {{-1., -0.5, 0., 0.5, 1.}};

    const Face &face;
    /** Or null. */
    const AnalyticSurface *const exact;

    /** @param exact The exact surface, or null. */
    MeasuredFace(const Face &face, const AnalyticSurface *exact);

    /** @brief The side of a square face with the same diagonal; length. */
    double
    size() const
    {
      return side;
    }

    /** @brief How far facets of a hollow surface lie before the surface that they stand for:
     * surfaces that fit overlap by as much. Zero on exact surfaces; length. */
    double
    sagitta() const
    {
      return before;
    }

    /** @brief How far facets of a curved surface, hollow or not, lie from it at most; length. */
    double
    facet_error() const
    {
      return off;
    }

    /** @brief Whether a surface with the normal @p other can meet the face: the sides of a thin
     * body that are turned away from each other do not. */
    bool
    meets(const dealii::Tensor<1, dim> &other) const;

    /** @brief How far behind the surface a point lies; nothing if it is not above or below this
     * face. Points that are not @p least deep may be left out. @param xi Set to the foot. */
    std::optional<double>
    depth(const dealii::Point<dim> &x, double least, Xi &xi) const;

    /** @brief Whether it is plain that neither of two faces has a point that lies behind the other
     * by more than @p least: a plane is between them, but for what is less. Facets alone are
     * looked at. @param other A face with a straight edge at each side, no exact surface. */
    bool
    clear_of(const Face &other, double least) const;

    /** @brief From the point at @p xi to that between straight edges, as of the cells of
     * DeformedCells. */
    dealii::Tensor<1, dim>
    to_straight_edges(const Xi &xi) const;

    /** @brief The box around the nodes of a face, widened by @p reach. */
    static dealii::BoundingBox<dim>
    box_around(const Face &face, double reach);

    /** @brief A face where it is without any displacement. */
    static Face
    in_reference(const Face &face);

    /** @brief A face with the displacement @p u, with ghosts: surfaces of tied pairs are not
     * moved. */
    static Face
    displaced(const Face &face, const Vector &u);

  protected:
    /** @brief The normal in the middle. */
    const dealii::Tensor<1, dim> &
    axis() const
    {
      return normal;
    }

    /** @brief Distance of a point from the line along axis() through the middle; length. */
    double
    from_axis(const dealii::Point<dim> &x) const
    {
      return cross_product_3d(x - centre.x, normal).norm();
    }

  private:
    const FaceGeometry           geometry;
    const FacePoint              centre;
    const dealii::Tensor<1, dim> normal;
    double                       side = 0., before = 0., off = 0., bulge = 0.;

    std::array<unsigned int, 4>
    corners() const;
  };
} // namespace Touchstone

#endif
