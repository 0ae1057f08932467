#ifndef touchstone_algebra_multigrid_row_of_blocks_h
#define touchstone_algebra_multigrid_row_of_blocks_h

#include <vector>

namespace Touchstone
{
  /** @brief A row of blocks under construction, of columns that are met in any order. */
  template <typename Block>
  class RowOfBlocks
  {
  public:
    std::vector<int>   columns;
    std::vector<Block> blocks;

    Block &
    at(const int column)
    {
      if (static_cast<std::size_t>(column) >= place.size())
        place.resize(2 * static_cast<std::size_t>(column) + 64, -1);
      if (place[column] < 0)
        {
          place[column] = static_cast<int>(columns.size());
          columns.push_back(column);
          blocks.push_back({});
        }
      return blocks[place[column]];
    }

    void
    clear()
    {
      for (const int column : columns)
        place[column] = -1;
      columns.clear();
      blocks.clear();
    }

  private:
    std::vector<int> place;
  };
} // namespace Touchstone

#endif
