// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_partial_cover_h
#define touchstone_contact_pairing_partial_cover_h

#include <touchstone/contact/geometry/face.h>

#include <array>

namespace Touchstone
{
  /**
   * @brief How the rows of averaged pairing share a slave face that is covered in part
   * (doc/theory.md 3.1, equation (4)).
   *
   * With the dual basis of the covered part each node has its own row, however little of its
   * shape function is covered: the row then requires that the gap extrapolated to the node vanish,
   * with a force that does not vanish with the area, so the pressure grows without bound.
   * Here nodes of which little is covered give their part to the other nodes of the face,
   *
   *   psi'_k = sum_i T_ki psi_i,   T_ki = beta_i delta_ki + (1 - beta_i) w_k,
   *
   * with columns that sum to one, so that the psi'_k still add up to one: a uniform pressure, the
   * resultant and the moment stay exact. With areas a_i = int N_i over the covered part and
   * A_i over the whole face, theta_i = a_i / A_i and their mean weighted by a_i, beta_i is a
   * smooth function of theta_i over that mean, one where the face is covered evenly. The
   * receivers w_k are among nodes with beta = 1. Aggregation of weakly cut functions with
   * well cut neighbours: Hoellig, Reif and Wipper (2001), SIAM J. Numer. Anal. 39; Badia,
   * Verdugo and Martin (2018), Comput. Methods Appl. Mech. Engrg. 336.
   */
  struct CoverShares
  {
    /** How far nodes keep or give their parts as a whole, and not smoothly with their cover: so do
     * tied rows, and those beside which other pairs cover the rest. */
    struct Whole
    {
      /** From 0 to 1, no unit. */
      std::array<double, Face::max_nodes> part{};
      /** Whether nodes kept theirs in the committed state, 1 or 0, or -1 without one. Where the
       * present cover leaves it open this decides: rows that came and went with the iterates of
       * Newton's method would find no solution. */
      std::array<int, Face::max_nodes> before;
      /** Nodes without rows (Face::without_row): they give all that they have, unless no other
       * node of the face has enough of the cover to take it. */
      std::array<bool, Face::max_nodes> gives{};

      Whole()
      {
        before.fill(-1);
      }
    };


    /** Whether any beta_i is not one. */
    bool partial = false;
    /** Cover theta_i over its mean, no unit. */
    std::array<double, Face::max_nodes> cover{};
    /** T_ki a_i: [k][i], area. */
    std::array<std::array<double, Face::max_nodes>, Face::max_nodes> share;
    /** Its derivative with respect to a_l: [k][i][l], no unit. */
    std::array<std::array<std::array<double, Face::max_nodes>, Face::max_nodes>, Face::max_nodes>
      derivative;

    /** @brief Whether the nodes that Whole::gives marks give what they have: not where none of the
     * others would keep its own part beside them. At the edge of a cover that begins there these
     * have next to nothing. The parameters are those of the constructor. */
    static bool
    gives_away(unsigned int                               n,
               const std::array<double, Face::max_nodes> &covered,
               const std::array<double, Face::max_nodes> &whole,
               const Whole                               &at_once);

    /** @brief Whether a node keeps its part as a whole.
     * @param cover Of the node, CoverShares::cover. @param before Whole::before. */
    static bool
    keeps(double cover, int before);

    /**
     * @param n               Number of basis functions.
     * @param covered         a_i of the n basis functions.
     * @param whole           A_i in the reference state.
     * @param with_derivative Compute `derivative`, too.
     */
    CoverShares(unsigned int                               n,
                const std::array<double, Face::max_nodes> &covered,
                const std::array<double, Face::max_nodes> &whole,
                const Whole                               &at_once,
                bool                                       with_derivative);
  };
} // namespace Touchstone

#endif
