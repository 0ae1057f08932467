// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/code_search.h>

namespace Touchstone
{
  namespace
  {
    /** @brief Cells along a space-filling curve (Diekmann et al. 2000), that of Morton. */
    struct CurveCode
    {
      static constexpr std::uint64_t mask     = 0x1249249249249249ull;
      static constexpr std::uint64_t masks[3] = {mask << 2, mask << 1, mask};

      static std::uint64_t
      encode(const GridCell &cell)
      {
        return morton_code(cell);
      }

      /** @brief Bit by bit the part of the curve that has @p code is cut off the range (Tropf and
       * Herzog 1981). */
      static std::uint64_t
      next(const std::uint64_t code, std::uint64_t first, std::uint64_t last)
      {
        std::uint64_t result = std::numeric_limits<std::uint64_t>::max();
        // Above the first bit in which the three differ nothing happens.
        unsigned int end = 0;
        for (std::uint64_t differing = (code ^ first) | (code ^ last); differing != 0;)
          {
            differing >>= 3;
            end += 3;
          }
        for (unsigned int bit = end; bit-- > 0;)
          {
            const std::uint64_t here = std::uint64_t(1) << bit;
            // Lower bits of the same direction.
            const std::uint64_t below = masks[2 - bit % 3] & (here - 1);
            const bool in_code = code & here, in_first = first & here, in_last = last & here;
            if (!in_code && !in_first && in_last)
              {
                result = (first & ~below) | here;
                last   = (last | below) & ~here;
              }
            else if (!in_code && in_first)
              return first;
            else if (in_code && !in_last)
              return result;
            else if (in_code && !in_first)
              first = (first & ~below) | here;
          }
        return result;
      }
    };

    const BroadPhaseRegistry::Entry<CodeSearch<CurveCode>>
      space_filling_curve_entry("space-filling curve",
                                "as position code, with positions along a space-filling curve.");
  } // namespace
} // namespace Touchstone
