// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/code_search.h>

namespace Touchstone
{
  namespace
  {
    /** @brief Cells in the order of x, then y, then z: the position code of Oldenburg and Nilsson
     * (1994). */
    struct RowCode
    {
      static constexpr unsigned int  n_bits   = SearchGrid::n_bits;
      static constexpr std::uint64_t mask     = (std::uint64_t(1) << n_bits) - 1;
      static constexpr std::uint64_t masks[3] = {mask << 2 * n_bits, mask << n_bits, mask};

      static std::uint64_t
      encode(const GridCell &cell)
      {
        return std::uint64_t(cell[0]) << 2 * n_bits | std::uint64_t(cell[1]) << n_bits | cell[2];
      }

      static std::uint64_t
      next(const std::uint64_t code, const std::uint64_t first, const std::uint64_t last)
      {
        const auto part = [](const std::uint64_t c, const unsigned int d) {
          return (c >> (2 - d) * n_bits) & mask;
        };
        std::uint64_t x = part(code, 0), y = part(code, 1), z = part(code, 2);
        if (x < part(first, 0))
          return first;
        if (y < part(first, 1))
          z = part(first, 2), y = part(first, 1);
        else if (y <= part(last, 1) && z < part(first, 2))
          z = part(first, 2);
        else
          {
            // Behind the end of a row: the next one of this x, or the first of the next x.
            z = part(first, 2);
            if (++y > part(last, 1))
              {
                y = part(first, 1);
                ++x;
              }
          }
        return x > part(last, 0) ? std::numeric_limits<std::uint64_t>::max()
                                 : (x << 2 * n_bits | y << n_bits | z);
      }
    };

    const BroadPhaseRegistry::Entry<CodeSearch<RowCode>> position_code_entry(
      "position code",
      "one sorted vector of codes of positions, in which each box looks up a range.");
  } // namespace
} // namespace Touchstone
