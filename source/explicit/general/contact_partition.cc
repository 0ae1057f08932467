// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/contact_partition.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

// Recursive coordinate bisection of points that are spread over the ranks: no rank ever holds those
// of others. The cuts depend on the points alone, and contact does not depend on the cuts.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Regions are cut anew when the largest has more than so many times the mean. */
    constexpr double uneven = 1.2;

    /** Halvings of an interval that find a cut: to the round-off of float, more is not needed. */
    constexpr unsigned int n_halvings = 30;
  } // namespace



  ContactPartition::ContactPartition(const MPI_Comm communicator)
    : communicator(communicator)
    , n_ranks(Utilities::MPI::n_mpi_processes(communicator))
    , cuts(n_ranks - 1)
  {
  }



  unsigned int
  ContactPartition::owner(const Point<dim> &point) const
  {
    unsigned int first = 0, n = n_ranks, cut = 0;
    while (n > 1)
      {
        const unsigned int lower = lower_half(n);
        if (point[cuts[cut].axis] < cuts[cut].position)
          {
            n = lower;
            ++cut;
          }
        else
          {
            first += lower;
            n -= lower;
            cut += lower;
          }
      }
    return first;
  }



  double
  ContactPartition::imbalance(const std::vector<Point<dim>> &points) const
  {
    std::vector<std::uint64_t> counts(n_ranks);
    for (const Point<dim> &point : points)
      ++counts[owner(point)];
    // One number for each rank on each rank: as many as there are cuts.
    Utilities::MPI::sum(counts, communicator, counts);
    std::uint64_t sum = 0, largest = 0;
    for (const std::uint64_t count : counts)
      {
        sum += count;
        largest = std::max(largest, count);
      }
    return sum > 0 ? double(largest) * n_ranks / sum : 1.;
  }



  double
  ContactPartition::balance(const std::vector<Point<dim>> &points)
  {
    if (n_ranks == 1)
      return 1.;
    if (!cut_anew)
      if (const double present = imbalance(points); present <= uneven)
        return present;
    cut_anew                       = false;
    std::vector<Point<dim>> sorted = points;
    bisect(sorted, 0, sorted.size(), n_ranks, 0);
    return imbalance(points);
  }



  // The points from begin to end go to n ranks: cut across the longest side of what they fill.
  void
  ContactPartition::bisect(std::vector<Point<dim>> &points,
                           const std::size_t        begin,
                           const std::size_t        end,
                           const unsigned int       n,
                           const unsigned int       cut)
  {
    if (n == 1)
      return;
    std::array<double, 2 * dim> bounds;
    bounds.fill(-std::numeric_limits<double>::max());
    for (std::size_t i = begin; i < end; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          bounds[d]       = std::max(bounds[d], points[i][d]);
          bounds[dim + d] = std::max(bounds[dim + d], -points[i][d]);
        }
    std::array<double, 2 * dim> largest;
    Utilities::MPI::max(ArrayView<const double>(bounds.data(), bounds.size()),
                        communicator,
                        ArrayView<double>(largest.data(), largest.size()));
    unsigned int axis = 0;
    for (unsigned int d = 1; d < dim; ++d)
      if (largest[d] + largest[dim + d] > largest[axis] + largest[dim + axis])
        axis = d;
    const unsigned int  lower  = lower_half(n);
    const std::uint64_t total  = Utilities::MPI::sum<std::uint64_t>(end - begin, communicator);
    const std::uint64_t wanted = total * lower / n;
    double              from = -largest[dim + axis], to = largest[axis];
    for (unsigned int i = 0; i < n_halvings && total > 0; ++i)
      {
        const double  middle = 0.5 * (from + to);
        std::uint64_t below  = 0;
        for (std::size_t p = begin; p < end; ++p)
          below += points[p][axis] < middle;
        (Utilities::MPI::sum(below, communicator) < wanted ? from : to) = middle;
      }
    cuts[cut].axis     = axis;
    cuts[cut].position = 0.5 * (from + to);
    const auto split =
      std::partition(points.begin() + begin, points.begin() + end, [&](const Point<dim> &point) {
        return point[axis] < cuts[cut].position;
      });
    const std::size_t middle = split - points.begin();
    bisect(points, begin, middle, lower, cut + 1);
    bisect(points, middle, end, n - lower, cut + lower);
  }
} // namespace Touchstone
