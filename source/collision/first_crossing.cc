// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/first_crossing.h>
#include <touchstone/collision/first_root.h>
#include <touchstone/collision/relative_motion.h>

#include <algorithm>

namespace Touchstone
{
  namespace
  {
    /** The first crossing of a motion. @param weights Those of Crossing from the coefficients of
     * closest_to_zero(). */
    template <class Weights>
    std::optional<Crossing>
    first_crossing(const RelativeMotion &motion, const Weights &weights)
    {
      if (motion.apart())
        return {};
      Crossing      crossing;
      const Verdict verdict = first_root(motion, crossing);
      if (verdict == Verdict::apart)
        return {};
      if (verdict == Verdict::crossing)
        return crossing;
      const std::optional<double> time = first_inclusion(motion);
      if (!time)
        return {};
      return Crossing{*time, weights(closest_to_zero(motion.at(*time), motion.n))};
    }
  } // namespace



  std::optional<Crossing>
  first_crossing_node_triangle(const FourPoints &start, const FourPoints &end)
  {
    return first_crossing(RelativeMotion::node_triangle(start, end), [](const auto &w) {
      return std::array<double, 3>{{w[0], w[1], w[2]}};
    });
  }



  std::optional<Crossing>
  first_crossing_edge_edge(const FourPoints &start, const FourPoints &end)
  {
    return first_crossing(RelativeMotion::edge_edge(start, end), [](const auto &w) {
      return std::array<double, 3>{{std::min(1., w[2] + w[3]), std::min(1., w[1] + w[3]), 0.}};
    });
  }
} // namespace Touchstone
