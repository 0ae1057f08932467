// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_placed_geometry_h
#define touchstone_mesh_placed_geometry_h

#include <touchstone/mesh/affine_map.h>
#include <touchstone/mesh/geometry.h>

namespace Touchstone
{
  /**
   * @brief Any geometry, scaled, mirrored, turned, moved and repeated, in this order, by keys that
   * stand beside those of the geometry itself.
   *
   * Boundaries keep their names; those of all copies have the same. Cells of mirrored bodies are
   * numbered anew, so that they are not inside out. Manifolds and exact surfaces go along.
   */
  class PlacedGeometry : public Geometry
  {
  public:
    PlacedGeometry(const std::shared_ptr<Geometry> &inner);

    /** @brief The keys of the placement; those of the geometry are declared elsewhere. */
    void
    declare(dealii::ParameterHandler &prm) override;
    /** @brief As declare(). */
    void
    check(const std::string &section) const override;
    BodyMesh
    create(double factor, const std::string &section, const std::string &folder) const override;
    std::string
    fingerprint(const std::string &folder) const override;

  private:
    const std::shared_ptr<Geometry> inner;

    std::vector<double>       scale = {1.};
    std::string               mirror;
    dealii::Tensor<1, 3>      axis{{0., 0., 1.}}, turned_about, move;
    double                    angle  = 0.;
    std::vector<unsigned int> copies = {1, 1, 1};
    dealii::Tensor<1, 3>      spacing;

    /** Normal of the mirror, or zero. */
    dealii::Tensor<1, 3>
    mirror_normal() const;
    bool
    uniform() const;
    AffineMap
    map() const;
  };
} // namespace Touchstone

#endif
