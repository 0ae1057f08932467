// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_collision_search_grid_h
#define touchstone_collision_search_grid_h

#include <touchstone/collision/search_boxes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace Touchstone
{
  /** @brief Integer coordinates of a cell. */
  using GridCell = std::array<std::uint32_t, dim>;

  /**
   * @brief Cubic cells over a part of space.
   *
   * The cell of a coordinate is computed by subtraction, multiplication and truncation, all of
   * which keep the order of their arguments in floating point arithmetic: x <= y gives
   * cell(x) <= cell(y). So two boxes that intersect have a cell in common, whatever round-off does.
   */
  class SearchGrid
  {
  public:
    /** @brief Coordinates of cells have so many bits. */
    static constexpr unsigned int n_bits = 21;

    SearchGrid() = default;

    /** @param whole To be covered. What lies outside is counted to the outermost cells.
     * @param size Side of a cell; larger ones are chosen if 2^21 do not cover @p whole. */
    SearchGrid(const FlatBox &whole, const double size)
    {
      std::copy_n(whole.lower, dim, origin);
      const double smallest = whole.size() / (last - 1.);
      const double inverse  = 1. / std::max(size, smallest);
      // All coordinates are the same, or differ by next to nothing: one cell.
      per_length = std::isfinite(inverse) ? inverse : 0.;
    }

    /** @brief Of a coordinate in direction @p d. */
    std::uint32_t
    cell(const double x, const unsigned int d) const
    {
      const double scaled = (x - origin[d]) * per_length;
      return scaled <= 0. ? 0u : static_cast<std::uint32_t>(std::min(scaled, last));
    }

    GridCell
    cell(const double (&x)[dim]) const
    {
      return {{cell(x[0], 0), cell(x[1], 1), cell(x[2], 2)}};
    }

  private:
    static constexpr double last = (1u << n_bits) - 1.;

    double origin[dim] = {}, per_length = 0.;
  };

  /** @brief The bits of @p x, less than 2^21, with two zeros between each. */
  inline std::uint64_t
  spread_bits(std::uint64_t x)
  {
    x = (x | x << 32) & 0x001f00000000ffffull;
    x = (x | x << 16) & 0x001f0000ff0000ffull;
    x = (x | x << 8) & 0x100f00f00f00f00full;
    x = (x | x << 4) & 0x10c30c30c30c30c3ull;
    return (x | x << 2) & 0x1249249249249249ull;
  }

  /** @brief Number of a cell on the space-filling curve of Morton (1966): the bits of its
   * coordinates in turn, so that most cells that are near have numbers that are near. */
  inline std::uint64_t
  morton_code(const GridCell &cell)
  {
    return spread_bits(cell[0]) << 2 | spread_bits(cell[1]) << 1 | spread_bits(cell[2]);
  }
} // namespace Touchstone

#endif
