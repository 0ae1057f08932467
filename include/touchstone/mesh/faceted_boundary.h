// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_faceted_boundary_h
#define touchstone_mesh_faceted_boundary_h

#include <touchstone/base/types.h>
#include <touchstone/mesh/geometry.h>

#include <functional>
#include <set>

namespace Touchstone
{
  /** @brief How far the flat faces of a coarse mesh stray from a smooth surface that they seem to
   * stand for. */
  struct FacetedBoundary
  {
    /** The largest rise of an arc over a face, in units of length; 0 if no face is such. */
    double rise = 0.;
    /** The bend from face to face there, in degrees. */
    double bend = 0.;
    /** Of the face there. */
    dealii::types::boundary_id boundary = 0;
  };

  /**
   * @brief Look for faces of some boundaries that divide a curved surface.
   *
   * Those are faces whose neighbours on two opposite sides bend away in the same sense, by half a
   * degree to 35 degrees each and by less than twice the other one. A single bend, of a chamfer
   * perhaps, is meant. An arc that turns by the angle θ over a face of the width w rises by
   * w/2 tan(θ/4) over it.
   *
   * @param mesh   A coarse mesh.
   * @param ids    The boundaries.
   * @param is_flat Whether the shape of a face of @p mesh is its four corners.
   */
  FacetedBoundary
  find_facets(const BodyMesh                                         &mesh,
              const std::set<dealii::types::boundary_id>             &ids,
              const std::function<bool(const dealii::CellData<2> &)> &is_flat);
} // namespace Touchstone

#endif
