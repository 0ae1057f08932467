// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/broad_phase.h>
#include <touchstone/collision/search_grid.h>

namespace Touchstone
{
  namespace
  {
    /**
     * @brief Bucket sort (Benson and Hallquist 1990): boxes are put into all buckets that they
     * meet, and compared with the others there.
     *
     * Buckets are as large as the median box, or larger if boxes would be in more than eight of
     * them on average. Only those that are not empty take memory: they are the entries of a hash
     * table.
     */
    class Bucket : public BroadPhase
    {
      struct Entry
      {
        std::uint64_t bucket;
        unsigned int  box;
      };
      std::vector<Entry>        entries, sorted;
      std::vector<unsigned int> begin;
      std::vector<GridCell>     lower, upper;

      static std::uint64_t
      number(const std::uint64_t x, const std::uint64_t y, const std::uint64_t z)
      {
        return x << 2 * SearchGrid::n_bits | y << SearchGrid::n_bits | z;
      }

      /** @brief Choose buckets and compute those of each box. */
      void
      choose_buckets(const SearchBoxes &boxes)
      {
        lower.resize(boxes.n());
        upper.resize(boxes.n());
        double size =
          std::max(boxes.median_size(), boxes.whole.size() / (1u << SearchGrid::n_bits));
        for (;; size *= 2.)
          {
            const SearchGrid grid(boxes.whole, size);
            double           n_entries = 0.;
            for (unsigned int k = 0; k < boxes.n(); ++k)
              {
                lower[k]      = grid.cell(boxes.boxes[k].lower);
                upper[k]      = grid.cell(boxes.boxes[k].upper);
                double filled = 1.;
                for (unsigned int d = 0; d < dim; ++d)
                  filled *= upper[k][d] - lower[k][d] + 1.;
                n_entries += filled;
              }
            if (n_entries <= 8. * boxes.n())
              return;
          }
      }

      void
      fill_buckets(const unsigned int n)
      {
        entries.clear();
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int x = lower[k][0]; x <= upper[k][0]; ++x)
            for (unsigned int y = lower[k][1]; y <= upper[k][1]; ++y)
              for (unsigned int z = lower[k][2]; z <= upper[k][2]; ++z)
                entries.push_back({number(x, y, z), k});
        unsigned int n_bits = 4;
        while ((std::size_t(1) << n_bits) < entries.size())
          ++n_bits;
        // Multiplicative hashing (Knuth).
        const auto place = [&](const Entry &entry) {
          return entry.bucket * 0x9e3779b97f4a7c15ull >> (64 - n_bits);
        };
        begin.assign((std::size_t(1) << n_bits) + 2, 0);
        for (const Entry &entry : entries)
          ++begin[place(entry) + 2];
        for (std::size_t k = 2; k < begin.size(); ++k)
          begin[k] += begin[k - 1];
        sorted.resize(entries.size());
        for (const Entry &entry : entries)
          sorted[begin[place(entry) + 1]++] = entry;
      }

      void
      collect(const SearchBoxes &boxes, BoxPairs &pairs) override
      {
        if (boxes.n() == 0)
          return;
        choose_buckets(boxes);
        fill_buckets(boxes.n());
        for (std::size_t place = 0; place + 1 < begin.size(); ++place)
          for (unsigned int p = begin[place]; p < begin[place + 1]; ++p)
            for (unsigned int q = p + 1; q < begin[place + 1]; ++q)
              {
                const unsigned int i = sorted[p].box, j = sorted[q].box;
                if (sorted[p].bucket != sorted[q].bucket || !boxes.boxes[i].meets(boxes.boxes[j]))
                  continue;
                // Of the buckets that both are in, the first one counts.
                const GridCell &a = lower[i], &b = lower[j];
                if (sorted[p].bucket ==
                      number(std::max(a[0], b[0]), std::max(a[1], b[1]), std::max(a[2], b[2])) &&
                    boxes.sought(i, j))
                  pairs.emplace_back(i, j);
              }
      }
    };

    const BroadPhaseRegistry::Entry<Bucket>
      bucket_entry("bucket",
                   "boxes are sorted into buckets of the median size, large ones into several.");
  } // namespace
} // namespace Touchstone
