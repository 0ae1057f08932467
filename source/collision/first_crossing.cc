// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/first_crossing.h>
#include <touchstone/collision/first_root.h>
#include <touchstone/collision/relative_motion.h>

#include <algorithm>

namespace Touchstone
{
  std::optional<Crossing>
  first_crossing_node_triangle(const FourPoints &start, const FourPoints &end)
  {
    const RelativeMotion motion = RelativeMotion::node_triangle(start, end);
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
    const auto weights = closest_to_zero(motion.at(*time), motion.n);
    return Crossing{*time, {{weights[0], weights[1], weights[2]}}};
  }



  std::optional<Crossing>
  first_crossing_edge_edge(const FourPoints &start, const FourPoints &end)
  {
    const RelativeMotion motion = RelativeMotion::edge_edge(start, end);
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
    const auto w = closest_to_zero(motion.at(*time), motion.n);
    return Crossing{*time, {{std::min(1., w[2] + w[3]), std::min(1., w[1] + w[3]), 0.}}};
  }
} // namespace Touchstone
