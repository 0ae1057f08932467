// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_contact_candidates_h
#define touchstone_explicit_general_contact_candidates_h

#include <touchstone/collision/broad_phase.h>
#include <touchstone/explicit/general/contact_partition.h>
#include <touchstone/explicit/general/impact_surface.h>
#include <touchstone/explicit/impulse_work.h>
#include <touchstone/explicit/row_nodes.h>

#include <algorithm>
#include <bitset>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The pairs of nodes and faces, and of edges, that can meet before anything has moved by
   * more than a margin, on the rank in whose region they are (doc/general_contact.md, sections 2
   * and 5).
   *
   * Corner a of face f is called by its slot 4 f + a, and so is the edge from there to the next
   * corner.
   */
  class ContactCandidates
  {
  public:
    /** @param search Name of a BroadPhase. @param surface, nodes Must live as long. */
    ContactCandidates(const ImpactSurface    &surface,
                      const NodeMap          &nodes,
                      const dealii::IndexSet &owned_dofs,
                      const std::string      &search);

    /** @brief Count from here, and divide space anew in the next search: by the state of then
     * alone. */
    void
    begin_interval();

    /**
     * @brief Find them. Collective.
     * @param u,v    Displacement and velocity of local nodes, which move by @p step times @p v.
     * @param margin By so much two nodes may move otherwise, along each axis and relative to each
     *               other; length.
     * @param neighbours_as_well Inner edges of faces that share a node are candidates, too.
     */
    void
    find(const NodeField &u,
         const NodeField &v,
         double           step,
         double           margin,
         bool             neighbours_as_well = false);

    /** Pairs by slots, each sorted by keys: a node and a face; two edges; and an edge and a face
     * that it may meet inner edges of. Each belongs to one of #face_pairs. */
    struct NodeFace
    {
      std::size_t  node;
      unsigned int face, of_faces;
    };
    struct EdgePair
    {
      std::size_t  one, other;
      unsigned int of_faces;
    };
    /** Two faces that pairs of nodes and edges belong to, or whose inner edges, from corners to the
     * middle, may meet what the other has. */
    struct FacePair
    {
      unsigned int one, other;
      bool         share_node;
      /** What belongs to the pair of that: edge a of the first face with inner edges of the other
       * (bit a), edge a of the other with those of the first (bit 4 + a), inner edges of both and
       * their middles (#of_both). An edge of two faces belongs to one pair, on one rank. */
      std::bitset<9> inner;
    };
    static constexpr unsigned int of_both = 8;
    struct InnerEdge
    {
      std::size_t  edge;
      unsigned int face, of_faces, bit;
    };
    std::vector<NodeFace>  node_faces;
    std::vector<EdgePair>  edge_pairs;
    std::vector<InnerEdge> inner_edges;
    std::vector<FacePair>  face_pairs;
    /** Numbers of #node_faces and of #edge_pairs by the pair of faces that they belong to, and
     * where those of each begin. */
    struct ByFaces
    {
      std::vector<unsigned int> begin, numbers;
    };
    ByFaces nodes_by_faces, edges_by_faces;
    /** Their faces. */
    std::vector<ImpactFace> faces;
    /** The nodes of all slots. */
    RowNodes at_slots;

    /** @brief The next corner of a face: the other end of an edge. */
    static std::size_t
    next(const std::size_t slot)
    {
      return slot % 4 == 3 ? slot - 3 : slot + 1;
    }
    std::uint64_t
    key(const std::size_t slot) const
    {
      return faces[slot / 4].nodes[slot % 4];
    }
    Index
    dof(const std::size_t slot) const
    {
      return faces[slot / 4].dofs[slot % 4];
    }

    /** @brief There are candidates on any rank. */
    bool
    any() const
    {
      return work.candidates > 0;
    }
    const CandidateCounts &
    counts() const
    {
      return work;
    }

    const ContactPartition &
    regions() const
    {
      return partition;
    }
    /** @brief Candidates of a point are in regions that are no farther from it, length. */
    double
    reach() const
    {
      return farthest;
    }
    /** @brief The first of #node_faces with the node of this key; or node_faces.size(). */
    std::size_t
    find_node(std::uint64_t of) const;
    /** @brief The number of a pair of edges by the keys of their ends, ascending in each; or
     * edge_pairs.size(). */
    std::size_t
    find_edges(const std::array<std::uint64_t, 4> &keys) const;

  private:
    /** A face with the present positions of its corners, and those at the end of a cycle. */
    struct MovingFace
    {
      ImpactFace                        face;
      std::array<dealii::Point<dim>, 4> from, to;

      dealii::BoundingBox<dim>
      box(double grown) const;
      dealii::BoundingBox<dim>
      box(unsigned int corner, double grown) const;
      dealii::BoundingBox<dim>
      edge_box(unsigned int corner, double grown) const;
    };

    const ImpactSurface        &surface;
    const NodeMap              &nodes;
    const dealii::IndexSet      owned;
    std::shared_ptr<BroadPhase> broad_phase;
    ContactPartition            partition;
    CandidateCounts             work;
    double                      farthest = 0.;

    /** Key of the node of a slot of @p all, and those of the ends of its edge, in ascending order.
     */
    static std::uint64_t
    slot_key(const std::vector<MovingFace> &all, const std::size_t slot)
    {
      return all[slot / 4].face.nodes[slot % 4];
    }
    static std::pair<std::uint64_t, std::uint64_t>
    edge_key(const std::vector<MovingFace> &all, const std::size_t slot)
    {
      return std::minmax({slot_key(all, slot), slot_key(all, next(slot))});
    }

    std::vector<MovingFace>
    exchange_faces(const NodeField &u, const NodeField &v, double step, double margin);
    void
    find_pairs(const std::vector<MovingFace> &all, double margin, bool neighbours_as_well);
    /** Nodes and edges belong to several faces: each pair of @p all once, by keys. */
    void
    keep_each_once(const std::vector<MovingFace> &all);
    void
    keep_used_faces(const std::vector<MovingFace> &all);
    void
    sort_by_faces();
  };
} // namespace Touchstone

#endif
