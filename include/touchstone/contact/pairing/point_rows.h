// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_point_rows_h
#define touchstone_contact_pairing_point_rows_h

#include <touchstone/contact/pairing/material_point.h>
#include <touchstone/contact/pairing/pairing.h>

#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Rows of material points inside slave faces, which the master enters between nodes that
   * touch nothing (doc/theory.md 4.2): each is the row of a node at that place, with the weights of
   * the nodes of the face in its stencil.
   *
   * They are written into the rows between nodes of a pair, one for each slave node, in place of
   * edges and vertices that were open when the point was chosen.
   */
  class PointRows
  {
  public:
    /** @param input Of the pairing of the nodes.
     * @param with_edges Rows between nodes have been written for edges and vertices before. */
    PointRows(const PairingInput &input, bool with_edges);

    /** @brief The points of the pair from now on, the same on all ranks. */
    void
    set(const std::vector<MaterialPoint> &points);

    /** @brief Those of set(). */
    const std::vector<MaterialPoint> &
    points() const
    {
      return all;
    }

    /** @brief Rows of points that have been withdrawn were not active as those of an edge or
     * vertex: comes before the update of the pairing of the nodes. */
    void
    release(std::vector<ContactRow> &rows);

    /** @brief Write the rows between nodes, in the present position of the surfaces; the others
     * are there. @param of_nodes The pairing of the nodes. Collective. */
    void
    update(const Pairing &of_nodes, double time, std::vector<ContactRow> &rows);

    /** @brief Set the derivatives of those that were active, after update(). Collective. */
    void
    differentiate(const Pairing &of_nodes, double time, std::vector<ContactRow> &rows) const;

  private:
    const PairingInput input;
    const bool         with_edges;
    /** Of slave nodes that this rank owns: their number. */
    std::unordered_map<Index, std::size_t> numbers;
    std::vector<MaterialPoint>             all;
    /** Of a master body, made with the first point. */
    std::optional<Search> search;

    /** A point whose row this rank has. */
    struct OwnPoint
    {
      const MaterialPoint *point;
      /** The faces that it is on, several if it lies on an edge, and where. */
      Surface::PointOnFaces places;
      /** Of the row among those of the pair. */
      std::size_t row;
      /** See ContactRow::tangents. */
      std::shared_ptr<const std::array<Stencil, 2>> tangents;
      /** It has a partner. */
      bool                          present = false;
      dealii::Point<dim>            x{};
      std::optional<ContactPartner> partner{};
    };
    std::vector<OwnPoint> own;
    /** Rows of earlier points, see release(). */
    std::vector<std::size_t> released;

    /** All faces that a point is on, in the order of their keys. */
    Surface::PointOnFaces
    places_of(const MaterialPoint &point) const;
    /** Where a point is, and the normal there: the means over its faces. */
    std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>
    position(const OwnPoint &point) const;
    /** Write the row of a point from that of a node at its place. */
    static void
    set_row(const OwnPoint &point, const ContactRow &there, ContactRow &row);
    /** The same with derivatives: those of @p there name the point as node invalid_index. */
    static std::shared_ptr<const RowDerivative>
    derivative_of_row(const MaterialPoint &point, const ContactRow &there);
    /** The row of a node at the place of the point. */
    ContactRow
    row_there(const OwnPoint &point, const Pairing &of_nodes, double time) const;
  };
} // namespace Touchstone

#endif
