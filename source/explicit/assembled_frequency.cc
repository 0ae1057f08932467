// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exact_sum.h>
#include <touchstone/explicit/assembled_frequency.h>

#include <algorithm>
#include <cmath>
#include <limits>

// The largest frequency of the mesh as a whole (doc/explicit.md, section 4).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** What is added to the largest Ritz value, and the probability that this is too little. */
    constexpr double margin = 0.02, risk = 1e-10;

    /** Of the difference of displacements, relative to the size of cells. */
    constexpr double difference = 1e-6;

    /** Iterations after which the error exceeds the margin with that probability: theorem 4.2 of
     * Kuczynski and Wozniakowski (1992), SIAM J. Matrix Anal. Appl. 13. */
    unsigned int
    n_iterations(const double n_unknowns)
    {
      return std::ceil(0.5 *
                       (1. + std::log(1.648 * std::sqrt(n_unknowns) / risk) / std::sqrt(margin)));
    }

    /** A number that is as good as random, normally distributed, from a key (splitmix64, and the
     * sum of twelve uniform numbers). */
    double
    scattered(std::uint64_t key)
    {
      double sum = -6.;
      for (unsigned int i = 0; i < 12; ++i)
        {
          key += 0x9e3779b97f4a7c15ULL;
          std::uint64_t z = key;
          z               = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
          z               = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
          z ^= z >> 31;
          sum += static_cast<double>(z >> 11) * 0x1p-53;
        }
      return sum;
    }

    double
    product(const NodeMap &map, const NodeField &a, const NodeField &b)
    {
      ExactSum sum;
      for (unsigned int i = 0; i < map.n_owned(); ++i)
        sum.add(a[i] * b[i]);
      return sum.value(map.communicator());
    }

    /** The largest eigenvalue of a symmetric tridiagonal matrix, by bisection with Sturm's count,
     * rounded up. */
    double
    largest_eigenvalue(const std::vector<double> &diagonal, const std::vector<double> &beside)
    {
      double high = 0.;
      for (std::size_t i = 0; i < diagonal.size(); ++i)
        high = std::max(high,
                        diagonal[i] + (i > 0 ? std::abs(beside[i - 1]) : 0.) +
                          (i < beside.size() ? std::abs(beside[i]) : 0.));
      double low = 0.;
      while (high - low > 1e-12 * high)
        {
          const double middle = 0.5 * (low + high);
          bool         above  = false;
          double       pivot  = 1.;
          for (std::size_t i = 0; i < diagonal.size() && !above; ++i)
            {
              const double b = i > 0 ? beside[i - 1] : 0.;
              pivot          = diagonal[i] - middle - b * b / pivot;
              if (pivot == 0.)
                pivot = std::numeric_limits<double>::min();
              above = pivot > 0.;
            }
          (above ? low : high) = middle;
        }
      return high;
    }
  } // namespace



  double
  assembled_square_frequency(const NodeMap                                       &map,
                             const std::vector<double>                           &masses,
                             const NodeField                                     &u,
                             const std::function<void(NodeField &, NodeField &)> &force,
                             const double                                         size)
  {
    const unsigned int n = map.n_owned();
    NodeField          moved(u), at_rest(map.n_local()), there(map.n_local());
    force(moved, at_rest);
    ExactSum count;
    count.add(dim * n);
    const double n_unknowns = count.value(map.communicator());

    NodeField q(n), before(n), next(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        q[i][d] = scattered(dim * map.key(i) + d);
    const double length = std::sqrt(product(map, q, q));
    for (unsigned int i = 0; i < n; ++i)
      q[i] /= length;
    std::vector<double> diagonal, beside;
    const auto          steps = std::min<double>(n_iterations(n_unknowns), n_unknowns);
    while (diagonal.size() < steps)
      {
        // M^-1/2 K M^-1/2 q.
        double largest = 0.;
        for (unsigned int i = 0; i < n; ++i)
          largest = std::max(largest, q[i].norm() / std::sqrt(masses[i]));
        const double by = difference * size / Utilities::MPI::max(largest, map.communicator());
        for (unsigned int i = 0; i < n; ++i)
          moved[i] = u[i] + (by / std::sqrt(masses[i])) * q[i];
        map.update_ghosts(moved);
        force(moved, there);
        for (unsigned int i = 0; i < n; ++i)
          next[i] = (1. / (by * std::sqrt(masses[i]))) * (at_rest[i] - there[i]);
        diagonal.push_back(product(map, q, next));
        for (unsigned int i = 0; i < n; ++i)
          next[i] -= diagonal.back() * q[i] +
                     (beside.empty() ? Tensor<1, dim>() : beside.back() * before[i]);
        const double rest = std::sqrt(product(map, next, next));
        // Round-off of the differences: all that the start vector leads to has been found.
        if (!(rest > 1e-8 * std::abs(diagonal.front())))
          break;
        beside.push_back(rest);
        before.swap(q);
        for (unsigned int i = 0; i < n; ++i)
          q[i] = next[i] / rest;
      }
    beside.resize(diagonal.size() - 1);
    return largest_eigenvalue(diagonal, beside) / (1. - margin);
  }
} // namespace Touchstone
