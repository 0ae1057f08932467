// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/faceted_boundary.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

// Files with eight nodes a cell do not say whether a boundary is a polyhedron or a smooth surface
// that has been divided. Contact between facets of the second kind can carry several times the
// force, so that the user is told.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Quad     = CellData<2>;
    using FaceEdge = std::pair<unsigned int, unsigned int>;

    /** The corners of the four edges of a face, opposite ones after each other. */
    constexpr unsigned int edges_of_face[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};

    FaceEdge
    edge_of(const Quad &face, const unsigned int e)
    {
      return std::minmax({face.vertices[edges_of_face[e][0]], face.vertices[edges_of_face[e][1]]});
    }



    Point<dim>
    middle(const BodyMesh &mesh, const FaceEdge &edge)
    {
      return mesh.vertices[edge.first] +
             (mesh.vertices[edge.second] - mesh.vertices[edge.first]) / 2;
    }



    Point<dim>
    center(const BodyMesh &mesh, const Quad &face)
    {
      return middle(mesh, edge_of(face, 0)) +
             (middle(mesh, edge_of(face, 1)) - middle(mesh, edge_of(face, 0))) / 2;
    }



    /** The angle by which the way from one face over an edge to the next one bends towards the
     * normal of the first. */
    double
    bend(const BodyMesh &mesh, const Quad &face, const FaceEdge &edge, const Quad &next)
    {
      const Point<dim>     m = middle(mesh, edge);
      const Tensor<1, dim> t = mesh.vertices[edge.second] - mesh.vertices[edge.first],
                           n = cross_product_3d(mesh.vertices[face.vertices[3]] -
                                                  mesh.vertices[face.vertices[0]],
                                                mesh.vertices[face.vertices[2]] -
                                                  mesh.vertices[face.vertices[1]]);
      const auto across      = [&t](const Tensor<1, dim> &v) { return v - (v * t) / (t * t) * t; };
      const Tensor<1, dim> before = across(m - center(mesh, face)),
                           after  = across(center(mesh, next) - m);
      const double angle = std::atan2(cross_product_3d(before, after).norm(), before * after);
      return after * n < 0. ? -angle : angle;
    }
  } // namespace



  FacetedBoundary
  find_facets(const BodyMesh                          &mesh,
              const std::set<types::boundary_id>      &ids,
              const std::function<bool(const Quad &)> &is_flat)
  {
    std::vector<const Quad *> faces;
    for (const Quad &face : mesh.subcells.boundary_quads)
      if (ids.count(face.boundary_id) > 0 && is_flat(face))
        faces.push_back(&face);
    std::map<FaceEdge, std::vector<const Quad *>> at;
    for (const Quad *face : faces)
      for (unsigned int e = 0; e < 4; ++e)
        at[edge_of(*face, e)].push_back(face);

    constexpr double degree = numbers::PI / 180.;
    FacetedBoundary  result;
    for (const Quad *face : faces)
      for (unsigned int e = 0; e < 4; e += 2)
        {
          double bends[2] = {0., 0.};
          for (unsigned int side = 0; side < 2; ++side)
            {
              const FaceEdge edge = edge_of(*face, e + side);
              const auto    &both = at.at(edge);
              if (both.size() == 2)
                bends[side] = bend(mesh, *face, edge, *both[both[0] == face ? 1 : 0]);
            }
          const double small = std::min(std::abs(bends[0]), std::abs(bends[1])),
                       large = std::max(std::abs(bends[0]), std::abs(bends[1]));
          if (bends[0] * bends[1] <= 0. || small < 0.5 * degree || large > 35. * degree ||
              large > 2. * small)
            continue;
          const double width = middle(mesh, edge_of(*face, e))
                                 .distance(middle(mesh, edge_of(*face, e + 1))),
                       rise = width / 2. * std::tan((small + large) / 8.);
          if (rise > result.rise)
            result = {rise, large / degree, face->boundary_id};
        }
    return result;
  }
} // namespace Touchstone
