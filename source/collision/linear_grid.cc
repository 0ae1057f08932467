// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/broad_phase.h>
#include <touchstone/collision/search_grid.h>

namespace Touchstone
{
  namespace
  {
    /**
     * @brief Grids with linked lists and no sort (Munjiza and Andrews 1998), one for each size.
     *
     * Each level has cells of four times the size of the one below. A box belongs to the lowest
     * level on which it is in at most two cells in each direction. Levels are filled from the
     * largest down, and a box is compared with those that are in its cells of its own and of larger
     * levels; so small boxes are not in the cells of large ones, and the cost is linear whatever
     * the sizes are.
     */
    class LinearGrid : public BroadPhase
    {
      static constexpr unsigned int spacing = 2, n_levels = SearchGrid::n_bits + spacing, none = -1;

      struct Entry
      {
        std::uint64_t cell;
        unsigned int  box, next;
      };
      std::vector<GridCell>     lower, upper;
      std::vector<unsigned int> level_of, order, heads;
      std::vector<Entry>        entries;
      /** Of each level: where its part of the hash table begins, and 64 minus its bits. */
      std::array<std::size_t, n_levels>  begin;
      std::array<unsigned int, n_levels> shift;

      static std::uint64_t
      number(const std::uint64_t x, const std::uint64_t y, const std::uint64_t z)
      {
        return x << 2 * SearchGrid::n_bits | y << SearchGrid::n_bits | z;
      }

      unsigned int &
      head(const std::uint64_t cell, const unsigned int level)
      {
        return heads[begin[level] + (cell * 0x9e3779b97f4a7c15ull >> shift[level])];
      }

      /** @brief Call @p action with the cells of a box on a level, eight at most if it is its own
       * or a larger one. */
      template <class Action>
      void
      for_cells(const unsigned int box, const unsigned int level, const Action &action) const
      {
        const GridCell &a = lower[box], &b = upper[box];
        for (unsigned int x = a[0] >> level; x <= b[0] >> level; ++x)
          for (unsigned int y = a[1] >> level; y <= b[1] >> level; ++y)
            for (unsigned int z = a[2] >> level; z <= b[2] >> level; ++z)
              action(number(x, y, z));
      }

      /** @brief Levels of all boxes; order them from the largest down. */
      std::vector<unsigned int>
      choose_levels(const SearchBoxes &boxes)
      {
        const SearchGrid grid(boxes.whole, 0.);
        lower.resize(boxes.n());
        upper.resize(boxes.n());
        level_of.resize(boxes.n());
        order.resize(boxes.n());
        std::vector<unsigned int> count(n_levels + 1, 0), occupied;
        for (unsigned int k = 0; k < boxes.n(); ++k)
          {
            lower[k]           = grid.cell(boxes.boxes[k].lower);
            upper[k]           = grid.cell(boxes.boxes[k].upper);
            unsigned int level = 0;
            for (unsigned int d = 0; d < dim; ++d)
              while ((upper[k][d] >> level) - (lower[k][d] >> level) > 1)
                level += spacing;
            level_of[k] = level;
            ++count[n_levels - level];
          }
        std::size_t n_heads = 0;
        for (unsigned int level = n_levels; level-- > 0;)
          if (count[n_levels - level] > 0)
            {
              // Tables of large boxes are small and stay in the cache.
              unsigned int n_bits = 2;
              while ((std::size_t(1) << n_bits) < 4 * std::size_t(count[n_levels - level]))
                ++n_bits;
              begin[level] = n_heads;
              shift[level] = 64 - n_bits;
              n_heads += std::size_t(1) << n_bits;
              occupied.push_back(level);
            }
        heads.assign(n_heads, none);
        for (unsigned int l = 1; l <= n_levels; ++l)
          count[l] += count[l - 1];
        for (unsigned int k = 0; k < boxes.n(); ++k)
          order[count[n_levels - 1 - level_of[k]]++] = k;
        return occupied;
      }

      void
      compare(const SearchBoxes  &boxes,
              const unsigned int  i,
              const unsigned int  level,
              const std::uint64_t cell,
              BoxPairs           &pairs)
      {
        for (unsigned int e = head(cell, level); e != none; e = entries[e].next)
          {
            const unsigned int j = entries[e].box;
            if (entries[e].cell != cell || !boxes.boxes[i].meets(boxes.boxes[j]))
              continue;
            // Of the cells that both are in, the first one counts.
            const GridCell &a = lower[i], &b = lower[j];
            if (cell == number(std::max(a[0], b[0]) >> level,
                               std::max(a[1], b[1]) >> level,
                               std::max(a[2], b[2]) >> level) &&
                boxes.sought(i, j))
              pairs.emplace_back(i, j);
          }
      }

      void
      collect(const SearchBoxes &boxes, BoxPairs &pairs) override
      {
        if (boxes.n() == 0)
          return;
        const std::vector<unsigned int> occupied = choose_levels(boxes);
        entries.clear();
        for (const unsigned int i : order)
          {
            for (const unsigned int level : occupied)
              if (level >= level_of[i])
                for_cells(i, level, [&](const std::uint64_t cell) {
                  compare(boxes, i, level, cell, pairs);
                });
            for_cells(i, level_of[i], [&](const std::uint64_t cell) {
              unsigned int &first = head(cell, level_of[i]);
              entries.push_back({cell, i, first});
              first = entries.size() - 1;
            });
          }
      }
    };

    const BroadPhaseRegistry::Entry<LinearGrid> linear_grid_entry(
      "linear grid",
      "linked lists of the boxes in the cells of grids, one grid for each size; without a sort.");
  } // namespace
} // namespace Touchstone
