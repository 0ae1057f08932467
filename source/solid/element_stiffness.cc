// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/vectorised.h>
#include <touchstone/solid/element_stiffness.h>

#include <algorithm>

// The stiffness matrix of linear elastic cells, and the static condensation of incompatible modes
// (doc/theory.md 2.1). Eight cells are computed at once, one in each lane of the SIMD registers,
// since cells are independent of each other while the loops inside one cell are short.
namespace Touchstone
{
  namespace
  {
    /** One value for each of several cells: a SIMD vector, or a scalar for a single cell. */
    template <unsigned int n_cells>
    struct Number
    {
      using type = typename Simd<double, n_cells>::type;
    };
    template <>
    struct Number<1>
    {
      using type = double;
    };
  } // namespace



  template <unsigned int n_cells>
  ElementStiffness<n_cells>::ElementStiffness(const ElementType         type,
                                              const MaterialParameters &material,
                                              const unsigned int        n_nodes,
                                              const unsigned int        n_modes,
                                              const unsigned int        n_points)
    : b_bar(type == ElementType::b_bar)
    , bulk(material.bulk_modulus())
    , mu(material.shear_modulus())
    , n_points(n_points)
    , n_kept(dim * n_nodes)
    , n(dim * (n_nodes + n_modes))
    , weighted(n * n_points * n_cells)
    , mean(b_bar ? n_kept * n_cells : 0)
    , matrix(n * n * n_cells)
  {
  }



  // What is to be made is no argument: of a function with constant arguments GCC makes a copy, of
  // baseline instructions, which all versions of compute() call instead of inlining it.
  template <unsigned int n_cells>
  template <bool modes_only>
  inline __attribute__((always_inline)) void
  ElementStiffness<n_cells>::compute_here()
  {
    using Values                 = typename Number<n_cells>::type;
    const Values *const weighted = reinterpret_cast<const Values *>(this->weighted.data());
    const Values *const mean     = reinterpret_cast<const Values *>(this->mean.data());
    Values *const       matrix   = reinterpret_cast<Values *>(this->matrix.data());
    const unsigned int  first    = modes_only ? n_kept : 0;

    // With G_ab = sum_q w grad N_a (x) grad N_b isotropic elasticity is K_ab = (kappa - 2/3 mu)
    // G_ab + mu G_ab^T + mu (tr G_ab) I: nine sums for each pair of nodes instead of a product
    // with the 6 x 6 elasticity matrix. With B-bar the volumetric term kappa is taken from the
    // mean gradients instead.
    const double own = (b_bar ? 0. : bulk) - 2. / 3. * mu;
    for (unsigned int a = 0; a < n; a += dim)
      for (unsigned int b = std::max(a, first); b < n; b += dim)
        {
          // G_ab, column by column: one at a time is what fits into registers.
          Values g[dim][dim];
          for (unsigned int j = 0; j < dim; ++j)
            {
              Values column[dim] = {};
              for (unsigned int q = 0; q < n_points; ++q)
                {
                  const Values *const x = weighted + n * q;
                  for (unsigned int i = 0; i < dim; ++i)
                    column[i] += x[a + i] * x[b + j];
                }
              for (unsigned int i = 0; i < dim; ++i)
                g[i][j] = column[i];
            }
          const Values trace = mu * (g[0][0] + g[1][1] + g[2][2]);
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              {
                Values k = own * g[i][j] + mu * g[j][i];
                if (i == j)
                  k += trace;
                if (b_bar)
                  k += bulk * mean[a + i] * mean[b + j];
                matrix[n * (a + i) + b + j] = k;
              }
        }
    // Static condensation by Gaussian elimination of the modes.
    // The last mode first. Its row over what comes before it stays below the diagonal.
    for (unsigned int k = n; k-- > n_kept;)
      {
        Values *const row = matrix + n * k;
        for (unsigned int j = 0; j < k; ++j)
          row[j] = matrix[n * j + k];
        const Values inverse = 1. / row[k];
        for (unsigned int i = 0; i < k; ++i)
          {
            const Values factor = inverse * row[i];
            for (unsigned int j = std::max(i, first); j < k; ++j)
              matrix[n * i + j] -= factor * row[j];
          }
      }
  }



  template <unsigned int n_cells>
  inline __attribute__((always_inline)) void
  ElementStiffness<n_cells>::mirror()
  {
    using Values         = typename Number<n_cells>::type;
    Values *const matrix = reinterpret_cast<Values *>(this->matrix.data());
    for (unsigned int i = 0; i < n_kept; ++i)
      for (unsigned int j = 0; j < i; ++j)
        matrix[n * i + j] = matrix[n * j + i];
  }



  // Versions for several processors cannot be made of templates.
  template <>
  TOUCHSTONE_VECTORISED void
  ElementStiffness<1>::compute()
  {
    compute_here<false>();
    mirror();
  }



  template <>
  TOUCHSTONE_VECTORISED void
  ElementStiffness<8>::compute()
  {
    compute_here<false>();
    mirror();
  }



  template <>
  TOUCHSTONE_VECTORISED void
  ElementStiffness<1>::compute_modes()
  {
    compute_here<true>();
  }



  template <>
  void
  ElementStiffness<1>::recover_modes(std::vector<double> &displacement) const
  {
    // Back substitution in the reverse order of the elimination: the row of mode k refers to the
    // nodes and to the modes before it, as those after it had been eliminated when the row was
    // stored.
    for (unsigned int k = n_kept; k < n; ++k)
      {
        double sum = 0.;
        for (unsigned int j = 0; j < k; ++j)
          sum += matrix[n * k + j] * displacement[j];
        displacement.push_back(-sum / matrix[n * k + k]);
      }
  }



  template class ElementStiffness<1>;
  template class ElementStiffness<8>;
} // namespace Touchstone
