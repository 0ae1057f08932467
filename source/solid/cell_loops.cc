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



    template <unsigned int n, bool symmetric>
    __attribute__((always_inline)) inline void
    add_tangent_of(const double *gradient, const double (&A)[dim][dim][dim][dim], double *blocks)
    {
      const double *g[dim] = {gradient, gradient + n, gradient + 2 * n};
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int k = 0; k < dim; ++k)
            {
              double left[dim];
              for (unsigned int l = 0; l < dim; ++l)
                left[l] =
                  g[0][a] * A[i][0][k][l] + g[1][a] * A[i][1][k][l] + g[2][a] * A[i][2][k][l];
              double *block = blocks + ((a * dim + i) * dim + k) * n;
              // Eight at a time: of symmetric blocks some are computed that are not needed.
              for (unsigned int b = symmetric ? a / 8 * 8 : 0; b < n; ++b)
                block[b] += left[0] * g[0][b] + left[1] * g[1][b] + left[2] * g[2][b];
            }
    }

    TOUCHSTONE_VECTORISED void
    add_tangent_8(const double *g, const double (&A)[dim][dim][dim][dim], double *blocks)
    {
      add_tangent_of<8, false>(g, A, blocks);
    }

    TOUCHSTONE_VECTORISED void
    add_tangent_27(const double *g, const double (&A)[dim][dim][dim][dim], double *blocks)
    {
      add_tangent_of<27, false>(g, A, blocks);
    }

    TOUCHSTONE_VECTORISED void
    add_symmetric_tangent_27(const double *g, const double (&A)[dim][dim][dim][dim], double *blocks)
    {
      add_tangent_of<27, true>(g, A, blocks);
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
    double values[dim][dim][dim][dim];
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            values[i][j][k][l] = weight * A[i][j][k][l];
    if (n == 8)
      add_tangent_8(gradients, values, blocks);
    else
      (symmetric ? add_symmetric_tangent_27 : add_tangent_27)(gradients, values, blocks);
  }
} // namespace Touchstone
