// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_vectorised_h
#define touchstone_base_vectorised_h

/** The compiler makes versions of the function for newer processors, of which the dynamic
 * linker chooses one when the program starts: distributions build for baseline x86-64. The
 * names of levels stand for all processors that have them; "arch=haswell" would stand for
 * this one alone. Where all of the program is compiled for a newer processor (TOUCHSTONE_NATIVE)
 * there is nothing to choose from, and GCC 12 fails with an internal error at versions for lesser
 * ones. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 12 && \
  !defined(__AVX2__)
#  define TOUCHSTONE_VECTORISED \
    __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#  define TOUCHSTONE_VECTORISED
#endif

/* Vectors of GCC and clang, in this header alone: VectorizedArray of a deal.II that was built for
 * all processors, as that of distributions, has one or two numbers. CMake checks that the compiler
 * has the functions below (GCC 12 or later, clang). */

/** The numbers of one vector, chosen by index, from the entries of two. */
#define TOUCHSTONE_SHUFFLE(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)

/** The entries of a vector as numbers of another type. */
#define TOUCHSTONE_CONVERT(vector, Type) __builtin_convertvector(vector, Type)

namespace Touchstone
{
  /** @brief Some numbers that are loaded and worked on at once, from any address. */
  template <typename Number, unsigned int n>
  struct Simd;

  template <>
  struct Simd<float, 4>
  {
    using type __attribute__((vector_size(16), aligned(4), may_alias)) = float;
  };

  template <>
  struct Simd<float, 8>
  {
    using type __attribute__((vector_size(32), aligned(4), may_alias)) = float;
  };

  template <>
  struct Simd<double, 2>
  {
    using type __attribute__((vector_size(16), aligned(8), may_alias)) = double;
  };

  template <>
  struct Simd<double, 4>
  {
    using type __attribute__((vector_size(32), aligned(8), may_alias)) = double;
  };

  template <>
  struct Simd<double, 8>
  {
    using type __attribute__((vector_size(64), aligned(8), may_alias)) = double;
  };
} // namespace Touchstone

#endif
