// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/code_search.h>

namespace Touchstone
{
  namespace
  {
    /**
     * @brief Capture boxes (Heinstein et al. 2000): a row of buckets has one id and is sorted in
     * one direction; a capture box looks through the rows that it crosses.
     *
     * Only rows that are not empty are listed, so that cost and memory depend on the number of
     * boxes, not on that of buckets. As in CodeSearch, a box captures those no larger than itself.
     */
    class CaptureBoxes : public BroadPhase
    {
      std::vector<CodedBox>      sorted, scratch;
      std::vector<FlatBox>       sorted_boxes;
      std::vector<std::uint64_t> rows;
      std::vector<unsigned int>  begin;
      std::vector<double>        sizes;

      static std::uint64_t
      row(const std::uint64_t y, const std::uint64_t z)
      {
        return z << SearchGrid::n_bits | y;
      }

      /** @brief Two sorts: along x, then by row. */
      void
      make_rows(const SearchBoxes &boxes, const SearchGrid &grid)
      {
        sorted.resize(boxes.n());
        sorted_boxes.resize(boxes.n());
        sizes.resize(boxes.n());
        for (unsigned int k = 0; k < boxes.n(); ++k)
          {
            const GridCell cell = grid.cell(boxes.boxes[k].lower);
            sizes[k]            = boxes.boxes[k].size();
            sorted[k]           = {row(cell[1], cell[2]) << SearchGrid::n_bits | cell[0], k};
          }
        radix_sort(sorted, scratch);
        rows.clear();
        begin.clear();
        for (unsigned int k = 0; k < boxes.n(); ++k)
          {
            sorted_boxes[k]        = boxes.boxes[sorted[k].box];
            const std::uint64_t id = sorted[k].code >> SearchGrid::n_bits;
            if (rows.empty() || rows.back() != id)
              {
                rows.push_back(id);
                begin.push_back(k);
              }
          }
        begin.push_back(boxes.n());
      }

      /** @brief Boxes of one row, from bucket @p first to bucket @p last. */
      void
      look_through(const SearchBoxes  &boxes,
                   const unsigned int  own,
                   const std::size_t   place,
                   const std::uint64_t first,
                   const std::uint64_t last,
                   BoxPairs           &pairs) const
      {
        const std::uint64_t id = rows[place] << SearchGrid::n_bits;
        const auto          from =
          std::lower_bound(sorted.begin() + begin[place],
                           sorted.begin() + begin[place + 1],
                           id | first,
                           [](const CodedBox &a, const std::uint64_t b) { return a.code < b; });
        const unsigned int i = sorted[own].box;
        for (unsigned int k = from - sorted.begin();
             k < begin[place + 1] && sorted[k].code <= (id | last);
             ++k)
          if (sorted_boxes[own].meets(sorted_boxes[k]))
            {
              // The larger one captures; of two of the same size the later one.
              const unsigned int j = sorted[k].box;
              if ((sizes[j] < sizes[i] || (sizes[j] == sizes[i] && k < own)) && boxes.sought(i, j))
                pairs.emplace_back(i, j);
            }
      }

      void
      collect(const SearchBoxes &boxes, BoxPairs &pairs) override
      {
        if (boxes.n() == 0)
          return;
        const SearchGrid grid(boxes.whole, boxes.median_size());
        make_rows(boxes, grid);
        for (unsigned int own = 0; own < boxes.n(); ++own)
          {
            const FlatBox  range = capture_box(sorted_boxes[own]);
            const GridCell first = grid.cell(range.lower), last = grid.cell(range.upper);
            std::uint64_t  z     = first[2];
            auto           place = std::lower_bound(rows.begin(), rows.end(), row(first[1], z));
            while (place != rows.end() && *place <= row(last[1], last[2]))
              {
                const std::uint64_t y = *place & ((1u << SearchGrid::n_bits) - 1);
                z                     = *place >> SearchGrid::n_bits;
                if (y > last[1] || y < first[1])
                  // To the range in this layer, or in the next one if it has been passed.
                  place =
                    std::lower_bound(place, rows.end(), row(first[1], y > last[1] ? z + 1 : z));
                else
                  look_through(boxes, own, place++ - rows.begin(), first[0], last[0], pairs);
              }
          }
      }
    };

    const BroadPhaseRegistry::Entry<CaptureBoxes> capture_boxes_entry(
      "capture boxes",
      "each box captures the smaller ones in the rows of buckets that it crosses.");
  } // namespace
} // namespace Touchstone
