// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/broyden.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Touchstone
{
  namespace
  {
    double
    norm(const std::vector<double> &x)
    {
      return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.));
    }

    std::vector<double>
    difference_of(const std::vector<double> &a, const std::vector<double> &b)
    {
      std::vector<double> result(a);
      for (std::size_t k = 0; k < a.size(); ++k)
        result[k] -= b[k];
      return result;
    }
  } // namespace



  void
  broyden_update(std::vector<double>       &B,
                 const std::vector<double> &dx,
                 const std::vector<double> &dr)
  {
    // B += (dx - B dr) (dx^T B) / (dx^T B dr), of which only a part is taken where needed.
    const std::size_t   n = dx.size();
    std::vector<double> change(n), row(n);
    double              denominator = 0., square = 0.;
    for (std::size_t c = 0; c < n; ++c)
      for (std::size_t k = 0; k < n; ++k)
        {
          change[c] += B[c * n + k] * dr[k];
          row[k] += dx[c] * B[c * n + k];
        }
    for (std::size_t k = 0; k < n; ++k)
      {
        denominator += row[k] * dr[k];
        square += dx[k] * dx[k];
      }
    if (square == 0.)
      return;
    constexpr double smallest = 1e-3;
    const double     ratio    = denominator / square;
    const double     part =
      std::abs(ratio) >= smallest ? 1. : (1. - std::copysign(smallest, ratio)) / (1. - ratio);
    denominator = (1. - part) * square + part * denominator;
    for (std::size_t c = 0; c < n; ++c)
      for (std::size_t k = 0; k < n; ++k)
        B[c * n + k] += part * (dx[c] - change[c]) * row[k] / denominator;
  }



  void
  Broyden::begin(const Numbers &guess)
  {
    changes = n_differences = 0;
    cautious                = false;
    inverse.resize(guess.size() * guess.size());
    jump(guess);
  }



  void
  Broyden::jump(const Numbers &elsewhere)
  {
    present = elsewhere;
    last.clear();
    best.clear();
    difference.reset();
  }



  std::optional<Broyden::Numbers>
  Broyden::advance(const Numbers &residual, const Sizes &sizes)
  {
    const unsigned int n = residual.size();
    ++changes;
    if (difference)
      {
        columns.push_back(difference_of(residual, best_residual));
        for (double &entry : columns.back())
          entry /= width;
        if (*difference + 1 < n)
          {
            take_difference(*difference + 1, sizes);
            return {};
          }
        return end_differences(sizes);
      }
    learn(residual, sizes);
    // So far a step may go wrong before it is shortened; the method needs some freedom.
    const double growth = sizes.cautious ? 1. : 2.;
    if (!sizes.cautious || !cautious)
      longest = sizes.largest_step;
    cautious       = sizes.cautious;
    double allowed = longest;
    if (best.empty() || norm(residual) <= growth * norm(best_residual))
      {
        // A trust region: larger where changes of that size have taken a good part of the residual.
        constexpr double good = 0.75, nearly = 0.9, factor = 2.;
        if (cautious && !best.empty() && norm(residual) < good * norm(best_residual) &&
            norm(difference_of(present, best)) > nearly * longest)
          allowed = longest *= factor;
        // On from here, as from the best state.
        best          = present;
        best_residual = residual;
      }
    else
      allowed = std::min(longest, 0.5 * norm(difference_of(present, best)));
    if (n_differences < 2 && changes >= (n_differences + 1) * (8 + 3 * n))
      take_difference(0, sizes);
    else
      step_from_best(allowed);
    return {};
  }



  void
  Broyden::learn(const Numbers &residual, const Sizes &sizes)
  {
    const std::size_t n = residual.size();
    for (std::size_t k = 0; k < n; ++k)
      if (inverse[k * n + k] == 0.)
        inverse[k * n + k] = 1. / sizes.stiffness[k];
    if (!last.empty())
      {
        // Small changes say more of the round-off in forces than of the stiffness.
        constexpr double telling = 1e-6;
        const Numbers    dr      = difference_of(residual, last_residual);
        if (norm(dr) > telling * sizes.force)
          broyden_update(inverse, difference_of(present, last), dr);
      }
    last          = present;
    last_residual = residual;
  }



  void
  Broyden::step_from_best(const double allowed)
  {
    const std::size_t n = best.size();
    Numbers           step(n);
    for (std::size_t c = 0; c < n; ++c)
      for (std::size_t k = 0; k < n; ++k)
        step[c] -= inverse[c * n + k] * best_residual[k];
    const double length = norm(step), part = length > allowed ? allowed / length : 1.;
    for (std::size_t c = 0; c < n; ++c)
      present[c] = best[c] + part * step[c];
  }



  void
  Broyden::take_difference(const unsigned int k, const Sizes &sizes)
  {
    if (k == 0)
      columns.clear();
    difference = k;
    // Large beside the round-off of forces, small beside the motion that makes them.
    constexpr double part = 1e-3;
    width   = -std::copysign(part * sizes.force / sizes.stiffness[k], best_residual[k]);
    present = best;
    present[k] += width;
  }



  std::optional<Broyden::Numbers>
  Broyden::end_differences(const Sizes &sizes)
  {
    const unsigned int n = best.size();
    difference.reset();
    last.clear();
    ++n_differences;
    dealii::LAPACKFullMatrix<double> matrix(n, n);
    for (unsigned int c = 0; c < n; ++c)
      for (unsigned int k = 0; k < n; ++k)
        matrix(c, k) = columns[k][c];
    matrix.compute_svd();
    const double largest = *std::max_element(sizes.stiffness.begin(), sizes.stiffness.end());
    // What finite differences show is exact to about so much of what is expected.
    constexpr double smallest = 1e-5;
    const double     bound    = smallest * std::max(largest, matrix.singular_value(0));
    if (!(matrix.singular_value(n - 1) > bound))
      {
        Numbers direction(n);
        for (unsigned int k = 0; k < n; ++k)
          direction[k] = matrix.get_svd_vt()(n - 1, k);
        return direction;
      }
    std::fill(inverse.begin(), inverse.end(), 0.);
    for (unsigned int c = 0; c < n; ++c)
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int i = 0; i < n; ++i)
          inverse[c * n + k] +=
            matrix.get_svd_vt()(i, c) * matrix.get_svd_u()(k, i) / matrix.singular_value(i);
    step_from_best(longest);
    return {};
  }
} // namespace Touchstone
