// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/one_point_cells.h>
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
    const OnePointBlock  &of   = block_of(c);
    const unsigned int    lane = c % OnePointBlock::n_cells;
    std::array<double, 8> modes[OnePointBlock::n_modes], strains[dim];
    for (unsigned int a = 0; a < 8; ++a)
      {
        for (unsigned int i = 0; i < dim; ++i)
          strains[i][a] = of.gradient(a, i, lane);
        for (unsigned int m = 0; m < OnePointBlock::n_modes; ++m)
          modes[m][a] = of.mode(m, a, lane);
      }
    constexpr unsigned int n = OnePointBlock::n_modes;
    FullMatrix<double>     A(dim * n, dim * n);
    for (unsigned int r = 0; r < dim * n; ++r)
      for (unsigned int s = 0; s < dim * n; ++s)
        {
          double edges = 0.;
          for (unsigned int j = 0; j < dim; ++j)
            edges +=
              of.positions[dim * (r % dim) + j][lane] * of.positions[dim * (s % dim) + j][lane];
          A(r, s) = std::sqrt(stiffness(c, r / dim, r % dim) * stiffness(c, s / dim, s % dim)) *
                    edges * product(modes[r / dim], modes[s / dim], masses);
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
  OnePointCells::coupled_frequency(const unsigned int c,
                                   const NodeField   &u,
                                   const NodalMasses &masses) const
  {
    // The stiffness is C^T L C with the displacement gradients and the hourglass amplitudes C and
    // with L, the tangent of the law times the volume and the stiffness of the modes. Its nonzero
    // eigenvalues against the masses are those of L G, G = C M^{-1} C^T, of 9 + 12 rows. Laws
    // without history have a tangent on the undeformed cell; others are taken for elastic on the
    // present one.
    const OnePointBlock &of   = block_of(c);
    const unsigned int   lane = c % OnePointBlock::n_cells;
    const Tensor<2, dim> unit(unit_symmetric_tensor<dim>());
    const Tensor<2, dim> F = finite ? displacement_gradient(c, u) + unit : unit;
    if (!(determinant(F) > 0.))
      return std::numeric_limits<double>::infinity();
    MaterialResponse response;
    Tensor<2, dim>   push    = unit;
    double           volume  = of.volume[lane];
    const double     stretch = eigenvalues(symmetrize(transpose(F) * F))[0];
    if (finite && states.size() == 0)
      law.law()->respond({F, nullptr, 0.}, Demand::tangent, response, nullptr);
    else
      {
        const double mu     = body.material.shear_modulus(),
                     lambda = body.material.bulk_modulus() - 2. / 3. * mu;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              response.tangent[i][i][j][j] += lambda;
              response.tangent[i][j][i][j] += mu;
              response.tangent[i][j][j][i] += mu;
            }
        push = invert(F);
        volume *= determinant(F);
      }
    constexpr unsigned int n_strains = dim * dim, n_all = n_strains + dim * OnePointBlock::n_modes;
    // Of each row of C the nodal values and the direction.
    std::array<double, 8> values[n_all];
    Tensor<1, dim>        directions[n_all];
    for (unsigned int a = 0; a < 8; ++a)
      {
        Tensor<1, dim> gradient;
        for (unsigned int j = 0; j < dim; ++j)
          gradient[j] = of.gradient(a, j, lane);
        const Tensor<1, dim> moved = gradient * push;
        for (unsigned int r = 0; r < n_strains; ++r)
          values[r][a] = moved[r % dim];
        for (unsigned int m = 0; m < OnePointBlock::n_modes; ++m)
          {
            for (unsigned int i = 0; i < dim; ++i)
              values[n_strains + dim * m + i][a] = of.mode(m, a, lane);
          }
      }
    for (unsigned int r = 0; r < n_all; ++r)
      for (unsigned int j = 0; j < dim; ++j)
        directions[r][j] =
          r < n_strains ? unit[r / dim][j] : of.positions[dim * ((r - n_strains) % dim) + j][lane];
    FullMatrix<double> L(n_all, n_all), G(n_all, n_all), both(n_all, n_all);
    for (unsigned int r = 0; r < n_all; ++r)
      for (unsigned int s = 0; s < n_all; ++s)
        {
          const double cosine = directions[r] * directions[s];
          G(r, s)             = cosine == 0. ? 0. : cosine * product(values[r], values[s], masses);
          if (r < n_strains && s < n_strains)
            L(r, s) = volume * response.tangent[r / dim][r % dim][s / dim][s % dim];
          else if (r == s)
            L(r, s) = stretch * stiffness(c, (r - n_strains) / dim, (r - n_strains) % dim);
        }
    L.mmult(both, G);
    return bound(both);
  }



  void
  OnePointCells::square_frequencies(const NodeField &u, std::vector<double> &result)
  {
    if (!finite && !exact.empty())
      {
        result = exact;
        return;
      }
    set_one_point_frequencies(u, result);
    if (!finite)
      {
        for (unsigned int c = 0; c < cells.size(); ++c)
          {
            // In boxes, most of all cells, both kinds of motion are orthogonal.
            const NodalMasses m            = masses(c);
            const auto [hourglass, cosine] = hourglass_frequency(c, m);
            result[c] =
              cosine > 1e-24 ? coupled_frequency(c, u, m) : std::max(result[c], hourglass);
          }
        exact = result;
        return;
      }
    // See KernelCells::square_frequencies().
    constexpr double change = 0.02;
    estimate.resize(cells.size(), 0.);
    exact.resize(cells.size(), 0.);
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const double now = result[c];
        if (!(std::abs(now / estimate[c] - 1.) < change))
          {
            exact[c]    = coupled_frequency(c, u, masses(c));
            estimate[c] = now;
          }
        result[c] = exact[c] * (now / estimate[c]);
      }
  }
} // namespace Touchstone
