// SPDX-License-Identifier: LGPL-2.1-or-later
// Recursive coordinate bisection of points among the ranks: regions with equally many points
// wherever these come from, cut anew when they have moved, and each point in one region, which a
// box around it meets.

#include <touchstone/explicit/general/contact_partition.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>
#include <random>
#include <set>

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** Largest region over the mean, for points that can be divided. */
  constexpr double even = 1.01;

  void
  print(const std::string &what, const bool here)
  {
    const bool all = Utilities::MPI::min(static_cast<int>(here), MPI_COMM_WORLD) == 1;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << what << ": " << (all ? "yes" : "NO") << std::endl;
  }

  /** The largest number of points of a region over the mean, counted by their owners. */
  double
  counted(const ContactPartition &partition, const std::vector<Point<dim>> &points)
  {
    std::vector<unsigned int> counts(Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
    for (const Point<dim> &point : points)
      ++counts.at(partition.owner(point));
    Utilities::MPI::sum(counts, MPI_COMM_WORLD, counts);
    return *std::max_element(counts.begin(), counts.end()) * double(counts.size()) /
           std::accumulate(counts.begin(), counts.end(), 0.);
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int               me = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  // Most points are on the first rank, as where its cells have all that touches, and dense at one
  // end.
  std::mt19937            generator(7 + me);
  const auto              any = [&] { return generator() / double(std::mt19937::max()); };
  std::vector<Point<dim>> points(me == 0 ? 4000 : 500);
  for (Point<dim> &point : points)
    point = {3. * std::pow(any(), 4), any(), 0.1 * any()};

  ContactPartition partition(MPI_COMM_WORLD);
  const double     first = partition.balance(points);
  print("regions have equally many points", first < even);
  print("as their owners count them", std::abs(first - counted(partition, points)) < 1e-12);

  bool meets = true;
  for (const Point<dim> &point : points)
    {
      BoundingBox<dim> box(std::make_pair(point, point));
      box.extend(0.05);
      std::set<unsigned int> ranks;
      partition.for_each_owner(box, [&](const unsigned int rank) { ranks.insert(rank); });
      meets = meets && ranks.count(partition.owner(point)) == 1;
      for (unsigned int corner = 0; corner < 8; ++corner)
        meets = meets && ranks.count(partition.owner(box.vertex(corner))) == 1;
    }
  print("a box meets the regions of its points", meets);

  const auto as_owned = [&] {
    std::vector<unsigned int> owners;
    for (const Point<dim> &point : points)
      owners.push_back(partition.owner(point));
    return owners;
  };
  const auto before = as_owned();
  partition.balance(points);
  print("cuts stay as long as points do", as_owned() == before);
  // Half of the points move to the other end: as they are, regions would be far from even.
  for (std::size_t i = 0; i < points.size(); i += 2)
    points[i][0] = 6. - points[i][0];
  print("points that move leave regions uneven", counted(partition, points) > 1.2);
  print("and are divided anew", partition.balance(points) < even);
  return 0;
}
