// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/recursive_bisection.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>

// Parts that are compact, which keeps the surfaces between ranks small, and balanced by the work of
// cells and contact faces.
namespace Touchstone::RecursiveBisection
{
  using namespace dealii;

  std::vector<double>
  Ghosts::beyond(const std::vector<Item>::iterator begin,
                 const std::vector<Item>::iterator end) const
  {
    std::vector<double> change(end - begin + 1, 0.);
    if (vertices.empty())
      return change;
    std::unordered_map<unsigned int, std::ptrdiff_t> first;
    for (auto item = begin; item != end; ++item)
      for (const unsigned int v : vertices[item->number])
        first.emplace(v, item - begin);
    // An item lies beyond the cuts after the first one with a vertex of its own, up to itself.
    for (auto item = begin; item != end; ++item)
      {
        std::ptrdiff_t least = item - begin;
        for (const unsigned int v : vertices[item->number])
          least = std::min(least, first.at(v));
        change[least + 1] += part * item->work;
        change[item - begin + 1] -= part * item->work;
      }
    std::partial_sum(change.begin(), change.end(), change.begin());
    return change;
  }



  void
  Ranks::give(const std::vector<Item>::iterator begin,
              const std::vector<Item>::iterator end,
              const unsigned int                first,
              const unsigned int                n_ranks)
  {
    for (auto item = begin; item != end; ++item)
      of_item[item->number] = first;
    if (!among(first, n_ranks))
      return;
    for (auto item = begin; item != end; ++item)
      needed[item->number] = 1;
    add_needed(needed);
  }



  bool
  Ranks::any_needed(const std::vector<Item>::iterator begin,
                    const std::vector<Item>::iterator end) const
  {
    return std::any_of(begin, end, [this](const Item &item) { return needed[item.number]; });
  }



  namespace
  {
    /** Give the items from @p begin to @p end to @p n_ranks ranks from @p first on: cut across
     * the longest side of what they fill, and go on with the halves, first with that of this rank,
     * and with the other only if something in it is needed. */
    void
    bisect(const std::vector<Item>::iterator begin,
           const std::vector<Item>::iterator end,
           const unsigned int                first,
           const unsigned int                n_ranks,
           const Ghosts                     &ghosts,
           Ranks                            &ranks)
    {
      if (n_ranks == 1 || begin == end)
        {
          ranks.give(begin, end, first, n_ranks);
          return;
        }
      std::vector<Point<dim>> centers;
      for (auto item = begin; item != end; ++item)
        centers.push_back(item->center);
      const BoundingBox<dim> box(centers);
      // A tolerance decides between equal sides for the first axis, where round-off would decide
      // at random.
      unsigned int axis = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (box.side_length(d) > (1. + 1e-6) * box.side_length(axis))
          axis = d;
      // Positions are rounded, so that round-off does not decide the order within a layer of cells
      // and all layers but one stay in one part.
      const double unit = std::max(1e-6 * box.side_length(axis), 1e-300);
      for (auto item = begin; item != end; ++item)
        item->place = std::round((item->center[axis] - box.lower_bound(axis)) / unit);
      std::sort(begin, end, [](const Item &a, const Item &b) {
        return std::tie(a.place, a.number) < std::tie(b.place, b.number);
      });
      double total = 0.;
      for (auto item = begin; item != end; ++item)
        total += item->work;
      // The cut is where the sum of work is nearest to the share of the lower ranks: a cell goes
      // to the lower half if its middle lies below the target. Ranks need not be a power of two.
      // What the lower half computes beyond counts for each of its ranks.
      const unsigned int        n_lower = n_ranks / 2;
      const std::vector<double> beyond  = ghosts.beyond(begin, end);
      const double              share   = double(n_ranks - n_lower) / n_ranks;
      double                    sum     = 0.;
      auto                      middle  = begin;
      while (middle != end &&
             sum + 0.5 * middle->work + share * beyond[middle - begin] < total * n_lower / n_ranks)
        sum += (middle++)->work;
      // Each rank gets at least one cell if there are enough, however uneven the work.
      if (const std::ptrdiff_t n_items = end - begin; n_items >= n_ranks)
        middle = begin +
                 std::clamp<std::ptrdiff_t>(middle - begin, n_lower, n_items - (n_ranks - n_lower));
      const bool here = ranks.among(first, n_ranks), upper = ranks.here >= first + n_lower;
      const auto follow = [&](const bool of_upper) {
        if (of_upper)
          bisect(middle, end, first + n_lower, n_ranks - n_lower, ghosts, ranks);
        else
          bisect(begin, middle, first, n_lower, ghosts, ranks);
      };
      if (here)
        follow(upper);
      for (const bool other : {false, true})
        if (!(here && other == upper) &&
            (other ? ranks.any_needed(middle, end) : ranks.any_needed(begin, middle)))
          follow(other);
    }
  } // namespace



  void
  bisect_kinds(std::vector<Item> &items,
               const unsigned int n_ranks,
               const Ghosts      &ghosts,
               Ranks             &ranks)
  {
    std::stable_sort(items.begin(), items.end(), [](const Item &a, const Item &b) {
      return a.kind < b.kind;
    });
    // Neighbours of another kind may have been cut before: then all are needed until all are cut.
    const bool several = !items.empty() && items.front().kind != items.back().kind;
    ranks.needed.assign(items.size(), several);
    for (auto begin = items.begin(); begin != items.end();)
      {
        const auto end = std::find_if(begin, items.end(), [&](const Item &item) {
          return item.kind != begin->kind;
        });
        bisect(begin, end, 0, n_ranks, ghosts, ranks);
        begin = end;
      }
    if (!several)
      return;
    for (std::size_t i = 0; i < items.size(); ++i)
      ranks.needed[i] = ranks.of_item[i] == ranks.here;
    ranks.add_needed(ranks.needed);
  }
} // namespace Touchstone::RecursiveBisection
