// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_facet_surface_h
#define touchstone_mesh_facet_surface_h

#include <touchstone/mesh/analytic_surface.h>

#include <array>
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
   * @param outside Material is within and normals point outwards.
   * @throws std::runtime_error with a sentence for a surface that is not closed, whose facets do
   * not look to the same side, or that is inside out.
   */
  std::shared_ptr<const AnalyticSurface>
  make_facet_surface(const std::vector<FacetCorners> &facets, bool outside);
} // namespace Touchstone

#endif
