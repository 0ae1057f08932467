// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_nodes_on_edges_h
#define touchstone_contact_pairing_nodes_on_edges_h

#include <touchstone/contact/pairing/edges_under_nodes.h>
#include <touchstone/contact/pairing/pairing.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief Gives slave nodes that stand on a parallel edge of the master the row of EdgeOnEdge, in
   * place of that which a pairing has made of them: averages over the faces beside an edge do not
   * have its direction (doc/theory.md 4.2, "Parallel edges").
   */
  class NodesOnEdges
  {
  public:
    /** @brief Collective. @param beyond_edge What holds nodes on edges of faces that they fit on.
     */
    NodesOnEdges(const PairingInput &input, BeyondEdge beyond_edge);

    /** @brief A step ends with the displacement @p u, with ghosts. */
    void
    commit(const Vector &u);

    /** @brief Replace rows of nodes. @param rows Those of the owned slave nodes come first.
     * Collective. */
    void
    update(const Vector &u, std::vector<ContactRow> &rows);

    /** @brief Whether the row of a node has been replaced. */
    bool
    replaces(const std::size_t k) const
    {
      return edges[k].has_value();
    }

    /** @brief Whether the row of any node of this rank has been replaced. */
    bool
    replaces_any() const
    {
      return edges.any();
    }

    /** @brief No rank has replaced a row: free the memory of the faces, which are large, until the
     * next update. */
    void
    forget()
    {
      search.forget();
    }

    /** @brief Which of the nodes stay on their edges in a step. */
    EdgesUnderNodes &
    decisions()
    {
      return edges;
    }
    const EdgesUnderNodes &
    decisions() const
    {
      return edges;
    }

    /** @brief The derivatives of the replaced rows that are active. Collective. */
    void
    differentiate(std::vector<ContactRow> &rows);

    SearchWork
    work() const
    {
      return search.work();
    }

  private:
    const PairingInput input;
    Search             search;
    const BeyondEdge   beyond_edge;
    /** Positions of the slave nodes at the start of the step. */
    std::vector<dealii::Point<dim>> start;
    /** What the nodes stand on since the last update. */
    EdgesUnderNodes edges;
  };
} // namespace Touchstone

#endif
