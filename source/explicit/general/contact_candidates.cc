// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/explicit/general/contact_candidates.h>

#include <algorithm>
#include <map>

// The pairs that general contact looks at in each cycle until motion asks for others
// (doc/general_contact.md, sections 2 and 5). Which pairs there are depends on positions alone; on
// which rank they are depends on the regions of the ranks, and does not matter to results.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    template <std::size_t n>
    BoundingBox<dim>
    box_of(const std::array<Point<dim>, n> &points, const double grown)
    {
      BoundingBox<dim> box(points);
      box.extend(grown);
      return box;
    }



    /** The corners of a box, which are read where they are. */
    struct Corners
    {
      Point<dim> lower, upper;

      explicit Corners(const BoundingBox<dim> &box)
        : lower(box.get_boundary_points().first)
        , upper(box.get_boundary_points().second)
      {
      }
    };



    bool
    overlap(const Corners &a, const Corners &b)
    {
      bool apart = false;
      for (unsigned int d = 0; d < dim; ++d)
        apart |= (a.upper[d] < b.lower[d]) | (b.upper[d] < a.lower[d]);
      return !apart;
    }



    /** The lower corner of what two boxes have in common. */
    Point<dim>
    lower_corner(const Corners &a, const Corners &b)
    {
      Point<dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = std::max(a.lower[d], b.lower[d]);
      return result;
    }



    /** An edge by the keys of its ends, in ascending order. */
    using EdgeKey = std::pair<std::uint64_t, std::uint64_t>;

    bool
    of_one_cell(const EdgeKey &edge, const ImpactFace &face)
    {
      return face.of_cell(edge.first) && face.of_cell(edge.second);
    }



    /** Boxes of faces, which the search wants as well, and by slot of nodes and edges. */
    struct GrownBoxes
    {
      std::vector<BoundingBox<dim>> of_faces;
      std::vector<Corners>          faces, nodes, edges;

      template <class Faces>
      GrownBoxes(const Faces &all, const double grown)
      {
        for (const auto &moving : all)
          {
            of_faces.push_back(moving.box(grown));
            faces.emplace_back(of_faces.back());
            for (unsigned int a = 0; a < 4; ++a)
              {
                nodes.emplace_back(moving.box(a, grown));
                edges.emplace_back(moving.edge_box(a, grown));
              }
          }
      }
    };
  } // namespace



  BoundingBox<dim>
  ContactCandidates::MovingFace::box(const double grown) const
  {
    return box_of<8>({{from[0], from[1], from[2], from[3], to[0], to[1], to[2], to[3]}}, grown);
  }



  BoundingBox<dim>
  ContactCandidates::MovingFace::box(const unsigned int corner, const double grown) const
  {
    return box_of<2>({{from[corner], to[corner]}}, grown);
  }



  BoundingBox<dim>
  ContactCandidates::MovingFace::edge_box(const unsigned int corner, const double grown) const
  {
    const unsigned int end = (corner + 1) % 4;
    return box_of<4>({{from[corner], to[corner], from[end], to[end]}}, grown);
  }



  ContactCandidates::ContactCandidates(const ImpactSurface &surface,
                                       const NodeMap       &nodes,
                                       const IndexSet      &owned_dofs,
                                       const std::string   &search)
    : at_slots(nodes.communicator())
    , surface(surface)
    , nodes(nodes)
    , owned(owned_dofs)
    , broad_phase(Registry<BroadPhase>::make(search))
    , partition(nodes.communicator())
  {
  }



  void
  ContactCandidates::begin_interval()
  {
    work = CandidateCounts();
    partition.forget();
  }



  void
  ContactCandidates::find(const NodeField &u,
                          const NodeField &v,
                          const double     step,
                          const double     margin,
                          const bool       neighbours_as_well)
  {
    ++work.searches;
    const std::vector<MovingFace> all = exchange_faces(u, v, step, margin);
    find_pairs(all, margin, neighbours_as_well);
    const std::uint64_t n_inner =
      std::count_if(face_pairs.begin(), face_pairs.end(), [](const FacePair &pair) {
        return pair.inner[of_both];
      });
    work.candidates =
      Utilities::MPI::sum<std::uint64_t>(node_faces.size() + edge_pairs.size() + n_inner,
                                         nodes.communicator());
    keep_used_faces(all);
    sort_by_faces();
  }



  // Each face goes to all ranks in whose regions it may have candidates: a pair of a node and a
  // face is where the lower corner of the node's box is, so that all faces of a node are together,
  // and other pairs are where the lower corner of what their boxes share is.
  std::vector<ContactCandidates::MovingFace>
  ContactCandidates::exchange_faces(const NodeField &u,
                                    const NodeField &v,
                                    const double     step,
                                    const double     margin)
  {
    std::vector<MovingFace> own;
    std::vector<Point<dim>> centres;
    double                  fastest = 0.;
    for (const ImpactFace &face : surface.faces())
      {
        MovingFace moving;
        moving.face = face;
        Point<dim> centre;
        for (unsigned int a = 0; a < 4; ++a)
          {
            const unsigned int node = nodes.local(face.dofs[a]);
            moving.from[a]          = surface.position(node, u);
            moving.to[a]            = moving.from[a] + step * v[node];
            centre += 0.25 * moving.from[a];
            for (unsigned int d = 0; d < dim; ++d)
              fastest = std::max(fastest, std::abs(step * v[node][d]));
          }
        own.push_back(moving);
        centres.push_back(centre);
      }
    work.imbalance = std::max(work.imbalance, partition.balance(centres));
    // The lower corner of the box of a node lies so far from its other points.
    farthest = Utilities::MPI::max(fastest, nodes.communicator()) + 2. * margin;
    std::map<unsigned int, std::vector<MovingFace>> messages;
    for (const MovingFace &moving : own)
      partition.for_each_owner(moving.box(farthest),
                               [&](const unsigned int rank) { messages[rank].push_back(moving); });
    const unsigned int me      = Utilities::MPI::this_mpi_process(nodes.communicator());
    std::uint64_t      sent[2] = {0, 0};
    for (const auto &[rank, faces_to] : messages)
      if (rank != me)
        {
          sent[0] += faces_to.size();
          ++sent[1];
        }
    std::vector<MovingFace> all;
    for (const auto &[rank, faces_from] : exchange_records(messages, nodes.communicator()))
      all.insert(all.end(), faces_from.begin(), faces_from.end());
    std::sort(all.begin(), all.end(), [](const MovingFace &a, const MovingFace &b) {
      return a.face.key < b.face.key;
    });
    Utilities::MPI::sum(sent, nodes.communicator(), sent);
    work.faces_sent += sent[0];
    work.messages += sent[1];
    return all;
  }



  // An edge and the inner edges of a face are where the lower corner of what their boxes share is,
  // as two edges are: so all pairs of faces that have the edge find them on the same rank.
  void
  ContactCandidates::find_pairs(const std::vector<MovingFace> &all,
                                const double                   margin,
                                const bool                     neighbours_as_well)
  {
    node_faces.clear();
    edge_pairs.clear();
    inner_edges.clear();
    face_pairs.clear();
    const unsigned int me = Utilities::MPI::this_mpi_process(nodes.communicator());
    const GrownBoxes   boxes(all, 0.5 * margin);
    const auto mine     = [&](const Point<dim> &corner) { return partition.owner(corner) == me; };
    const auto add_node = [&](const std::size_t slot, const unsigned int f) {
      if (overlap(boxes.nodes[slot], boxes.faces[f]) && !all[f].face.of_cell(slot_key(all, slot)) &&
          mine(boxes.nodes[slot].lower))
        node_faces.push_back({slot, f, unsigned(face_pairs.size())});
    };
    const auto add_edges = [&](const std::size_t one, const std::size_t other) {
      const Corners &p = boxes.edges[one], &q = boxes.edges[other];
      if (!overlap(p, q))
        return;
      const EdgeKey k = edge_key(all, one), l = edge_key(all, other);
      if (k.first == l.first || k.first == l.second || k.second == l.first ||
          k.second == l.second || of_one_cell(k, all[other / 4].face) ||
          of_one_cell(l, all[one / 4].face))
        return;
      if (mine(lower_corner(p, q)))
        edge_pairs.push_back(
          {k < l ? one : other, k < l ? other : one, unsigned(face_pairs.size())});
    };
    const auto add_inner =
      [&](const std::size_t edge, const unsigned int f, const unsigned int bit) {
        if (overlap(boxes.edges[edge], boxes.faces[f]) &&
            mine(lower_corner(boxes.edges[edge], boxes.faces[f])))
          inner_edges.push_back({edge, f, unsigned(face_pairs.size()), bit});
      };
    const auto n = [&] { return node_faces.size() + edge_pairs.size() + inner_edges.size(); };
    for (const auto &[i, j] : broad_phase->find(boxes.of_faces))
      {
        const ImpactFace &a = all[i].face, &b = all[j].face;
        if (!surface.may_meet(a.boundary, b.boundary))
          continue;
        const std::size_t before = n(), first = 4 * std::size_t(i), other = 4 * std::size_t(j);
        FacePair          pair{i, j, a.shares_node(b), {}};
        // Inner edges of neighbours meet nothing of each other before the faces have folded.
        const bool inner = (neighbours_as_well || !pair.share_node) && a.key >> 3 != b.key >> 3;
        for (unsigned int c = 0; c < 4; ++c)
          {
            add_node(first + c, j);
            add_node(other + c, i);
            for (unsigned int d = 0; d < 4; ++d)
              add_edges(first + c, other + d);
            if (inner)
              {
                add_inner(first + c, j, c);
                add_inner(other + c, i, 4 + c);
              }
          }
        pair.inner[of_both] = inner && mine(lower_corner(boxes.faces[i], boxes.faces[j]));
        if (pair.inner.any() || n() > before)
          face_pairs.push_back(pair);
      }
    keep_each_once(all);
    for (const InnerEdge &pair : inner_edges)
      face_pairs[pair.of_faces].inner.set(pair.bit);
  }
} // namespace Touchstone
