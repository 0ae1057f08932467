// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_aggregated_rows_h
#define touchstone_contact_pairing_aggregated_rows_h

#include <touchstone/contact/pairing/pairing.h>

#include <array>
#include <map>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Rows of single nodes where some nodes leave their part of faces to the others
   * (Surface::set_without_rows()): equation (5) of doc/theory.md 3.1 with nodal areas,
   *
   *   r_k + sum_i (D_ki / A_k) r_i = 0 ,   D_ki = sum over faces of a_i a_k / sum of a_l ,
   *
   * r the gap vector of a node to its own closest point, a_i the area of a node on a face, l over
   * the nodes of the face that have rows.
   *
   * So uniform pressures remain exact. Averaged pairings do the same to the basis functions of
   * their integrals.
   */
  class AggregatedRows
  {
  public:
    /** @brief Collective. */
    explicit AggregatedRows(const PairingInput &input);

    /** @brief Take the rows of nodes without rows away and add their parts to the others.
     * @param rows Of all slave nodes of this rank, as a pairing of single nodes has set them.
     * Collective. */
    void
    aggregate(std::vector<ContactRow> &rows);

    /** @brief Add the parts to derivatives, with the stencil of what is added as it is. */
    void
    differentiate(std::vector<ContactRow> &rows) const;

  private:
    /** A face with nodes that have no rows, by the functions of its continuous basis. */
    struct FaceOfNodes
    {
      unsigned int                        n;
      std::array<Index, Face::max_nodes>  nodes;
      std::array<bool, Face::max_nodes>   without_row;
      std::array<double, Face::max_nodes> areas;
    };

    /** What the owner of a node says of the row that it would have. */
    struct RowOfNode
    {
      bool                   has_partner;
      unsigned int           n_entries;
      dealii::Tensor<1, dim> normal, gap_vector;
      dealii::Point<dim>     position;
    };

    /** D_ki / A_k of a node i, and what it faces. */
    struct Part
    {
      double           ratio = 0.;
      const RowOfNode *row   = nullptr;
      Stencil          stencil;
    };

    const PairingInput           input;
    std::vector<FaceOfNodes>     faces;
    std::map<Index, std::size_t> rows_of_nodes;
    std::map<Index, RowOfNode>   known;
    /** By row and node. */
    std::map<std::size_t, std::map<Index, Part>> parts;
    bool                                         anywhere;

    void
    ask_for_rows(const std::vector<ContactRow> &rows);
    /** Set the ratios of `parts`. @return Areas that owned nodes leave to others, by row. */
    std::map<std::size_t, double>
    divide_areas();
    void
    ask_for_stencils(const std::vector<ContactRow> &rows);
    static void
    add(const std::map<Index, Part> &parts, ContactRow &row);
  };
} // namespace Touchstone

#endif
