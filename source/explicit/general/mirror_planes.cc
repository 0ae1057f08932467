// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/first_of_ranks.h>
#include <touchstone/explicit/general/mirror_planes.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

// Bodies that fold through their own plane of symmetry (doc/general_contact.md, section 6.1).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Relative to the size of the body: what is nearer to a plane is on it as bodies are placed.
     */
    constexpr double on_plane = 1e-9;
  } // namespace



  MirrorPlanes::MirrorPlanes(const ImpactSurfaceInput &input,
                             const Solid              &solid,
                             const ImpactSurface      &surface,
                             const NodeMap            &nodes)
    : surface(surface)
    , nodes(nodes)
  {
    for (unsigned int b = 0; b < input.bodies.size(); ++b)
      for (const BoundaryIds &ids : input.bodies[b].symmetry)
        {
          std::vector<Plane> faces;
          for (const auto &cell : solid.dof_handler.active_cell_iterators())
            if (cell->is_locally_owned())
              for (const unsigned int f : cell->face_indices())
                if (const auto face = cell->face(f);
                    face->at_boundary() && ids.count(face->boundary_id()) > 0)
                  {
                    Tensor<1, dim> normal = cross_product_3d(face->vertex(3) - face->vertex(0),
                                                             face->vertex(2) - face->vertex(1));
                    if (normal * (face->center() - cell->center()) < 0.)
                      normal *= -1.;
                    faces.push_back({b, face->center(), normal / normal.norm()});
                  }
          add(b, faces);
        }
  }



  void
  MirrorPlanes::add(const unsigned int body, const std::vector<Plane> &faces)
  {
    // That of the first face in space, so that it does not depend on the ranks.
    std::vector<double> mine;
    for (const Plane &face : faces)
      {
        const Point<dim>         &x = face.point;
        const Tensor<1, dim>     &n = face.outward;
        const std::vector<double> place{x[0], x[1], x[2], n[0], n[1], n[2]};
        if (mine.empty() || place < mine)
          mine = place;
      }
    const std::vector<double> first = first_of_ranks(mine, 2 * dim, nodes.communicator());
    if (first.empty())
      return;
    const Plane plane{body,
                      Point<dim>(first[0], first[1], first[2]),
                      Tensor<1, dim>({first[3], first[4], first[5]})};
    const auto  off     = [&](const Point<dim> &x) { return (x - plane.point) * plane.outward; };
    const auto  of_body = [&](const unsigned int node) { return nodes.body(node) == plane.body; };
    double      largest = 0.;
    for (const unsigned int node : surface.owned_nodes())
      if (of_body(node))
        largest = std::max(largest, (nodes.positions()[node] - plane.point).norm());
    const double near  = on_plane * Utilities::MPI::max(largest, nodes.communicator());
    int          apart = 0;
    for (const unsigned int node : surface.owned_nodes())
      if (of_body(node))
        apart |= off(Point<dim>(nodes.positions()[node])) > near;
    for (const Plane &face : faces)
      apart |= std::abs(off(face.point)) > near;
    if (Utilities::MPI::max(apart, nodes.communicator()) == 0)
      planes.push_back(plane);
  }



  std::string
  MirrorPlanes::passed(const NodeField                &u,
                       const double                    part,
                       const std::vector<std::string> &bodies) const
  {
    for (const Plane &plane : planes)
      {
        // Of the farthest node how far it is beyond the plane, negative, and where.
        std::vector<double> mine;
        std::uint64_t       n = 0;
        for (const unsigned int node : surface.owned_nodes())
          if (nodes.body(node) == plane.body)
            {
              const Point<dim> x  = surface.position(node, u);
              const double     by = (x - plane.point) * plane.outward;
              if (!(by > part * surface.size(node)))
                continue;
              ++n;
              const std::vector<double> place{-by, x[0], x[1], x[2]};
              if (mine.empty() || place < mine)
                mine = place;
            }
        const std::vector<double> far = first_of_ranks(mine, 1 + dim, nodes.communicator());
        if (far.empty())
          continue;
        n = Utilities::MPI::sum(n, nodes.communicator());
        char text[200];
        std::snprintf(text,
                      sizeof(text),
                      "%llu nodes of '%s' have passed through its plane of symmetry, the farthest "
                      "by %.4g near (%.5g, %.5g, %.5g)",
                      static_cast<unsigned long long>(n),
                      bodies[plane.body].c_str(),
                      -far[0],
                      far[1],
                      far[2],
                      far[3]);
        return text;
      }
    return "";
  }
} // namespace Touchstone
