// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_edges_under_nodes_h
#define touchstone_contact_pairing_edges_under_nodes_h

#include <touchstone/contact/pairing/edge_on_edge.h>
#include <touchstone/contact/pairing/pairing.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The edges of the master that slave nodes stand on, and which nodes stay on theirs: a
   * decision about the step, not about its iterates (doc/theory.md 4.2, "Parallel edges").
   *
   * An iterate may carry a node far along its edge or aside of it, to where it would take the row
   * of a face or none, and the result would be that of this iterate. So a node that stands on an
   * edge when the step begins keeps the row of the edge, until a state of balance shows that it has
   * left: the step is then solved again without it (leave()).
   */
  class EdgesUnderNodes
  {
  public:
    explicit EdgesUnderNodes(const PairingInput &input);

    /** @brief Look for the edge under a node in the present update of the search.
     * @param k    Number of the node among the owned slave nodes.
     * @param size Of its faces, length.
     * @param beyond_edge What holds it on an edge of faces that it fits on. @return Whether there
     * is one. */
    bool
    find(std::size_t       k,
         const Search     &search,
         const SlavePoint &point,
         double            size,
         BeyondEdge        beyond_edge);

    /** @brief The node @p k stands on none in this update. */
    void
    clear(const std::size_t k)
    {
      edges[k].reset();
    }

    /** @brief All nodes have been looked at, or cleared. Collective.
     * @param u Displacement with ghosts.
     * @return Whether it must be done again, on all ranks alike: in the first update nodes were
     * taken for overlaps that are on the other side of a thin body. */
    bool
    end_update(const Vector &u);

    /** @brief What node @p k stands on since the last update. */
    const std::optional<EdgeOnEdge> &
    operator[](const std::size_t k) const
    {
      return edges[k];
    }

    std::size_t
    size() const
    {
      return edges.size();
    }

    /** @brief Whether a node of this rank stands on an edge since the last update. */
    bool
    any() const
    {
      return std::any_of(edges.begin(), edges.end(), [](const auto &edge) {
        return edge.has_value();
      });
    }

    /** @brief A step ends with the last update. */
    void
    commit();

    /** @brief A step begins or is tried again: all nodes that stood on edges stay. */
    void
    begin_step();

    /** @brief The last update was in a state of balance: nodes that have left their edges in it are
     * free for the rest of the step. @return Whether there is one on this rank. */
    bool
    leave();

    /** @brief Keys for PairingMemory::of_rows. @param of_rows At least one entry for each node. */
    void
    save(std::vector<std::optional<std::uint64_t>> &of_rows) const;

    /** @brief Restore what save() has set, and remove it from @p of_rows. */
    void
    load(std::vector<std::optional<std::uint64_t>> &of_rows);

  private:
    const PairingInput input;
    const Surface     &slave;
    /** Since the last update. */
    std::vector<std::optional<EdgeOnEdge>> edges;
    /** Nodes that stood on an edge when the step began, and those that have left it since. */
    std::vector<bool> stood, has_left;
    /** Nodes that were in contact when the step began, which the first update of the step tells. */
    std::vector<bool> touched;
    bool              first_of_step = true;
    /** Nodes that may lie deep behind an edge since the bodies overlap as the run begins; within
     * the first update all that have not been found to lie elsewhere. */
    std::vector<bool> overlaps;
    /** Whether `stood` has been set. */
    bool started = false;
  };
} // namespace Touchstone

#endif
