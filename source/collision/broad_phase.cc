// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/broad_phase.h>

#include <algorithm>

namespace Touchstone
{
  BoxPairs
  BroadPhase::find(const std::vector<dealii::BoundingBox<dim>> &a,
                   const std::vector<dealii::BoundingBox<dim>> &b)
  {
    input.clear();
    input.append(a, "the first set");
    input.append(b, "the second set");
    input.one_set = false;
    input.n_first = a.size();
    return sorted_pairs();
  }


  BoxPairs
  BroadPhase::find(const std::vector<dealii::BoundingBox<dim>> &boxes)
  {
    input.clear();
    input.append(boxes, "the set");
    input.n_first = boxes.size();
    return sorted_pairs();
  }


  BoxPairs
  BroadPhase::sorted_pairs()
  {
    found.clear();
    collect(input, found);

    // Counted by the first box, then the few of each are sorted: this is linear.
    begin.assign(input.n() + 2, 0);
    for (auto &[i, j] : found)
      {
        if (j < i)
          std::swap(i, j);
        ++begin[i + 2];
      }
    for (unsigned int i = 2; i < begin.size(); ++i)
      begin[i] += begin[i - 1];
    const unsigned int offset = input.one_set ? 0 : input.n_first;
    BoxPairs           result(found.size());
    for (const auto &[i, j] : found)
      result[begin[i + 1]++] = {i, j - offset};
    for (unsigned int i = 0; i < input.n(); ++i)
      std::sort(result.begin() + begin[i], result.begin() + begin[i + 1]);
    return result;
  }
} // namespace Touchstone
