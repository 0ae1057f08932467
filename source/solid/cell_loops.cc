// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/vectorised.h>
#include <touchstone/solid/cell_loops.h>

// Versions for several processors cannot be made of templates, so that each function is there
// twice around a template that is inlined: the number of nodes is known to the compiler, which
// vectorises the innermost loops.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    template <unsigned int n>
    __attribute__((always_inline)) inline void
    nodal_sums_of(const double *field, const double *table, double *sums)
    {
      constexpr unsigned int n_tables = dim + 1;
      for (unsigned int d = 0; d < n_tables; ++d)
        {
          double sum[dim][n] = {};
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int q = 0; q < n; ++q)
                sum[i][q] += field[dim * a + i] * table[(n_tables * a + d) * n + q];
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int q = 0; q < n; ++q)
              sums[(n_tables * i + d) * n + q] = sum[i][q];
        }
    }

    TOUCHSTONE_VECTORISED void
    nodal_sums_8(const double *field, const double *table, double *sums)
    {
      nodal_sums_of<8>(field, table, sums);
    }

    TOUCHSTONE_VECTORISED void
    nodal_sums_27(const double *field, const double *table, double *sums)
    {
      nodal_sums_of<27>(field, table, sums);
    }



    template <unsigned int n>
    __attribute__((always_inline)) inline void
    shape_gradients_of(const double *unit, const double (&inverse)[dim][dim], double *gradients)
    {
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int a = 0; a < n; ++a)
          gradients[d * n + a] =
            unit[a] * inverse[0][d] + unit[n + a] * inverse[1][d] + unit[2 * n + a] * inverse[2][d];
    }

    TOUCHSTONE_VECTORISED void
    shape_gradients_8(const double *unit, const double (&inverse)[dim][dim], double *gradients)
    {
      shape_gradients_of<8>(unit, inverse, gradients);
    }

    TOUCHSTONE_VECTORISED void
    shape_gradients_27(const double *unit, const double (&inverse)[dim][dim], double *gradients)
    {
      shape_gradients_of<27>(unit, inverse, gradients);
    }



    using Moduli = double[dim][dim][dim][dim];

    /** Eight nodes at a time, as blocks [i][k][l][a] of w A : (grad N_a, e_l) first. Of symmetric
     * blocks some are computed that are not needed. */
    __attribute__((always_inline)) inline void
    add_tangent_of(const unsigned int n,
                   const double      *gradient,
                   const Moduli      &A,
                   const bool         symmetric,
                   double            *blocks)
    {
      using Eight                = Simd<double, 8>::type;
      constexpr unsigned int all = 8;
      for (unsigned int begin = 0; begin < n; begin += all)
        {
          // The last nodes of 27 are counted again, where they are not added.
          const unsigned int first = begin + all <= n ? begin : n - all;
          Eight              g[dim];
          for (unsigned int j = 0; j < dim; ++j)
            g[j] = *reinterpret_cast<const Eight *>(gradient + j * n + first);
          Eight left[dim][dim][dim];
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int l = 0; l < dim; ++l)
                left[i][k][l] = g[0] * A[i][0][k][l] + g[1] * A[i][1][k][l] + g[2] * A[i][2][k][l];
          for (unsigned int a = begin; a < begin + all && a < n; ++a)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int k = 0; k < dim; ++k)
                {
                  const double x = left[i][k][0][a - first], y = left[i][k][1][a - first],
                               z      = left[i][k][2][a - first];
                  double *const block = blocks + ((a * dim + i) * dim + k) * n;
                  unsigned int  b     = symmetric ? begin : 0;
                  for (; b + all <= n; b += all)
                    *reinterpret_cast<Eight *>(block + b) +=
                      x * *reinterpret_cast<const Eight *>(gradient + b) +
                      y * *reinterpret_cast<const Eight *>(gradient + n + b) +
                      z * *reinterpret_cast<const Eight *>(gradient + 2 * n + b);
                  for (; b < n; ++b)
                    block[b] += x * gradient[b] + y * gradient[n + b] + z * gradient[2 * n + b];
                }
        }
    }

    TOUCHSTONE_VECTORISED void
    add_tangent_8(const double *g, const Moduli &A, double *blocks)
    {
      add_tangent_of(8, g, A, false, blocks);
    }

    TOUCHSTONE_VECTORISED void
    add_tangent_27(const double *g, const Moduli &A, const bool symmetric, double *blocks)
    {
      add_tangent_of(27, g, A, symmetric, blocks);
    }
  } // namespace



  void
  CellLoops::nodal_sums(const unsigned int n,
                        const double      *field,
                        const double      *table,
                        double            *sums)
  {
    (n == 8 ? nodal_sums_8 : nodal_sums_27)(field, table, sums);
  }



  void
  CellLoops::shape_gradients(const unsigned int    n,
                             const double         *unit,
                             const Tensor<2, dim> &inverse,
                             double               *gradients)
  {
    double values[dim][dim];
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        values[i][d] = inverse[i][d];
    (n == 8 ? shape_gradients_8 : shape_gradients_27)(unit, values, gradients);
  }



  void
  CellLoops::add_tangent(const unsigned int    n,
                         const double         *gradients,
                         const double          weight,
                         const Tensor<4, dim> &A,
                         const bool            symmetric,
                         double               *blocks)
  {
    Moduli values;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            values[i][j][k][l] = weight * A[i][j][k][l];
    if (n == 8)
      add_tangent_8(gradients, values, blocks);
    else
      add_tangent_27(gradients, values, symmetric, blocks);
  }
} // namespace Touchstone
