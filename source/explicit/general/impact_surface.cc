// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/impact_surface.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Faces without a cell behind them, and normals of their nodes (doc/general_contact.md, section 2).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The nodes of a cell, in the order of FE_Q: those of each face in the order that turns about
     * the outward normal, and after them the others. */
    constexpr unsigned int nodes_of_faces[6][8] = {{0, 4, 6, 2, 1, 3, 5, 7},
                                                   {1, 3, 7, 5, 0, 2, 4, 6},
                                                   {0, 1, 5, 4, 2, 3, 6, 7},
                                                   {2, 6, 7, 3, 0, 1, 4, 5},
                                                   {0, 2, 3, 1, 4, 5, 6, 7},
                                                   {4, 5, 7, 6, 0, 1, 2, 3}};

    bool
    takes_part(const ImpactSurfaceInput &input,
               const unsigned int        body,
               const types::boundary_id  id)
    {
      const ImpactSurfaceInput::Boundaries &of = input.bodies[body];
      return (of.ids.count(id) > 0) != of.all_but;
    }

    /** Half the cross product of the diagonals, area times normal. */
    template <class Position>
    Tensor<1, dim>
    area_vector(const std::array<unsigned int, 4> &face, const Position &x)
    {
      return 0.5 * cross_product_3d(x(face[2]) - x(face[0]), x(face[3]) - x(face[1]));
    }
  } // namespace



  bool
  ImpactFace::of_cell(const std::uint64_t node) const
  {
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
  }



  bool
  ImpactFace::shares_node(const ImpactFace &other) const
  {
    const auto end = nodes.begin() + 4;
    return std::find_first_of(nodes.begin(), end, other.nodes.begin(), other.nodes.begin() + 4) !=
           end;
  }



  ImpactSurface::ImpactSurface(const ImpactSurfaceInput &input,
                               const Solid              &solid,
                               const NodeMap            &nodes)
    : nodes(nodes)
    , declared(input.declared)
    , place(nodes.n_local(), numbers::invalid_unsigned_int)
  {
    std::vector<unsigned int> by_index(solid.dof_handler.get_triangulation().n_active_cells(),
                                       numbers::invalid_unsigned_int);
    for (unsigned int c = 0; c < nodes.cells().size(); ++c)
      by_index[nodes.cells()[c].index] = c;
    struct Found
    {
      ImpactFace                  face;
      std::array<unsigned int, 4> local;
      bool                        owned;
    };
    std::vector<Found> found;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (const unsigned int c = by_index[cell->active_cell_index()];
          c != numbers::invalid_unsigned_int)
        for (unsigned int f = 0; f < 6; ++f)
          if (const NodeMap::Cell &one = nodes.cells()[c];
              cell->face(f)->at_boundary() &&
              takes_part(input, one.body, cell->face(f)->boundary_id()))
            {
              const NodeMap::CellNodes &corners = nodes.nodes(c);
              Found                     next;
              next.owned         = one.owned;
              next.face.key      = one.key + f;
              next.face.body     = one.body;
              next.face.boundary = cell->face(f)->boundary_id();
              for (unsigned int a = 0; a < 8; ++a)
                next.face.nodes[a] = nodes.key(corners[nodes_of_faces[f][a]]);
              for (unsigned int a = 0; a < 4; ++a)
                {
                  next.local[a]     = corners[nodes_of_faces[f][a]];
                  next.face.dofs[a] = nodes.dof(next.local[a]);
                }
              found.push_back(next);
            }
    std::sort(found.begin(), found.end(), [](const Found &a, const Found &b) {
      return a.face.key < b.face.key;
    });
    for (const Found &one : found)
      {
        if (one.owned)
          own.push_back(one.face);
        corners.push_back(one.local);
        for (const unsigned int node : one.local)
          if (node < nodes.n_owned())
            {
              if (place[node] == numbers::invalid_unsigned_int)
                {
                  place[node] = around.size();
                  around.emplace_back();
                  surface_nodes.push_back(node);
                }
              around[place[node]].push_back(corners.size() - 1);
            }
      }
    const auto reference = [&](const unsigned int n) { return nodes.positions()[n]; };
    for (const auto &faces : around)
      {
        double area = 0.;
        for (const unsigned int face : faces)
          area += area_vector(corners[face], reference).norm();
        sizes.push_back(std::sqrt(area / faces.size()));
      }
    n_global = Utilities::MPI::sum<std::uint64_t>(own.size(), nodes.communicator());
  }



  template <class Area>
  ImpactSurface::Inset
  ImpactSurface::inset_of(const unsigned int node, const Area &area) const
  {
    Tensor<1, dim> sum;
    double         smallest = std::numeric_limits<double>::max();
    for (const unsigned int face : around[place[node]])
      {
        const Tensor<1, dim> of_face = area(face);
        sum += of_face;
        smallest = std::min(smallest, of_face.norm_square());
      }
    const double length = sum.norm();
    Inset        result;
    if (length > 0.)
      result.normal = sum / length;
    // Mostly no face is so small that its size, of which this is the fourth power, counts.
    const double of_node = size(node), square = of_node * of_node / (slender * slender);
    result.depth = smallest < square * square ? slender * std::sqrt(std::sqrt(smallest)) : of_node;
    return result;
  }



  ImpactSurface::Inset
  ImpactSurface::inset(const unsigned int node, const NodeField &u) const
  {
    const auto x = [&](const unsigned int n) { return nodes.positions()[n] + u[n]; };
    return inset_of(node, [&](const unsigned int face) { return area_vector(corners[face], x); });
  }



  ImpactSurface::Inset
  ImpactSurface::inset(const unsigned int  node,
                       const NodeField    &u,
                       FaceAreas          &known,
                       const std::uint64_t positions) const
  {
    const auto x = [&](const unsigned int n) { return nodes.positions()[n] + u[n]; };
    known.areas.resize(corners.size());
    known.positions.resize(corners.size(), 0);
    return inset_of(node, [&](const unsigned int face) -> const Tensor<1, dim> & {
      if (known.positions[face] != positions)
        {
          known.areas[face]     = area_vector(corners[face], x);
          known.positions[face] = positions;
        }
      return known.areas[face];
    });
  }



  bool
  ImpactSurface::may_meet(const types::boundary_id one, const types::boundary_id other) const
  {
    return std::none_of(declared.begin(), declared.end(), [&](const auto &pair) {
      return (pair.first.count(one) > 0 && pair.second.count(other) > 0) ||
             (pair.first.count(other) > 0 && pair.second.count(one) > 0);
    });
  }
} // namespace Touchstone
