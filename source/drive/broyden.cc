// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/broyden.h>

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

    // Of all forces; smaller changes say more of the round-off in these than of the stiffness.
    constexpr double telling = 1e-6;

    double
    stiffest(const Broyden::Sizes &sizes)
    {
      return *std::max_element(sizes.stiffness.begin(), sizes.stiffness.end());
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
    columns.clear();
    directions.clear();
  }



  void
  Broyden::move(const Numbers &elsewhere)
  {
    present = elsewhere;
  }



  std::optional<Broyden::Numbers>
  Broyden::advance(const Numbers &residual, const Sizes &sizes)
  {
    const unsigned int n = residual.size();
    ++changes;
    if (in_differences())
      {
        columns.push_back(difference_of(residual, best_residual));
        for (double &entry : columns.back())
          entry /= width;
        if (columns.size() == n)
          doubt_soft_directions(sizes);
        if (columns.size() == directions.size())
          return end_differences();
        take_difference(sizes);
        return {};
      }
    learn(residual, sizes);
    // So far a step may go wrong before it is shortened; the method needs some freedom.
    const double growth = sizes.cautious ? 1. : 2.;
    if (!sizes.cautious || !cautious)
      longest = sizes.largest_step;
    cautious       = sizes.cautious;
    double allowed = longest;
    // Where residuals are little more than what is left of the last solution of the bodies, none is
    // better than another.
    if (best.empty() || norm(residual) <= growth * norm(best_residual) ||
        norm(residual) <= telling * sizes.force)
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
      {
        directions.assign(n, Numbers(n));
        for (unsigned int k = 0; k < n; ++k)
          directions[k][k] = 1.;
        take_difference(sizes);
      }
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
        const Numbers dr = difference_of(residual, last_residual);
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
  Broyden::take_difference(const Sizes &sizes)
  {
    const std::size_t n = best.size(), k = columns.size();
    // Large beside the round-off of forces, small beside the motion that makes them; in directions
    // that look soft a thousand times as large, for round-off may be all that has been seen.
    constexpr double part = 1e-3;
    const Numbers   &way  = directions[k];
    width = k < n ? part * sizes.force / sizes.stiffness[k] : sizes.force / stiffest(sizes);
    // Along what is missing, where obstacles come to bodies that they do not touch.
    width *=
      -std::copysign(1., std::inner_product(way.begin(), way.end(), best_residual.begin(), 0.));
    present = best;
    for (std::size_t c = 0; c < n; ++c)
      present[c] += width * way[c];
  }



  dealii::LAPACKFullMatrix<double>
  Broyden::derivatives() const
  {
    const unsigned int               n = best.size();
    dealii::LAPACKFullMatrix<double> matrix(n, n);
    for (unsigned int c = 0; c < n; ++c)
      for (unsigned int k = 0; k < n; ++k)
        matrix(c, k) = columns[k][c];
    // Soft directions, orthogonal to each other, as the larger differences have them.
    for (unsigned int i = n; i < columns.size(); ++i)
      for (unsigned int c = 0; c < n; ++c)
        {
          double change = columns[i][c];
          for (unsigned int k = 0; k < n; ++k)
            change -= columns[k][c] * directions[i][k];
          for (unsigned int k = 0; k < n; ++k)
            matrix(c, k) += change * directions[i][k];
        }
    return matrix;
  }



  void
  Broyden::doubt_soft_directions(const Sizes &sizes)
  {
    const unsigned int n      = best.size();
    auto               matrix = derivatives();
    matrix.compute_svd();
    // Small differences are exact to about so much of what is expected. The end of a slender beam
    // may be softer, and is held all the same.
    constexpr double smallest = 1e-5;
    floor                     = std::max(stiffest(sizes), matrix.singular_value(0));
    for (unsigned int i = 0; i < n; ++i)
      if (!(matrix.singular_value(i) > smallest * floor))
        {
          Numbers direction(n);
          for (unsigned int k = 0; k < n; ++k)
            direction[k] = matrix.get_svd_vt()(i, k);
          directions.push_back(direction);
        }
    constexpr double smallest_of_large = 1e-8;
    floor *= smallest_of_large;
  }



  std::optional<Broyden::Numbers>
  Broyden::end_differences()
  {
    const unsigned int n      = best.size();
    auto               matrix = derivatives();
    columns.clear();
    directions.clear();
    last.clear();
    ++n_differences;
    matrix.compute_svd();
    if (!(matrix.singular_value(n - 1) > floor))
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
