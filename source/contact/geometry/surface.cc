// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/contact/geometry/face_area.h>
#include <touchstone/contact/geometry/surface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

// One side of a contact pair as this rank sees it: its boundary faces, the nodes that carry rows
// with their tributary areas, and averaged normals. Faces of ghost cells are kept as well, so that
// areas and normals of owned nodes are complete without communication in each iteration; the faces
// farther away that hanging nodes need are exchanged once per mesh (doc/theory.md 11).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** An identifier for the face of a cell that does not depend on the partition:
     * the path to the cell in the forest, in 30 bits for ten levels; the level, which
     * tells a cell from its first child; and the face. */
    std::uint64_t
    face_key(const CellId &id, const unsigned int face)
    {
      // 27 bits for the coarse cell, 30 for the path, 4 for the level and 3 for the face make 64.
      constexpr unsigned int max_level = 10;
      const auto             path      = id.get_child_indices();
      AssertThrow(path.size() <= max_level && id.get_coarse_cell_id() < (1u << 27),
                  ExcMessage("The mesh has more than 10 levels or 2^27 coarse cells."));
      std::uint64_t key = id.get_coarse_cell_id();
      for (unsigned int level = 0; level < max_level; ++level)
        key = key * 8 + (level < path.size() ? path[level] : 0);
      return (key * 16 + path.size()) * 8 + face;
    }

    /** A node of a face of a cell: its first degree of freedom there, its number on the face, and
     * its position in the unit cell; and the first degree of freedom on the opposite face, and the
     * number of the corner, Face::behind elsewhere. */
    struct NodeOnFace
    {
      unsigned int dof, m;
      Point<dim>   unit;
      unsigned int behind, corner;
    };

    std::array<std::vector<NodeOnFace>, 6>
    nodes_on_faces(const FiniteElement<dim> &fe)
    {
      std::array<std::vector<NodeOnFace>, 6> result;
      for (unsigned int f = 0; f < result.size(); ++f)
        {
          // Axes of the face such that their cross product points outward: the
          // position of a node on the unit cell tells its number on the face.
          const unsigned int normal_axis = f / 2;
          const unsigned int axes[2]     = {(normal_axis + (f % 2 == 1 ? 1 : 2)) % 3,
                                            (normal_axis + (f % 2 == 1 ? 2 : 1)) % 3};
          for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
            if (fe.system_to_component_index(i).first == 0 && fe.has_support_on_face(i, f))
              {
                const Point<dim> unit  = fe.unit_support_point(i);
                const auto       along = [&](const unsigned int axis) {
                  return static_cast<unsigned int>(std::lround(unit[axis] * fe.degree));
                };
                Point<dim> opposite   = unit;
                opposite[normal_axis] = 1. - unit[normal_axis];
                unsigned int behind   = 0;
                while (fe.system_to_component_index(behind).first != 0 ||
                       fe.unit_support_point(behind).distance(opposite) > 1e-8)
                  ++behind;
                const unsigned int a = along(axes[0]), b = along(axes[1]), p = fe.degree;
                const bool         corner = a % p == 0 && b % p == 0;
                result[f].push_back(
                  {i, a + (p + 1) * b, unit, behind, corner ? a / p + 2 * (b / p) : Face::behind});
              }
        }
      return result;
    }
  } // namespace



  const Surface::NodeOfFaces &
  Surface::node_of_faces(const Index node) const
  {
    const auto found =
      std::lower_bound(surface_nodes.begin(),
                       surface_nodes.end(),
                       node,
                       [](const NodeOfFaces &a, const Index b) { return a.node < b; });
    AssertThrow(found != surface_nodes.end() && found->node == node, ExcInternalError());
    return *found;
  }



  std::array<Surface::Edge, 4>
  Surface::edges(const Face &face)
  {
    // In the order of the bits of Face::outer_edges.
    const unsigned int p = face.degree;
    // Corners in the numbering of the face, xi_1 first: (-1,-1), (1,-1), (-1,1), (1,1).
    const Index c[4] = {face.nodes[0],
                        face.nodes[p],
                        face.nodes[(p + 1) * p],
                        face.nodes[(p + 1) * (p + 1) - 1]};
    const auto  pair = [](const Index a, const Index b) {
      return std::make_pair(std::min(a, b), std::max(a, b));
    };
    return {{pair(c[0], c[2]), pair(c[1], c[3]), pair(c[0], c[1]), pair(c[2], c[3])}};
  }



  Surface::Surface(const Solid                        &solid,
                   const Forest                       &forest,
                   const unsigned int                  body,
                   const std::set<types::boundary_id> &boundaries,
                   const bool                          exact)
    : forest(forest)
    , ids(boundaries)
    , exact(exact)
  {
    mark_outer_edges(collect_faces(solid, body));
    if (solid.has_hanging_nodes())
      exchange_far_faces(solid);
    // No face is added from here on, so pointers to faces stay valid.
    collect_nodes_of_faces();
    collect_owned_nodes(solid);
    set_made_normals();
    measure_faces(solid.communicator);
  }



  namespace
  {
    /** See Face::depth_of_cell. */
    double
    depth_of_cell(const TriaAccessor<dim, dim, dim> &cell, const unsigned int f)
    {
      // Corners are numbered by bits, one for each direction, and so are pairs of faces.
      const unsigned int direction = 1u << f / 2;
      double             least     = std::numeric_limits<double>::max();
      for (unsigned int v = 0; v < GeometryInfo<dim>::vertices_per_face; ++v)
        {
          const unsigned int corner = GeometryInfo<dim>::face_to_cell_vertices(f, v);
          least = std::min(least, cell.vertex(corner).distance(cell.vertex(corner ^ direction)));
        }
      return least;
    }
  } // namespace



  std::vector<Surface::SplitEdge>
  Surface::collect_faces(const Solid &solid, const unsigned int body)
  {
    std::vector<Index>     dofs(solid.fe.n_dofs_per_cell());
    const auto             nodes_of_faces = nodes_on_faces(solid.fe);
    std::vector<SplitEdge> split_edges;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial() || cell->material_id() != body)
          continue;
        for (const unsigned int f : cell->face_indices())
          {
            if (!cell->at_boundary(f) || ids.count(cell->face(f)->boundary_id()) == 0)
              continue;
            cell->get_dof_indices(dofs);
            Face face;
            // Keys are the same on every rank: sums in their order do not depend on the partition.
            face.key           = face_key(cell->id(), f);
            face.degree        = solid.fe.degree;
            face.boundary      = cell->face(f)->boundary_id();
            face.body          = body;
            face.depth_of_cell = depth_of_cell(*cell, f);
            for (const NodeOnFace &on_face : nodes_of_faces[f])
              {
                face.nodes[on_face.m] = dofs[on_face.dof] / dim;
                if (on_face.corner < Face::behind)
                  face.nodes_behind[on_face.corner] = dofs[on_face.behind] / dim;
                face.reference[on_face.m] =
                  solid.mapping.transform_unit_to_real_cell(cell, on_face.unit);
              }
            if (TraceBasis::needed(face, solid.hanging))
              traces.emplace(face.key, TraceBasis(face, solid.hanging));
            (cell->is_locally_owned() ? faces : ghost_faces).push_back(face);

            // A line of the face that is refined on the other side: its halves belong to smaller
            // faces with other nodes, so counting equal edges alone would take it for the end of
            // the surface.
            for (unsigned int l = 0; l < GeometryInfo<2>::lines_per_cell; ++l)
              {
                const auto line = cell->face(f)->line(l);
                if (!line->has_children())
                  continue;
                const auto node = [](const auto &line, const unsigned int v) {
                  return line->vertex_dof_index(v, 0) / dim;
                };
                const Index a = node(line, 0), b = node(line, 1), m = node(line->child(0), 1);
                split_edges.push_back(
                  {{std::min(a, b), std::max(a, b)},
                   {{{std::min(a, m), std::max(a, m)}, {std::min(m, b), std::max(m, b)}}}});
              }
          }
      }
    return split_edges;
  }



  void
  Surface::collect_nodes_of_faces()
  {
    // The order in which normals are summed is that of the keys of faces, so that they have the
    // same bits on any number of ranks.
    std::map<Index, std::vector<std::pair<Face *, unsigned int>>> around;
    for (auto *list : {&faces, &ghost_faces})
      for (Face &face : *list)
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          {
            around[face.nodes[m]].emplace_back(&face, m);
            // Tangents are linear in displacements, on exact surfaces, too: move() adds to these.
            reference_tangents.push_back(
              evaluate(face, exact_surface(face), node_coordinates(face, m)).tangents);
          }
    for (auto &[node, list] : around)
      std::sort(list.begin(), list.end(), [](const auto &a, const auto &b) {
        return a.first->key < b.first->key;
      });
    for (auto &[node, list] : around)
      {
        std::vector<Tensor<1, dim>> as_made;
        for (const auto &[face, m] : list)
          as_made.push_back(
            evaluate(*face, exact_surface(*face), node_coordinates(*face, m)).normal());
        surface_nodes.push_back({node, {}, std::move(list), std::move(as_made)});
      }
  }



  void
  Surface::collect_owned_nodes(const Solid &solid)
  {
    // A map, for ascending order of the nodes. Areas are summed in the order of keys, as normals
    // are.
    std::map<Index, SurfaceNode> found;
    std::vector<const Face *>    in_order;
    for (const auto *list : {&faces, &ghost_faces})
      for (const Face &face : *list)
        in_order.push_back(&face);
    std::sort(in_order.begin(), in_order.end(), [](const Face *a, const Face *b) {
      return a->key < b->key;
    });
    for (const Face *const in_list : in_order)
      {
        const Face  &face  = *in_list;
        auto         areas = whole_areas(face, nullptr, /*reference=*/true);
        const double area  = std::accumulate(areas.begin(), areas.begin() + face.n_nodes(), 0.);
        // The area of a hanging node belongs to those that it follows (doc/theory.md 11).
        const TraceBasis *basis = trace(face);
        if (basis)
          areas = basis->apply(areas);
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          {
            const Index index = basis ? basis->nodes[m] : face.nodes[m];
            if (!solid.owned.is_element(dim * index))
              continue;
            // The area A = int N_s of the reference state, by which forces become tractions
            // (doc/theory.md 1).
            SurfaceNode &node = found[index];
            node.node         = index;
            node.area += areas[m];
            if (index != face.nodes[m])
              continue; // the face does not have the node itself
            node.reference = face.reference[m];
            node.size      = std::max(node.size, std::sqrt(area) / face.degree);
          }
      }
    for (const auto &entry : found)
      nodes.push_back(entry.second);
  }



  std::vector<SurfaceNode>
  Surface::all_nodes() const
  {
    std::vector<SurfaceNode> result;
    for (const NodeOfFaces &of : surface_nodes)
      {
        const auto &[first, m] = of.faces.front();
        SurfaceNode node{of.node, first->reference[m]};
        for (const auto &[face, k] : of.faces)
          {
            const unsigned int last = face->n_nodes() - 1, p = face->degree;
            node.size = std::max({node.size,
                                  face->reference[0].distance(face->reference[last]) / p,
                                  face->reference[p].distance(face->reference[last - p]) / p});
          }
        result.push_back(node);
      }
    return result;
  }



  void
  Surface::measure_faces(const MPI_Comm communicator)
  {
    shortest = std::numeric_limits<double>::max();
    for (const auto *list : {&faces, &ghost_faces})
      for (const Face &face : *list)
        {
          const unsigned int last = face.n_nodes() - 1, p = face.degree;
          // The longest diagonal sets the reach of searches, the shortest side the motion up to
          // which their candidates remain valid; both are the same on all ranks.
          diagonal = std::max({diagonal,
                               face.reference[0].distance(face.reference[last]),
                               face.reference[p].distance(face.reference[last - p])});
          for (const unsigned int corner : {p, last - p})
            for (const unsigned int end : {0u, last})
              shortest = std::min(shortest, face.reference[corner].distance(face.reference[end]));
        }
    diagonal = Utilities::MPI::max(diagonal, communicator);
    shortest = Utilities::MPI::min(shortest, communicator);
  }



  void
  Surface::mark_outer_edges(const std::vector<SplitEdge> &split_edges)
  {
    // An edge of the interior belongs to two faces. Ghost faces count as well, or the border of a
    // rank would be taken for the end of the surface; only owned faces are marked, since the
    // neighbours of ghosts may be unknown.
    std::map<Edge, unsigned int> count;
    for (const auto *list : {&faces, &ghost_faces})
      for (const Face &face : *list)
        for (const Edge &edge : edges(face))
          ++count[edge];
    // A larger face and its two smaller neighbours on one side meet without sharing an edge: their
    // edges are counted for each other.
    for (const auto &[whole, halves] : split_edges)
      for (const Edge &part : halves)
        {
          const auto found = count.find(part);
          if (found == count.end())
            continue;
          ++found->second;
          ++count[whole];
        }
    for (Face &face : faces)
      {
        const auto all = edges(face);
        for (unsigned int e = 0; e < 4; ++e)
          // Nobody shares it: the surface ends there.
          if (count[all[e]] == 1)
            face.outer_edges |= 1u << e;
      }
  }



  namespace
  {
    struct FaceWithTrace
    {
      Face       face;
      TraceBasis basis;
    };
  } // namespace



  void
  Surface::exchange_far_faces(const Solid &solid)
  {
    if (Utilities::MPI::n_mpi_processes(solid.communicator) == 1)
      return;
    // Nodes of other ranks that hanging nodes of this rank's faces follow.
    const auto for_each_foreign = [&](const auto &visit) {
      for (const Face &face : faces)
        if (const TraceBasis *basis = trace(face))
          for (unsigned int m = 0; m < basis->n; ++m)
            if (basis->nodes[m] != face.nodes[m] && !solid.owned.is_element(dim * basis->nodes[m]))
              visit(face, *basis, dim * basis->nodes[m]);
    };
    // Who owns these nodes is not known from the ghost layer: ask (collective).
    IndexSet foreign(solid.owned.size());
    for_each_foreign(
      [&](const Face &, const TraceBasis &, const Index dof) { foreign.add_index(dof); });
    const std::vector<unsigned int> owners =
      Utilities::MPI::compute_index_owner(solid.owned, foreign, solid.communicator);

    std::map<unsigned int, std::vector<FaceWithTrace>> messages;
    std::set<std::pair<unsigned int, std::uint64_t>>   sent;
    for_each_foreign([&](const Face &face, const TraceBasis &basis, const Index dof) {
      const unsigned int rank = owners[foreign.index_within_set(dof)];
      // Once to each rank, however many of its nodes the face has.
      if (sent.emplace(rank, face.key).second)
        messages[rank].push_back({face, basis});
    });

    std::set<std::uint64_t> known;
    for (const Face &face : ghost_faces)
      known.insert(face.key);
    for (const auto &[rank, received] : exchange_records(messages, solid.communicator))
      for (const FaceWithTrace &record : received)
        {
          // This rank may know the face as a ghost, but not all nodes that its hanging nodes
          // follow.
          traces[record.face.key] = record.basis;
          if (!known.insert(record.face.key).second)
            continue;
          ghost_faces.push_back(record.face);
          for (unsigned int m = 0; m < record.face.n_nodes(); ++m)
            for (unsigned int d = 0; d < dim; ++d)
              // Positions of these nodes are needed in each iteration: their dofs become further
              // ghosts of displacement vectors.
              far.push_back(dim * record.face.nodes[m] + d);
        }
  }



  const AnalyticSurface *
  Surface::exact_surface(const Face &face) const
  {
    return exact ? forest.surface(face.boundary).get() : nullptr;
  }



  Point<dim>
  Surface::position(const SurfaceNode &node, const Vector &u) const
  {
    Point<dim> x = node.reference;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] += u(dim * node.node + d);
    return x;
  }
} // namespace Touchstone
