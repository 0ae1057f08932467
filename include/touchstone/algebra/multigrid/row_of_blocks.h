// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_multigrid_row_of_blocks_h
#define touchstone_algebra_multigrid_row_of_blocks_h

#include <vector>

namespace Touchstone
{
  /** @brief A row of blocks under construction, whose columns are met in any order. */
  template <typename Block>
  class RowOfBlocks
  {
  public:
    std::vector<int>   columns;
    std::vector<Block> blocks;

    Block &
    at(const int column)
    {
      if (static_cast<std::size_t>(column) >= position.size())
        position.resize(2 * static_cast<std::size_t>(column) + 64, -1);
      if (position[column] < 0)
        {
          position[column] = static_cast<int>(columns.size());
          columns.push_back(column);
          blocks.push_back({});
        }
      return blocks[position[column]];
    }

    void
    clear()
    {
      for (const int column : columns)
        position[column] = -1;
      columns.clear();
      blocks.clear();
    }

  private:
    /** Position of a column in the row; -1: not in it. */
    std::vector<int> position;
  };
} // namespace Touchstone

#endif
