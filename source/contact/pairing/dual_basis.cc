// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/dual_basis.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>

// The weight functions of averaged rows. The formulas are in the header; here with the matrices of
// one slave face (4 or 9 functions).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** S M~^-1; @p mass becomes the inverse of the regularised M~.
     *
     * On a sliver the mass matrix is singular to working precision, so a small multiple of its
     * trace is added to the diagonal. Iterative refinement removes the effect of this addition from
     * the weights, not from the inverse: the weights of nodes that receive the shares of others are
     * moderate and leave small residuals, however thin the sliver. */
    FullMatrix<double>
    divide_by_mass(const CoverShares &shares, FullMatrix<double> &mass)
    {
      constexpr unsigned int   n_refinements = 4;
      const unsigned int       n             = mass.m();
      const FullMatrix<double> original(mass);
      const double             addition = Tolerances::mass_regularisation * mass.trace();
      for (unsigned int i = 0; i < n; ++i)
        mass(i, i) += addition;
      mass.gauss_jordan();
      FullMatrix<double> result(n, n), residual(n, n);
      for (unsigned int step = 0; step < n_refinements; ++step)
        {
          result.mmult(residual, original);
          for (unsigned int k = 0; k < n; ++k)
            for (unsigned int i = 0; i < n; ++i)
              residual(k, i) = shares.share[k][i] - residual(k, i);
          // result += (S - result M~) (M~ + addition)^-1.
          residual.mmult(result, mass, /*adding=*/true);
        }
      return result;
    }
  } // namespace



  DualBasis::DualBasis(const FullMatrix<double> &mass,
                       const Values             &shape_areas,
                       const TraceBasis         *basis,
                       const Values             &whole,
                       const CoverShares::Whole &at_once,
                       const bool                with_derivative)
    : areas(basis ? basis->apply(shape_areas) : shape_areas)
    , shares(mass.m(), areas, whole, at_once, with_derivative)
    , basis(basis)
    , inverse(mass)
  {
    if (mass.m() == Face::max_nodes)
      set_positive_parts();
    if (!basis)
      {
        weights = divide_by_mass(shares, inverse);
        return;
      }
    // Hanging nodes: M~ = C^T M C, W = S M~^-1 C^T (equation (27)).
    const FullMatrix<double> transposed = to_basis(mass.m());
    FullMatrix<double>       product(mass.m(), mass.m());
    // M~ = C^T M C, then S M~^-1, then times C^T.
    product.triple_product(mass, transposed, transposed, false, true);
    inverse = product;
    product = divide_by_mass(shares, inverse);
    weights.reinit(mass.m(), mass.m());
    product.mmult(weights, transposed);
  }



  void
  DualBasis::set_positive_parts()
  {
    // Biquadratic functions have their values at the nodes as coefficients: along a side the
    // straight line to an end has 1/2 in the middle.
    const auto along = [](const unsigned int a, const unsigned int b) {
      return a == b ? 1. : a != 1 && b == 1 ? 0.5 : 0.;
    };
    constexpr unsigned int n = Face::max_nodes, side = 3;
    positive_parts.reinit(n, n);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int i = 0; i < n; ++i)
        if (const double c = shape(k, i); c != 0.)
          for (unsigned int j = 0; j < n; ++j)
            positive_parts(k, j) += c * along(i % side, j % side) * along(i / side, j / side);
  }



  FullMatrix<double>
  DualBasis::to_basis(const unsigned int n) const
  {
    FullMatrix<double> result(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int p = 0; p < n; ++p)
        // C^T, with C_ip the weight of node p in the hanging node i.
        result(p, i) = basis->weights[i][p];
    return result;
  }



  DualBasis::Solution
  DualBasis::solve(const FullMatrix<double> &q) const
  {
    Solution result{FullMatrix<double>(q.m(), q.n()), FullMatrix<double>(q.m(), q.n())};
    if (!basis)
      {
        inverse.mmult(result.of_basis, q);
        result.of_shapes = result.of_basis;
        return result;
      }
    // Y = M~^-1 C^T Q, and C Y, which the derivative needs with dM.
    const FullMatrix<double> transposed = to_basis(q.m());
    FullMatrix<double>       of_trace(q.m(), q.n());
    transposed.mmult(of_trace, q);
    inverse.mmult(result.of_basis, of_trace);
    transposed.Tmmult(result.of_shapes, result.of_basis);
    return result;
  }



  DualBasis::Values
  DualBasis::share_derivative(const unsigned int k, const Values &d_areas) const
  {
    const unsigned int n = weights.m();
    Values             result{};
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int l = 0; l < n; ++l)
        // S_ki = T_ki a_i depends on all areas of the face, because T does on their mean cover.
        result[i] += shares.derivative[k][i][l] * d_areas[l];
    return result;
  }



  void
  DualBasis::differentiate(const unsigned int      k,
                           const Solution         &solution,
                           const Values           &d_share,
                           const Table<3, double> &d_mass,
                           const Table<3, double> &d_q,
                           const unsigned int      v,
                           ArrayView<double>       result) const
  {
    const unsigned int n = weights.m(), n_columns = result.size();
    std::fill(result.begin(), result.end(), 0.);
    for (unsigned int i = 0; i < n; ++i)
      // The term dS_k Y; then W_k (dQ - dM C Y) row by row.
      if (d_share[i] != 0.)
        for (unsigned int c = 0; c < n_columns; ++c)
          result[c] += d_share[i] * solution.of_basis(i, c);
    for (unsigned int j = 0; j < n; ++j)
      {
        // Only row k of W is needed, so no product of full matrices.
        double of_mass = 0.; // (W_k dM)_j
        for (unsigned int i = 0; i < n; ++i)
          of_mass += weights(k, i) * d_mass(v, i, j);
        const double  w  = weights(k, j);
        const double *dq = &d_q(v, j, 0), *x = &solution.of_shapes(j, 0);
        for (unsigned int c = 0; c < n_columns; ++c)
          result[c] += w * dq[c] - of_mass * x[c];
      }
  }
} // namespace Touchstone
