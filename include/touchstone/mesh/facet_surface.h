// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_facet_surface_h
#define touchstone_mesh_facet_surface_h

#include <touchstone/collision/box_tree.h>
#include <touchstone/mesh/analytic_surface.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <vector>

namespace Touchstone
{
  /** @brief A triangle, counter-clockwise as seen from outside; length. */
  using FacetCorners = std::array<dealii::Point<3>, 3>;

  /**
   * @brief The closed surface of triangles, with signed distances by the pseudonormals of its
   * faces, edges and corners (Baerentzen and Aanaes 2005, IEEE Trans. Vis. Comput. Graph. 11).
   *
   * Corners that have the same coordinates are one. Facets of which two corners are one are left
   * out.
   */
  class FacetSurface : public AnalyticSurface
  {
  public:
    /** @brief Numbers of corners: of a facet, and of the ends of an edge, the smaller one first. */
    using Corners = std::array<unsigned int, 3>;
    using Edge    = std::array<unsigned int, 2>;

    static Edge
    edge_between(const unsigned int a, const unsigned int b)
    {
      return {{std::min(a, b), std::max(a, b)}};
    }

    /** @brief The closest point, and what of the surface it lies on. */
    struct Closest
    {
      dealii::Point<3> point;
      unsigned int     facet = 0;
      /** 0: within the facet, 1: on an edge, 2: at a corner. */
      unsigned int n_fixed = 0;
      /** The ends of the edge, or the corner. */
      std::array<unsigned int, 2> feature{};
      /** Along the edge; unit vector, where n_fixed is 1. */
      dealii::Tensor<1, 3> along;
    };

    /** @param outside Material is within and normals point outwards.
     * @throws std::runtime_error with a sentence for a surface that is not closed, whose facets do
     * not look to the same side, or that is inside out. */
    FacetSurface(const std::vector<FacetCorners> &triangles, bool outside);

    dealii::Point<3>
    project(const dealii::Point<3> &x) const override;

    dealii::Tensor<2, 3>
    projection_gradient(const dealii::Point<3> &x) const override;

    dealii::Tensor<1, 3>
    normal(const dealii::Point<3> &x) const override;

    Closest
    closest(const dealii::Point<3> &x) const;

    /** @name For surfaces of some of the facets, see FacetWall */
    /** @{ */
    /** @brief A tree of the boxes around some facets. */
    BoxTree
    tree_of(const std::vector<unsigned int> &chosen) const;

    /** @brief The closest point of the facets of a tree. @param chosen Those of tree_of(). */
    Closest
    closest_of(const dealii::Point<3>          &x,
               const BoxTree                   &tree,
               const std::vector<unsigned int> &chosen) const;

    dealii::Tensor<2, 3>
    gradient_at(const Closest &at) const;

    dealii::Tensor<1, 3>
    normal_at(const dealii::Point<3> &x, const Closest &at) const;

    const std::vector<Corners> &
    all_facets() const
    {
      return facets;
    }

    const dealii::Point<3> &
    corner(const unsigned int v) const
    {
      return corners[v];
    }

    /** @brief Unit normal of a facet, away from the inside of the closed surface. */
    const dealii::Tensor<1, 3> &
    facet_normal(const unsigned int facet) const
    {
      return normals[facet];
    }

    /** @brief 1 if material is within the closed surface, -1 if it is around it. */
    double
    side() const
    {
      return sign;
    }
    /** @} */

  private:
    const double                         sign;
    std::vector<dealii::Point<3>>        corners;
    std::vector<Corners>                 facets;
    std::vector<unsigned int>            numbers;
    std::vector<dealii::Tensor<1, 3>>    normals, corner_normals;
    std::map<Edge, dealii::Tensor<1, 3>> edge_normals;
    double                               size = 0.;
    BoxTree                              tree;

    /** Number the corners. */
    void
    join(const std::vector<FacetCorners> &triangles);

    /** Normals, and whether the surface has an inside. */
    void
    check();

    dealii::Tensor<1, 3>
    pseudonormal(const Closest &at) const;

    /** The closest point of a triangle. */
    Closest
    on_facet(const dealii::Point<3> &x, unsigned int number) const;
  };
} // namespace Touchstone

#endif
