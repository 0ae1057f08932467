// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_facet_walls_h
#define touchstone_mesh_facet_walls_h

#include <touchstone/mesh/facet_surface.h>

#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace Touchstone
{
  /**
   * @brief How a surface of facets falls into walls: parts that meet in sharp edges which look
   * inwards, as the corners of a die (doc/theory.md 4.5).
   *
   * A point in such a corner touches both parts, while its closest point is on one of them and
   * changes from one to the other: a single condition has no solution there. Facets that meet in
   * no sharp edge are a patch. Patches that share a sharp edge which looks inwards get different
   * numbers, so few walls are enough: three for the inside of a box.
   */
  class FacetWalls
  {
  public:
    explicit FacetWalls(const FacetSurface &surface);

    unsigned int
    n_walls() const
    {
      return n;
    }

    /** @brief Facets of a wall. */
    std::vector<unsigned int>
    facets_of(unsigned int wall) const;

    unsigned int
    patch(const unsigned int facet) const
    {
      return patches[facet];
    }

    unsigned int
    wall(const unsigned int facet) const
    {
      return walls[patches[facet]];
    }

    /** @brief Whether two patches share a sharp edge that looks inwards. */
    bool
    meet(const unsigned int patch, const unsigned int other) const
    {
      return neighbours.count({std::min(patch, other), std::max(patch, other)}) > 0;
    }

    /** @brief An edge that looks inwards, of one of its facets. */
    struct InnerEdge
    {
      unsigned int facet;
      /** In the plane of the facet, away from it across the edge; unit vector. */
      dealii::Tensor<1, 3> across;
    };

    /** @brief The sharp inner edges of facets of a patch at a corner. */
    std::vector<InnerEdge>
    inner_edges(unsigned int patch, unsigned int corner) const;

    /** @brief Whether an edge is sharp, looks inwards and is between two patches. */
    bool
    is_inner(const FacetSurface::Edge &edge) const
    {
      return inner.count(edge) > 0;
    }

    /** @brief The facet of lowest wall at a closest point. */
    unsigned int
    first_facet(const FacetSurface::Closest &at) const;

  private:
    unsigned int                                    n = 1;
    std::vector<unsigned int>                       patches, walls;
    std::set<std::pair<unsigned int, unsigned int>> neighbours;
    std::set<FacetSurface::Edge>                    inner;
    std::vector<std::vector<InnerEdge>>             at_corner;
    std::vector<std::vector<unsigned int>>          facets_at;
    std::vector<FacetSurface::Corners>              facets;

    void
    number_walls();
  };

  /** @brief The walls of a surface as surfaces of their own; none if there is only one. */
  std::vector<std::shared_ptr<const AnalyticSurface>>
  make_walls(const std::shared_ptr<const FacetSurface> &surface);
} // namespace Touchstone

#endif
