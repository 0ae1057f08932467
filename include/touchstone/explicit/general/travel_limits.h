// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_travel_limits_h
#define touchstone_explicit_general_travel_limits_h

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace Touchstone
{
  /**
   * @brief How far nodes must have travelled before pairs are worth a look, and which pairs have
   * come so far: of many only few have, and blocks of others are passed over by their least limit.
   */
  class TravelLimits
  {
  public:
    /** @brief Nothing is known of @p n pairs: all are worth a look. */
    void
    assign(const std::size_t n)
    {
      limits.assign(n, -std::numeric_limits<double>::max());
      least.assign((n + block - 1) / block, -std::numeric_limits<double>::max());
    }

    std::size_t
    size() const
    {
      return limits.size();
    }

    double
    operator[](const std::size_t pair) const
    {
      return limits[pair];
    }

    /** @param limit Length; not NaN. */
    void
    set(const std::size_t pair, const double limit)
    {
      limits[pair]        = limit;
      least[pair / block] = std::min(least[pair / block], limit);
    }

    /** @brief Call @p use(pair) for each pair whose limit is at most @p travelled, in ascending
     * order. It must not change limits. */
    template <class Use>
    void
    for_each_reached(const double travelled, const Use &use)
    {
      for (std::size_t b = 0; b < least.size(); ++b)
        if (least[b] <= travelled)
          {
            const std::size_t end = std::min(limits.size(), (b + 1) * block);
            least[b] = *std::min_element(limits.begin() + b * block, limits.begin() + end);
            for (std::size_t pair = b * block; pair < end; ++pair)
              if (limits[pair] <= travelled)
                use(pair);
          }
    }

  private:
    static constexpr std::size_t block = 32;
    std::vector<double>          limits, least;
  };
} // namespace Touchstone

#endif
