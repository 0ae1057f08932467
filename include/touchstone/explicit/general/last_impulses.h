// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_last_impulses_h
#define touchstone_explicit_general_last_impulses_h

#include <touchstone/explicit/general/surface_row.h>

#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The impulses of the cycle before in general contact: with them the sweeps of the next
   * one start, and where they were surfaces probably touch again (doc/general_contact.md, section
   * 3).
   *
   * Rows are called by their numbers, which hold as long as candidates do; where there are new
   * candidates, what is known of rows and nodes is taken to the ranks that have them now.
   */
  class LastImpulses
  {
  public:
    /** @param candidates, surface Must live as long. */
    LastImpulses(const ContactCandidates &candidates,
                 const MovingSurface     &surface,
                 MPI_Comm                 communicator);

    /** @brief Nothing is known of any cycle, and there are no rows. */
    void
    begin_interval();

    /** @brief A cycle begins. */
    void
    begin_cycle()
    {
      ++cycles;
    }

    /** @brief There were no impulses in the last cycle. */
    void
    forget();

    /** @name Rows */
    /** @{ */
    /** @brief There are no rows. */
    void
    clear_rows()
    {
      of_rows.clear();
    }
    /** @brief There is one more. */
    void
    add_row()
    {
      of_rows.emplace_back();
    }
    /** @brief The present cycle has ended with this impulse, after forget(). @param k Number of the
     * row. */
    void
    keep(std::size_t k, const SurfaceRow &row, const dealii::Tensor<1, dim> &impulse, bool slides);
    /** @brief The impulse of a row in the cycle before. */
    dealii::Tensor<1, dim>
    impulse(std::size_t k, const RowKey &key) const;
    /** @brief Whether its slave was sliding. */
    bool
    slides(const RowKey &key) const
    {
      return !sliding.empty() && sliding.count(slave_of(key)) > 0;
    }
    /** @} */

    /** @name Nodes and edges */
    /** @{ */
    /** @brief The node has pressed on a face in the cycle before. */
    bool
    pressed(const std::size_t slot) const
    {
      return pressed_nodes[candidates.at_slots.node(slot)] == epoch;
    }
    /** @brief It has done so not long ago, and will probably do so again. */
    bool
    presses_often(std::size_t slot) const;
    /** @brief Pairs of edges that pressed in the cycle before. */
    const std::vector<std::size_t> &
    edges() const
    {
      return pressed_edges;
    }
    /** @brief Add what has pressed to the nodes and faces of the cycle that begins. */
    void
    add_nodes_to(MovingSurface &cycle, const std::vector<SurfaceRow> &rows);
    /** @} */

    /** @name New candidates */
    /** @{ */
    /** @brief The impulse of a row on its way to the rank that has its candidates now. */
    struct OfRow
    {
      RowKey                 key;
      dealii::Tensor<1, dim> impulse;
      bool                   sliding = false;
      /** Around the slave side, of edges around both. */
      dealii::Point<dim> lower, upper;
    };
    /** @brief A node that presses often, and the cycle in which it did so last. */
    struct OfNode
    {
      std::uint64_t      key, cycle;
      dealii::Point<dim> lower, upper;
    };
    struct Carried
    {
      std::vector<OfRow>  rows;
      std::vector<OfNode> nodes;
    };
    /** @brief All that is known, where the cycle has taken it. */
    Carried
    carried(const std::vector<SurfaceRow> &rows) const;
    /** @brief There are new candidates, and no rows: what was carried() is known to the ranks that
     * have them. Collective. */
    void
    carry_over(const Carried &last);
    /** @brief There are new candidates, of which nothing is known. */
    void
    reinit();
    /** @} */

  private:
    const ContactCandidates &candidates;
    const MovingSurface     &surface;
    const MPI_Comm           communicator;

    /** By row its impulse in the cycle before, if that had this number; which goes up whenever
     * impulses are forgotten. */
    struct Impulse
    {
      dealii::Tensor<1, dim> impulse;
      bool                   sliding = false;
      std::uint64_t          epoch   = 0;
    };
    std::vector<Impulse> of_rows;
    std::uint64_t        epoch = 1;
    /** Those that have come from other ranks, or belong to rows that are not there. */
    std::map<RowKey, OfRow> arrived;
    /** Slaves that slide in the cycle before; by node of the candidates the #epoch in which it
     * pressed on a face; and pairs of edges that pressed. */
    std::set<RowKey>           sliding;
    std::vector<std::uint64_t> pressed_nodes;
    std::vector<std::size_t>   pressed_edges;
    /** By node of the candidates: the cycle in which it pressed on a face last, counted from 1 in
     * an interval; 0 if none. */
    std::vector<std::uint64_t> last_pressed;
    std::uint64_t              cycles = 0;
    /** Slots of those that have. */
    std::vector<std::size_t> pressing;

    /** The key of what slides: for nodes without the face. */
    static RowKey
    slave_of(const RowKey &key);
    void
    press(std::size_t slot, std::uint64_t in_cycle);
    void
    remember(const OfRow &what);
    std::vector<OfRow>
    rows_to_carry(const std::vector<SurfaceRow> &rows) const;
    std::vector<OfNode>
    nodes_to_carry() const;
  };
} // namespace Touchstone

#endif
