// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/box_tree.h>
#include <touchstone/collision/broad_phase.h>
#include <touchstone/collision/radix_sort.h>
#include <touchstone/collision/search_grid.h>

namespace Touchstone
{
  namespace
  {
    /**
     * @brief Hierarchy and territories (HITA; Zhong and Nilsson 1990): boxes that are near form a
     * cluster, and only clusters whose territories meet are compared.
     *
     * Pairs of clusters are searched with expanded territories, and kept until a cluster leaves
     * its own. In a pair only boxes within the territory of the other cluster are compared.
     */
    class Hierarchy : public BroadPhase
    {
      static constexpr unsigned int cluster_size = 16;

      std::vector<unsigned int> order;
      SearchBoxes               expanded;
      BoxPairs                  cluster_pairs;
      std::vector<FlatBox>      territories;
      double                    size_at_start = 0.;
      unsigned int              n_first       = 0;
      bool                      one_set       = true;
      std::vector<unsigned int> near;

      unsigned int
      end_of(const unsigned int cluster) const
      {
        return std::min<std::size_t>(cluster_size * (cluster + 1), order.size());
      }

      /** @brief Boxes in clusters, along a space-filling curve. */
      void
      form_clusters(const SearchBoxes &boxes)
      {
        const SearchGrid      grid(boxes.whole, boxes.whole.size() / 65535.);
        std::vector<CodedBox> codes(boxes.n()), scratch;
        for (unsigned int k = 0; k < boxes.n(); ++k)
          codes[k] = {morton_code(grid.cell(boxes.boxes[k].lower)), k};
        radix_sort(codes, scratch);
        order.resize(boxes.n());
        for (unsigned int k = 0; k < boxes.n(); ++k)
          order[k] = codes[k].box;
      }

      /** @brief The box around each cluster. @return The sum of their sizes. */
      double
      find_territories(const SearchBoxes &boxes)
      {
        territories.resize((boxes.n() + cluster_size - 1) / cluster_size);
        double sum = 0.;
        for (unsigned int c = 0; c < territories.size(); ++c)
          {
            territories[c] = boxes.boxes[order[cluster_size * c]];
            for (unsigned int k = cluster_size * c + 1; k < end_of(c); ++k)
              territories[c].merge(boxes.boxes[order[k]]);
            sum += territories[c].sum_of_sides();
          }
        return sum;
      }

      void
      pair_clusters()
      {
        expanded.clear();
        for (const FlatBox &territory : territories)
          {
            expanded.boxes.push_back(territory.grown(0.05 * territory.size()));
            if (expanded.n() == 1)
              expanded.whole = expanded.boxes[0];
            expanded.whole.merge(expanded.boxes.back());
          }
        expanded.n_first = expanded.n();
        BoxTree tree;
        tree.build(expanded);
        cluster_pairs.clear();
        tree.pairs(expanded, cluster_pairs);
      }

      bool
      left_a_territory() const
      {
        for (unsigned int c = 0; c < territories.size(); ++c)
          if (!expanded.boxes[c].contains(territories[c]))
            return true;
        return false;
      }

      void
      compare(const SearchBoxes &boxes, const unsigned int a, const unsigned int b, BoxPairs &pairs)
      {
        near.clear();
        for (unsigned int q = cluster_size * b; q < end_of(b); ++q)
          if (boxes.boxes[order[q]].meets(territories[a]))
            near.push_back(order[q]);
        if (!near.empty())
          for (unsigned int p = cluster_size * a; p < end_of(a); ++p)
            if (boxes.boxes[order[p]].meets(territories[b]))
              for (const unsigned int j : near)
                boxes.test(order[p], j, pairs);
      }

      void
      collect(const SearchBoxes &boxes, BoxPairs &pairs) override
      {
        bool known =
          order.size() == boxes.n() && one_set == boxes.one_set && n_first == boxes.n_first;
        if (known)
          known = find_territories(boxes) <= 1.2 * size_at_start;
        if (!known)
          {
            form_clusters(boxes);
            size_at_start = find_territories(boxes);
            one_set       = boxes.one_set;
            n_first       = boxes.n_first;
          }
        if (!known || left_a_territory())
          pair_clusters();
        for (unsigned int c = 0; c < territories.size(); ++c)
          for (unsigned int p = cluster_size * c; p < end_of(c); ++p)
            for (unsigned int q = p + 1; q < end_of(c); ++q)
              boxes.test(order[p], order[q], pairs);
        for (const auto &[a, b] : cluster_pairs)
          if (territories[a].meets(territories[b]))
            compare(boxes, a, b, pairs);
      }
    };

    const BroadPhaseRegistry::Entry<Hierarchy> hierarchy_entry(
      "hierarchy",
      "boxes in clusters: first the territories of clusters are compared, and where they meet, "
      "the boxes.");
  } // namespace
} // namespace Touchstone
