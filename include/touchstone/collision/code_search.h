// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_collision_code_search_h
#define touchstone_collision_code_search_h

#include <touchstone/collision/broad_phase.h>
#include <touchstone/collision/radix_sort.h>
#include <touchstone/collision/search_grid.h>

#include <limits>

namespace Touchstone
{
  /** @brief The part of space in which lower corners of boxes that are no larger than @p box must
   * lie for that they meet it. */
  inline FlatBox
  capture_box(const FlatBox &box)
  {
    FlatBox      result = box;
    const double size   = box.size();
    for (unsigned int d = 0; d < dim; ++d)
      // Sizes are differences that are rounded, and so is this one.
      result.lower[d] -=
        size + 4. * std::numeric_limits<double>::epsilon() * (std::abs(box.lower[d]) + size);
    return result;
  }

  /**
   * @brief Search by one sorted vector of integer codes of the cells in which boxes have their
   * lower corners.
   *
   * Each box captures those that are no larger than itself: their corners are in a range of
   * cells, and the codes of this range are found by jumps over those that are not in it. So cells
   * without boxes cost nothing, and one large box does not make the cells of all others large.
   *
   * @tparam Code Has static functions encode(cell) and next(code, first, last): the smallest code
   *              of the range of cells from @p first to @p last that is larger than @p code, or
   *              none; and masks[d], the bits of a code that belong to direction d.
   */
  template <class Code>
  class CodeSearch : public BroadPhase
  {
  protected:
    /** @brief No further code. */
    static constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();

  private:
    std::vector<CodedBox> sorted, scratch;
    std::vector<FlatBox>  sorted_boxes;
    std::vector<double>   sizes;

    static bool
    within(const std::uint64_t code, const std::uint64_t first, const std::uint64_t last)
    {
      bool result = true;
      for (const std::uint64_t mask : Code::masks)
        result &= ((code & mask) >= (first & mask)) & ((code & mask) <= (last & mask));
      return result;
    }

    /** @brief The first place from @p place on whose code is @p code or larger. Steps double, for
     * what is searched is mostly near. */
    std::size_t
    forward(std::size_t place, const std::uint64_t code) const
    {
      std::size_t step = 1;
      while (place + step < sorted.size() && sorted[place + step].code < code)
        {
          place += step;
          step *= 2;
        }
      const auto begin = sorted.begin() + place,
                 end   = sorted.begin() + std::min(place + step + 1, sorted.size());
      return std::lower_bound(begin,
                              end,
                              code,
                              [](const CodedBox &a, const std::uint64_t b) { return a.code < b; }) -
             sorted.begin();
    }

    /** @brief The first place before @p place, or this one, from which on all codes are @p code or
     * larger. */
    std::size_t
    backward(const std::size_t place, const std::uint64_t code) const
    {
      std::size_t step = 1;
      while (step < place && sorted[place - step].code >= code)
        step *= 2;
      return forward(step < place ? place - step : 0, code);
    }

    void
    capture(const SearchBoxes &boxes,
            const SearchGrid  &grid,
            const std::size_t  own,
            BoxPairs          &pairs) const
    {
      const FlatBox       box = sorted_boxes[own], range = capture_box(box);
      const std::uint64_t first = Code::encode(grid.cell(range.lower)),
                          last  = Code::encode(grid.cell(range.upper));
      std::size_t place         = backward(own, first);
      while (place < sorted.size() && sorted[place].code <= last)
        {
          const std::uint64_t code = sorted[place].code;
          if (!within(code, first, last))
            {
              const std::uint64_t next = Code::next(code, first, last);
              if (next == none)
                break;
              place = forward(place, next);
              continue;
            }
          for (; place < sorted.size() && sorted[place].code == code; ++place)
            if (box.meets(sorted_boxes[place]))
              {
                // The larger one captures; of two of the same size the later one.
                const unsigned int i = sorted[own].box, j = sorted[place].box;
                if ((sizes[j] < sizes[i] || (sizes[j] == sizes[i] && place < own)) &&
                    boxes.sought(i, j))
                  pairs.emplace_back(i, j);
              }
        }
    }

    void
    collect(const SearchBoxes &boxes, BoxPairs &pairs) override
    {
      const SearchGrid grid =
        boxes.n() > 0 ? SearchGrid(boxes.whole, boxes.median_size()) : SearchGrid();
      sorted.resize(boxes.n());
      sizes.resize(boxes.n());
      for (unsigned int k = 0; k < boxes.n(); ++k)
        {
          sorted[k] = {Code::encode(grid.cell(boxes.boxes[k].lower)), k};
          sizes[k]  = boxes.boxes[k].size();
        }
      radix_sort(sorted, scratch);
      sorted_boxes.resize(boxes.n());
      for (unsigned int k = 0; k < boxes.n(); ++k)
        sorted_boxes[k] = boxes.boxes[sorted[k].box];
      for (std::size_t k = 0; k < sorted.size(); ++k)
        capture(boxes, grid, k, pairs);
    }
  };
} // namespace Touchstone

#endif
