// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_collision_radix_sort_h
#define touchstone_collision_radix_sort_h

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief A box and the code of its place in space. */
  struct CodedBox
  {
    std::uint64_t code;
    unsigned int  box;
  };

  /** @brief Sort by code; boxes of the same code keep their order. In linear time: digit by
   * digit, the last first. @param scratch Any content; its memory is used. */
  inline void
  radix_sort(std::vector<CodedBox> &values, std::vector<CodedBox> &scratch)
  {
    constexpr unsigned int            n_bits = 11, n_digits = 1u << n_bits;
    std::array<std::size_t, n_digits> begin;
    std::uint64_t                     differing = 0;
    for (const CodedBox &value : values)
      differing |= value.code ^ values[0].code;
    scratch.resize(values.size());
    for (unsigned int shift = 0; shift < 64 && (differing >> shift) != 0; shift += n_bits)
      {
        if (((differing >> shift) & (n_digits - 1)) == 0)
          continue;
        begin.fill(0);
        for (const CodedBox &value : values)
          ++begin[(value.code >> shift) & (n_digits - 1)];
        std::size_t sum = 0;
        for (std::size_t &b : begin)
          sum += std::exchange(b, sum);
        for (const CodedBox &value : values)
          scratch[begin[(value.code >> shift) & (n_digits - 1)]++] = value;
        values.swap(scratch);
      }
  }
} // namespace Touchstone

#endif
