// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/box_tree.h>
#include <touchstone/collision/broad_phase.h>

namespace Touchstone
{
  namespace
  {
    /**
     * @brief Partners of the last call are compared first, as with nearest nodes that are tracked
     * (Hallquist, Goudreau and Benson 1985), and those that may be missing are proved to be none.
     *
     * A walk to neighbours of the last partner misses partners at corners and between bodies.
     * Here each box has a territory around it, and all pairs of territories that meet are kept
     * (Verlet 1967). As long as boxes are within their territories no other pair can intersect.
     * A box that has left gets a new one, whose partners a tree finds.
     */
    class Tracking : public BroadPhase
    {
      SearchBoxes               territories;
      BoxPairs                  partners;
      BoxTree                   tree;
      std::vector<unsigned int> outside, met;
      std::vector<bool>         is_outside;

      void
      start(const SearchBoxes &boxes)
      {
        territories         = boxes;
        const double median = boxes.median_size();
        for (FlatBox &box : territories.boxes)
          box = territory(box, median);
        for (const FlatBox &box : territories.boxes)
          territories.whole.merge(box);
        tree.build(territories);
        partners.clear();
        tree.pairs(territories, partners);
      }

      /** @brief The space in which a box may move. */
      static FlatBox
      territory(const FlatBox &box, const double median)
      {
        return box.grown(0.2 * std::max(box.size(), 0.5 * median));
      }

      /** @brief New territories and partners for boxes that have left theirs. */
      void
      renew(const SearchBoxes &boxes)
      {
        const double median = boxes.median_size();
        for (const unsigned int k : outside)
          territories.boxes[k] = territory(boxes.boxes[k], median);
        tree.refit(territories);
        const auto obsolete = [&](const auto &pair) {
          return is_outside[pair.first] || is_outside[pair.second];
        };
        partners.erase(std::remove_if(partners.begin(), partners.end(), obsolete), partners.end());
        for (const unsigned int i : outside)
          {
            met.clear();
            tree.meeting(territories.boxes[i], met);
            for (const unsigned int j : met)
              // Both have left: each of them meets the other.
              if (i != j && boxes.sought(i, j) && (!is_outside[j] || i < j))
                partners.emplace_back(i, j);
          }
      }

      void
      collect(const SearchBoxes &boxes, BoxPairs &pairs) override
      {
        bool known = territories.n() == boxes.n() && territories.one_set == boxes.one_set &&
                     territories.n_first == boxes.n_first;
        if (known)
          {
            outside.clear();
            is_outside.assign(boxes.n(), false);
            for (unsigned int k = 0; k < boxes.n(); ++k)
              if (!territories.boxes[k].contains(boxes.boxes[k]))
                {
                  outside.push_back(k);
                  is_outside[k] = true;
                }
            known = outside.size() <= boxes.n() / 8;
          }
        if (!known)
          start(boxes);
        else if (!outside.empty())
          renew(boxes);
        for (const auto &[i, j] : partners)
          if (boxes.boxes[i].meets(boxes.boxes[j]))
            pairs.emplace_back(i, j);
      }
    };

    const BroadPhaseRegistry::Entry<Tracking> tracking_entry(
      "tracking",
      "partners are kept as long as boxes are in the territories that they were found for.");
  } // namespace
} // namespace Touchstone
