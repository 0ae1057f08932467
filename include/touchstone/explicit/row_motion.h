// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_row_motion_h
#define touchstone_explicit_row_motion_h

#include <touchstone/contact/contact.h>
#include <touchstone/explicit/impulse_solver.h>
#include <touchstone/explicit/node_map.h>
#include <touchstone/explicit/surface_speeds.h>

#include <algorithm>
#include <array>
#include <vector>

namespace Touchstone
{
  /** @brief Bounds of how far nodes of contact surfaces have moved relative to each other, length:
   * of both sides of a pair, and of one side (doc/explicit.md, section 9.5). */
  struct RowTravel
  {
    double apart = 0., within = 0.;

    RowTravel() = default;

    /** @brief Within a cycle. */
    RowTravel(const double step, const Speeds &speeds)
    {
      add(step, speeds);
    }

    void
    add(const double step, const Speeds &speeds)
    {
      // A little more, for round-off.
      apart += (1. + 1e-9) * step * speeds.apart;
      within += (1. + 1e-9) * step * speeds.within;
    }
  };

  /**
   * @brief Tells when the rows that explicit dynamics keeps are to be made anew: before anything
   * has moved so far, relative to what it faces and to the size of the faces, that its partner,
   * weights or normal would be others (doc/explicit.md, section 9.5).
   */
  class RowMotion
  {
  public:
    RowMotion(const Contact &contact, const NodeMap &nodes);

    /** @brief Rows have been made at the displacement @p u. Collective.
     * @param rows The row of Contact by row of the solver. */
    void
    restart(const NodeField &u, const std::vector<std::size_t> &rows);

    /** @brief The displacement at restart(), by local node. */
    const NodeField &
    made_at_displacement() const
    {
      return made_at;
    }

    /** @brief Whether demands_rows() might say yes, the same on all ranks.
     * @param travelled Since restart(). @param ahead In this cycle with its free velocities. */
    bool
    must_look(const RowTravel &travelled, const RowTravel &ahead) const
    {
      return travelled.apart + ahead.apart >= std::min(safe_until.slide, safe_until.find) ||
             turned(travelled) + turned(ahead) >= safe_until.turn;
    }

    /**
     * @brief Whether, on any rank, the rows do not serve a cycle that ends with the displacement
     * @p u + @p step times @p v. Collective.
     * @param solver With the kept rows. @param moved By node of the solver: what it will have moved
     *               at that end since restart().
     * @param travelled,ahead As of must_look(). @param largest_weights By so much rows move faster
     *               than nodes do apart.
     */
    bool
    demands_rows(const NodeField                           &u,
                 const NodeField                           &v,
                 double                                     step,
                 const ImpulseSolver                       &solver,
                 const std::vector<dealii::Tensor<1, dim>> &moved,
                 const RowTravel                           &travelled,
                 const RowTravel                           &ahead,
                 double                                     largest_weights);

  private:
    const Contact &contact;
    const NodeMap &nodes;
    /** Corners of the faces of this rank of each pair that searches, by local node, the size of the
     * face (length), and whether it is a master face. */
    struct WatchedFace
    {
      std::array<unsigned int, 4> corners;
      double                      size;
    };
    std::vector<WatchedFace> faces;
    /** By pair: the local nodes of master faces, and of slave nodes with their size and the index
     * of the row; of pairs that search. */
    struct WatchedNode
    {
      unsigned int node;
      double       size;
      std::size_t  row;
    };
    std::vector<std::vector<unsigned int>> masters;
    std::vector<std::vector<WatchedNode>>  slaves;
    /** The displacement at restart(). */
    NodeField made_at;
    /** By pair: a slave node without partner, on any rank. */
    std::vector<bool> searching;

    /** A row of two bodies that may slide: its index in the solver, and what it was like when it
     * was made. */
    struct WatchedRow
    {
      std::size_t            row;
      double                 size, gap;
      dealii::Tensor<1, dim> normal;
    };
    std::vector<WatchedRow> sliding;
    /** The smallest gap of these when they were made, of all ranks; length. */
    double least_gap = 0.;
    /** Travel until which each criterion cannot be met, from the last look at it; length. By the
     * part #by_gap of what the sides travel apart the limit of the first falls. */
    struct Safe
    {
      double turn = 0., slide = 0., find = 0., by_gap = 0.;
    };
    Safe safe_until;

    double
    turned(const RowTravel &travel) const
    {
      return travel.within + safe_until.by_gap * travel.apart;
    }

    /** How far each criterion is from being met, negative if it is; length. */
    double
    until_faces_turn(const NodeField &u, const NodeField &v, double step, double gap) const;
    double
    until_rows_slide(const ImpulseSolver                       &solver,
                     const std::vector<dealii::Tensor<1, dim>> &moved) const;
    double
    until_partners_are_found(const NodeField &u, const NodeField &v, double step) const;
  };
} // namespace Touchstone

#endif
