// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_lanes_h
#define touchstone_explicit_lanes_h

#include <touchstone/base/vectorised.h>
#include <touchstone/explicit/n_lanes.h>

#include <cstdint>
#include <cstring>

namespace Touchstone
{
  /** @brief A number of each of eight cells. What works on them is always inlined, so that
   * it becomes part of each version of a vectorised function. */
  using Lanes = Simd<double, n_lanes>::type;

  __attribute__((always_inline)) inline Lanes
  load(const double *values)
  {
    return *reinterpret_cast<const Lanes *>(values);
  }

  __attribute__((always_inline)) inline void
  store(const Lanes &lanes, double *values)
  {
    *reinterpret_cast<Lanes *>(values) = lanes;
  }

  /** @brief The components of eight vectors, at these addresses. */
  __attribute__((always_inline)) inline void
  gather(const double *const (&x)[n_lanes], Lanes (&values)[3])
  {
    using Pair = Simd<double, 2>::type;
    // Two components at once, of each other vector: loads of single ones take twice the time.
    const auto pairs = [&](const unsigned int i, const unsigned int c)
      __attribute__((always_inline))
    {
      const auto at = [&](const unsigned int k) __attribute__((always_inline))
      {
        return *reinterpret_cast<const Pair *>(x[k] + i);
      };
      const auto low  = TOUCHSTONE_SHUFFLE(at(c), at(c + 2), 0, 1, 2, 3),
                 high = TOUCHSTONE_SHUFFLE(at(c + 4), at(c + 6), 0, 1, 2, 3);
      return TOUCHSTONE_SHUFFLE(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
    };
    const Lanes first = pairs(0, 0), second = pairs(0, 1);
    values[0] = TOUCHSTONE_SHUFFLE(first, second, 0, 8, 2, 10, 4, 12, 6, 14);
    values[1] = TOUCHSTONE_SHUFFLE(first, second, 1, 9, 3, 11, 5, 13, 7, 15);
    values[2] = TOUCHSTONE_SHUFFLE(pairs(1, 0), pairs(1, 1), 1, 9, 3, 11, 5, 13, 7, 15);
  }

  /** @brief Cofactors of tensors [3i+j]: det(F) F^{-T}. */
  __attribute__((always_inline)) inline void
  cofactors(const Lanes (&F)[9], Lanes (&H)[9])
  {
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          const unsigned int p = (i + 1) % 3, q = (i + 2) % 3, r = (j + 1) % 3, s = (j + 2) % 3;
          H[3 * i + j] = F[3 * p + r] * F[3 * q + s] - F[3 * p + s] * F[3 * q + r];
        }
  }

  /** @brief x^{-1/3} of positive numbers up to round-off; of others no meaning. */
  __attribute__((always_inline)) inline Lanes
  inverse_cube_root(const Lanes &x)
  {
    // The exponent, and with it roughly the logarithm, times -1/3: 3.5 % off. With r = 1 - x y^3
    // the root is y (1 - r)^{-1/3}, of whose series up to r^4 two steps are exact.
    double        values[n_lanes];
    std::uint64_t bits[n_lanes];
    store(x, values);
    std::memcpy(bits, values, sizeof(bits));
    for (std::uint64_t &word : bits)
      word = (UINT64_C(0x553ef0ff) - (((word >> 32) * UINT64_C(0x55555556)) >> 32)) << 32;
    std::memcpy(values, bits, sizeof(bits));
    Lanes y = load(values);
    for (unsigned int step = 0; step < 2; ++step)
      {
        const Lanes r = 1. - x * y * y * y;
        y += y * r * (1. / 3. + r * (2. / 9. + r * (14. / 81. + r * (35. / 243.))));
      }
    return y;
  }

  /** @brief Square roots of numbers that are not negative, up to round-off. */
  __attribute__((always_inline)) inline Lanes
  square_root(const Lanes &x)
  {
    // As above: x y with y = x^{-1/2}.
    double        values[n_lanes];
    std::uint64_t bits[n_lanes];
    store(x, values);
    std::memcpy(bits, values, sizeof(bits));
    for (std::uint64_t &word : bits)
      word = (UINT64_C(0x5fe6eb50) - (word >> 33)) << 32;
    std::memcpy(values, bits, sizeof(bits));
    Lanes y = load(values);
    for (unsigned int step = 0; step < 2; ++step)
      {
        const Lanes r = 1. - x * y * y;
        y += y * r * (1. / 2. + r * (3. / 8. + r * (5. / 16. + r * (35. / 128.))));
      }
    return x * y;
  }
} // namespace Touchstone

#endif
