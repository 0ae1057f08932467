// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/explicit/general/mirror_planes.h>

#include <algorithm>
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
          add(faces);
        }
  }



  void
  MirrorPlanes::add(const std::vector<Plane> &faces)
  {
    const std::vector<Plane> all =
      gather_all(faces.empty() ? faces : std::vector<Plane>{faces.front()}, nodes.communicator());
    if (all.empty())
      return;
    const Plane plane   = all.front();
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
    struct Farthest
    {
      double        by;
      std::uint64_t key;
      Point<dim>    position;
    };
    for (const Plane &plane : planes)
      {
        std::vector<Farthest> mine;
        for (const unsigned int node : surface.owned_nodes())
          if (nodes.body(node) == plane.body)
            {
              const Point<dim> x  = surface.position(node, u);
              const double     by = (x - plane.point) * plane.outward;
              if (by > part * surface.size(node))
                mine.push_back({by, nodes.key(node), x});
            }
        const std::uint64_t n =
          Utilities::MPI::sum<std::uint64_t>(mine.size(), nodes.communicator());
        if (n == 0)
          continue;
        const auto before = [](const Farthest &a, const Farthest &b) {
          return a.by != b.by ? a.by > b.by : a.key < b.key;
        };
        std::sort(mine.begin(), mine.end(), before);
        mine.resize(std::min<std::size_t>(mine.size(), 1));
        std::vector<Farthest> all = gather_all(mine, nodes.communicator());
        const Farthest        far = *std::min_element(all.begin(), all.end(), before);
        char                  text[200];
        std::snprintf(text,
                      sizeof(text),
                      "%llu nodes of '%s' have passed through its plane of symmetry, the farthest "
                      "by %.4g near (%.5g, %.5g, %.5g)",
                      static_cast<unsigned long long>(n),
                      bodies[plane.body].c_str(),
                      far.by,
                      far.position[0],
                      far.position[1],
                      far.position[2]);
        return text;
      }
    return "";
  }
} // namespace Touchstone
