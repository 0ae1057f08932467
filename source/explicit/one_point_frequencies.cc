// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/one_point_kernels.h>
#include <touchstone/explicit/stable_step.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>

// The largest frequency of cells with one point of integration (doc/explicit.md, section 4).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** sum_a v_a w_a / m_a. */
    double
    product(const std::array<double, 8>   &v,
            const std::array<double, 8>   &w,
            const CellForces::NodalMasses &masses)
    {
      double sum = 0.;
      for (unsigned int a = 0; a < 8; ++a)
        sum += v[a] * w[a] / masses[a];
      return sum;
    }

    /** Upper bound of the largest eigenvalue of a symmetric, positive semidefinite matrix, see
     * largest_eigenvalue() in cell_stiffness.h. */
    double
    bound(FullMatrix<double> A)
    {
      FullMatrix<double> square(A.m(), A.m());
      double             logarithm = 0., power = 1.;
      for (unsigned int k = 0;; ++k)
        {
          const double trace = A.trace();
          if (!(trace > 0.))
            return trace;
          logarithm += std::log(trace) / power;
          if (k == 9)
            return std::exp(logarithm) * (1. + 1e-13);
          A /= trace;
          A.mmult(square, A);
          A = square;
          power *= 2.;
        }
    }
  } // namespace



  std::pair<double, double>
  OnePointCells::hourglass_frequency(const unsigned int c, const NodalMasses &masses) const
  {
    const OnePointBlock  &block = blocks[c / OnePointBlock::n_cells];
    const unsigned int    lane  = c % OnePointBlock::n_cells;
    std::array<double, 8> modes[OnePointBlock::n_modes], strains[dim];
    for (unsigned int a = 0; a < 8; ++a)
      {
        for (unsigned int i = 0; i < dim; ++i)
          strains[i][a] = block.gradients[dim * a + i][lane];
        for (unsigned int m = 0; m < OnePointBlock::n_modes; ++m)
          {
            modes[m][a] = hourglass_sign(m, a);
            for (unsigned int i = 0; i < dim; ++i)
              modes[m][a] -= block.warp[dim * m + i][lane] * strains[i][a];
          }
      }
    constexpr unsigned int n = OnePointBlock::n_modes;
    FullMatrix<double>     A(dim * n, dim * n);
    for (unsigned int r = 0; r < dim * n; ++r)
      for (unsigned int s = 0; s < dim * n; ++s)
        {
          double edges = 0.;
          for (unsigned int j = 0; j < dim; ++j)
            edges +=
              block.edges[dim * (r % dim) + j][lane] * block.edges[dim * (s % dim) + j][lane];
          A(r, s) = std::sqrt(block.stiffness[r][lane] * block.stiffness[s][lane]) * edges *
                    product(modes[r / dim], modes[s / dim], masses);
        }
    // Where the two kinds of motion are not orthogonal, as in distorted cells, the bound of the
    // cosine is the norm of C = G^{-1/2} (b, gamma) Gamma^{-1/2}, whose square is a trace.
    FullMatrix<double> G(dim, dim), Gamma(n, n), mixed(dim, n), left(dim, n), right(dim, n);
    for (unsigned int i = 0; i < dim; ++i)
      {
        for (unsigned int j = 0; j < dim; ++j)
          G(i, j) = product(strains[i], strains[j], masses);
        for (unsigned int m = 0; m < n; ++m)
          mixed(i, m) = product(strains[i], modes[m], masses);
      }
    for (unsigned int m = 0; m < n; ++m)
      for (unsigned int k = 0; k < n; ++k)
        Gamma(m, k) = product(modes[m], modes[k], masses);
    G.gauss_jordan();
    Gamma.gauss_jordan();
    G.mmult(left, mixed);
    mixed.mmult(right, Gamma);
    double cosine = 0.;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int m = 0; m < n; ++m)
        cosine += left(i, m) * right(i, m);
    return {bound(A), std::min(1., std::max(0., cosine))};
  }



  double
  OnePointCells::strain_frequency(const unsigned int c,
                                  const NodeField   &u,
                                  const NodalMasses &masses) const
  {
    // With A = dP/dF of a law without history the stiffness is V sum_a,b b_a A b_b; its largest
    // eigenvalue is that of V G A in the space of displacement gradients, made symmetric by the
    // root of G.
    const OnePointBlock    &block = blocks[c / OnePointBlock::n_cells];
    const unsigned int      lane  = c % OnePointBlock::n_cells;
    SymmetricTensor<2, dim> G;
    for (unsigned int a = 0; a < 8; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          G[i][j] +=
            block.gradients[dim * a + i][lane] * block.gradients[dim * a + j][lane] / masses[a];
    Tensor<2, dim> root;
    for (const auto &[value, vector] : eigenvectors(G))
      root += std::sqrt(std::max(0., value)) * outer_product(vector, vector);
    const Tensor<2, dim> F = displacement_gradient(c, u) + unit_symmetric_tensor<dim>();
    if (!(determinant(F) > 0.))
      return std::numeric_limits<double>::infinity();
    MaterialResponse response;
    law->respond({F, nullptr, 0.}, Demand::tangent, response, nullptr);
    // Root of G on the second index of both gradients.
    FullMatrix<double> A(dim * dim, dim * dim);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int k = 0; k < dim; ++k)
        {
          Tensor<2, dim> part;
          for (unsigned int j = 0; j < dim; ++j)
            part[j] = response.tangent[i][j][k];
          part = root * part * root;
          for (unsigned int j = 0; j < dim; ++j)
            for (unsigned int l = 0; l < dim; ++l)
              A(dim * i + j, dim * k + l) = block.volume[lane] * part[j][l];
        }
    // Of an even power: negative eigenvalues, of instable material, do no harm.
    return bound(A);
  }



  void
  OnePointCells::square_frequencies(const NodeField                &u,
                                    const std::vector<NodalMasses> &masses,
                                    std::vector<double>            &result)
  {
    // See KernelCells::square_frequencies().
    constexpr double change  = 0.02;
    const bool       tangent = finite && n_state == 0;
    result.resize(cells.size());
    estimate.resize(cells.size(), 0.);
    exact.resize(cells.size(), 0.);
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        if (!finite && estimate[c] > 0.)
          {
            result[c] = exact[c];
            continue;
          }
        const double now = one_point_frequency(corners(map, cell(c), finite ? &u : nullptr),
                                               body.material,
                                               masses[c]);
        if (!(std::abs(now / estimate[c] - 1.) < change))
          {
            double strain                  = tangent ? strain_frequency(c, u, masses[c]) : now;
            const auto [hourglass, cosine] = hourglass_frequency(c, masses[c]);
            // The largest eigenvalue of a sum of two operators whose ranges have this angle.
            exact[c] =
              0.5 * (strain + hourglass) +
              std::sqrt(std::pow(0.5 * (strain - hourglass), 2) + cosine * strain * hourglass);
            estimate[c] = now;
          }
        result[c] = exact[c] * (now / estimate[c]);
      }
  }
} // namespace Touchstone
