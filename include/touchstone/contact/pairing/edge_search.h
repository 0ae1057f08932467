// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_edge_search_h
#define touchstone_contact_pairing_edge_search_h

#include <touchstone/contact/pairing/contact_between_nodes.h>
#include <touchstone/contact/pairing/edge_contact.h>
#include <touchstone/contact/pairing/pairing.h>
#include <touchstone/contact/search/face_exchange.h>

#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief What touches, or nearly touches, between slave nodes. */
  struct FoundBetweenNodes
  {
    std::shared_ptr<const ContactBetweenNodes> contact;
    /** The slave nodes of the edge or face, with their weights at the point, first the one that is
     * to have the row. */
    std::vector<std::pair<Index, double>> nodes;
    /** A vertex in a slave face; otherwise two edges. */
    bool of_vertex = false;
    /** By how much the point lies beyond the end of an edge, twice, length: of two edges that bend
     * at a node the one counts that has the point. */
    double beyond = 0.;
    /** The step began with a row for the same edge or vertex in contact. */
    bool held = false;
    /** The surfaces had passed through each other there when the step began already: the two sides
     * of a thin body, unless the row is held. */
    bool before = false;
    /** Where they touch, on the slave and on the master. */
    std::array<dealii::Point<dim>, 2> feet;
    /** An order that does not depend on the numbers of nodes, for what is equally close. */
    std::array<std::uint64_t, 2> order;
  };

  /** @brief Finds edges of the slave surface that cross edges of the master, and vertices of the
   * master that face the inside of slave faces (doc/theory.md 4.2). */
  class EdgeSearch
  {
  public:
    explicit EdgeSearch(const PairingInput &input);

    /** @brief A step ends with the displacement @p u (with ghosts), null for the reference state.
     */
    void
    commit(const Vector *u);

    /** @brief Tell what rows are in contact when a step begins. Collective.
     * @param keys Of slave nodes of this rank, the master keys of their rows between nodes. */
    void
    hold(const std::vector<std::pair<Index, std::uint64_t>> &keys);

    /** @brief All that is found at the slave nodes of this rank, in the present position of the
     * surfaces: on each rank that owns one of the nodes. What it returns refers to faces that
     * are kept until the next call. Collective. */
    std::vector<FoundBetweenNodes>
    find(const Vector &u);

    /** @brief Of slave faces, see ContactBetweenNodes::face(). Collective. */
    std::unordered_map<const Face *, std::vector<NormalDerivative>>
    normal_derivatives(const std::vector<const Face *> &needed) const
    {
      return slave_exchange.normal_derivatives(needed);
    }

    SearchWork
    work() const
    {
      SearchWork result = slave_exchange.work();
      result += exchange.work();
      return result;
    }

  private:
    const Solid   &solid;
    const Surface &slave;
    /** Slave and master faces around the slave nodes of this rank. */
    FaceExchange slave_exchange, exchange;
    /** What hold() was told, by slave node, with ghosts. */
    Vector held;
    /** Positions of their nodes at the start of the step. */
    std::unordered_map<Index, dealii::Point<dim>> start;
    /** Master faces around each of their nodes, with its number there. */
    std::unordered_map<Index, std::vector<std::pair<const Face *, unsigned int>>> around;

    void
    exchange_faces(const Vector &u);
    void
    find_edges(std::vector<FoundBetweenNodes> &found) const;
    void
    add_crossing(const EdgeOfLine               &edge,
                 const EdgeOfLine               &other,
                 std::vector<FoundBetweenNodes> &found) const;
    void
    find_vertices(std::vector<FoundBetweenNodes> &found) const;
    /** A vertex faces the closest of the slave faces near it. @param near Their indices. */
    void
    add_vertex(Index                           vertex,
               const std::vector<std::size_t> &near,
               std::vector<FoundBetweenNodes> &found) const;
    FoundBetweenNodes
    vertex_in_face(Index vertex, const Face &face, const std::array<double, 2> &xi) const;
    /** Whether the master is farthest towards a slave face in a node, among those around, and none
     * of its faces there lies along the slave face, whose outward normal is @p normal.
     * @param before At the start of the step, instead of now. */
    bool
    touches_in(Index vertex, const dealii::Tensor<1, dim> &normal, bool before) const;
    /** Of the nodes of an edge or face the one that is to have the row: that which had it when the
     * step began, or had the largest weight then.
     * @param key     Of the edge or vertex of the master.
     * @param weights Of its point now. @param before Of the same point at the start of the step. */
    unsigned int
    node_of_row(const std::vector<Index>  &nodes,
                std::uint64_t              key,
                const std::vector<double> &weights,
                const std::vector<double> &before) const;
    bool
    is_held(Index node, std::uint64_t key) const;
    bool
    owned(const std::vector<Index> &nodes) const;
  };
} // namespace Touchstone

#endif
