// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_recursive_bisection_h
#define touchstone_mesh_recursive_bisection_h

#include <touchstone/base/types.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <vector>

/**
 * @file
 * Recursive bisection of the coordinates of items, for partition_by_coordinates(). The result
 * depends on the items alone.
 */

namespace Touchstone::RecursiveBisection
{
  /** @brief What is given to a rank: a cell. */
  struct Item
  {
    dealii::Point<dim> center;
    /** CellWork, with that of contact. */
    double       work;
    unsigned int number;
    /** Items of different kinds are done one kind after the other; explicit runs compute all
     * cells in one pass. */
    unsigned int kind;
    /** Along the axis that is cut, rounded. */
    double place = 0.;
  };

  /** @brief What the ranks of a lower half compute of the upper one, all cells that share a vertex
   * with theirs: the vertices of each cell by number, and the part of the work of such a cell.
   * Without vertices it is nothing. */
  struct Ghosts
  {
    std::vector<std::array<unsigned int, dealii::GeometryInfo<dim>::vertices_per_cell>> vertices;
    double                                                                              part = 1.;

    /** @brief Work beyond a cut before each of these items, by their places. */
    std::vector<double>
    beyond(std::vector<Item>::iterator begin, std::vector<Item>::iterator end) const;
  };



  /** @brief Ranks of items, as far as this rank needs them: of its own and of those that it asks
   * for once it knows these. */
  struct Ranks
  {
    unsigned int here;
    /** By item; those that are not needed have none. */
    std::vector<unsigned int> of_item;
    /** Which items are needed, by number, from those of this rank, which are marked. */
    std::function<void(std::vector<char> &)> add_needed;
    std::vector<char>                        needed;

    /** @brief Whether this rank is one of @p n_ranks from @p first on. */
    bool
    among(const unsigned int first, const unsigned int n_ranks) const
    {
      return here >= first && here < first + n_ranks;
    }

    /** @brief Give items to rank @p first; of several ranks only if there are none to be given. */
    void
    give(std::vector<Item>::iterator begin,
         std::vector<Item>::iterator end,
         unsigned int                first,
         unsigned int                n_ranks);

    /** @brief Whether any of these items is needed. */
    bool
    any_needed(std::vector<Item>::iterator begin, std::vector<Item>::iterator end) const;
  };

  /** @brief Give the items of each kind to the ranks for themselves: all ranks integrate the cells
   * that change before any of them goes on to the solution, to which all cells count alike. Items
   * are cut across the longest side of what they fill, and so are the halves. Without messages. */
  void
  bisect_kinds(std::vector<Item> &items, unsigned int n_ranks, const Ghosts &ghosts, Ranks &ranks);
} // namespace Touchstone::RecursiveBisection

#endif
