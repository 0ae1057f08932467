// SPDX-License-Identifier: LGPL-2.1-or-later
// Which ranks have boxes near others: those that a list of all boxes says, and few besides; without
// any list of all ranks, by a count of what is gathered. The same of what is asked of the owners of
// dofs, and of the first list of all ranks.

#include <touchstone/base/ask_owners.h>
#include <touchstone/base/first_of_ranks.h>
#include <touchstone/base/near_ranks.h>

#include <iostream>
#include <random>

namespace
{
  /** Calls that send something of each rank to all. */
  unsigned int gathered = 0;
} // namespace

// PETSc counts calls of its own by macros of these names.
#undef MPI_Allgather
#undef MPI_Allgatherv

// The interface that MPI offers for such counts.
extern "C" int
MPI_Allgatherv(const void  *from,
               int          n,
               MPI_Datatype type,
               void        *to,
               const int    numbers[],
               const int    begin[],
               MPI_Datatype type_to,
               MPI_Comm     communicator)
{
  ++gathered;
  return PMPI_Allgatherv(from, n, type, to, numbers, begin, type_to, communicator);
}

extern "C" int
MPI_Allgather(const void  *from,
              int          n,
              MPI_Datatype type,
              void        *to,
              int          number,
              MPI_Datatype type_to,
              MPI_Comm     communicator)
{
  ++gathered;
  return PMPI_Allgather(from, n, type, to, number, type_to, communicator);
}

using namespace Touchstone;
using namespace dealii;

namespace
{
  using Box = BoundingBox<dim>;

  struct Corners
  {
    Point<dim> lower, upper;
  };

  void
  check(const std::string &what, const bool here)
  {
    const bool all = Utilities::MPI::min(static_cast<int>(here), MPI_COMM_WORLD) == 1;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << what << ": " << (all ? "OK" : "FAILED") << std::endl;
  }

  /** Boxes of up to @p size on a plane, those of each rank in a strip of it that is wider by
   * @p beyond on both sides. */
  std::vector<Box>
  strip(std::mt19937      &generator,
        const unsigned int n,
        const double       size,
        const double       beyond,
        const unsigned int rank)
  {
    const auto       any = [&]() { return generator() / double(std::mt19937::max()); };
    std::vector<Box> result;
    for (unsigned int k = 0; k < n; ++k)
      {
        const Point<dim> lower(rank - beyond + (1. + 2. * beyond) * any(), 4. * any(), 0.);
        const Point<dim> upper(lower[0] + size * any(), lower[1] + size * any(), size * any());
        result.push_back(Box({lower, upper}));
      }
    return result;
  }

  /** @return how many ranks are found for a box in the mean; negative if one is missing. */
  double
  against_all(const std::vector<Box> &boxes, const std::vector<Box> &wanted)
  {
    const auto           found = near_ranks(boxes, wanted, MPI_COMM_WORLD);
    std::vector<Corners> mine;
    for (const Box &box : boxes)
      mine.push_back({box.get_boundary_points().first, box.get_boundary_points().second});
    const auto all  = gather_records(mine, MPI_COMM_WORLD);
    double     n    = 0.;
    bool       here = true;
    for (std::size_t k = 0; k < wanted.size(); ++k)
      {
        n += found[k].size();
        here = here && std::is_sorted(found[k].begin(), found[k].end());
        for (unsigned int rank = 0; rank < all.size(); ++rank)
          {
            bool meets = false;
            for (const Corners &one : all[rank])
              meets = meets || Box({one.lower, one.upper}).get_neighbor_type(wanted[k]) !=
                                 NeighborType::not_neighbors;
            here = here && (!meets || std::binary_search(found[k].begin(), found[k].end(), rank));
          }
      }
    return here ? n / std::max<std::size_t>(1, wanted.size()) : -1.;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int               rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const unsigned int               n    = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  std::mt19937                     generator(7 + rank);

  const auto boxes = strip(generator, 200, 0.05, 0., rank);
  double     near  = against_all(boxes, strip(generator, 200, 0.05, 0., rank));
  check("all that are near, few others", near >= 0. && near < 1.5);
  check("strips that overlap", against_all(boxes, strip(generator, 200, 0.05, 1., rank)) >= 0.);
  check("boxes 1 : 100", against_all(boxes, strip(generator, 200, 5., 1., rank)) >= 0.);
  near = against_all(rank == n - 1 ? boxes : std::vector<Box>(), boxes);
  check("the last rank alone has some", near >= (rank == n - 1 ? 0.9 : 0.) && near <= 1.);
  check("none has any", against_all({}, boxes) == 0.);
  check("none asks", against_all(boxes, {}) == 0.);
  // All at one place, as at the start of a search in a point.
  check("all at one place",
        against_all({Box({Point<dim>(), Point<dim>()})}, {Box({Point<dim>(), Point<dim>()})}) == n);

  // Each rank owns 10 dofs and asks for a square about those from 5 before to 15 behind.
  IndexSet owned(10 * n);
  owned.add_range(10 * rank, 10 * rank + 10);
  std::vector<Index> asked;
  for (Index dof = 10 * rank < 5 ? 0 : 10 * rank - 5; dof < std::min<Index>(10 * n, 10 * rank + 25);
       ++dof)
    asked.push_back(dof);
  std::reverse(asked.begin(), asked.end());
  const auto dof_of = [](const Index dof) { return dof; };
  const auto squares =
    ask_owners<double>(asked, owned, MPI_COMM_WORLD, dof_of, [&](const Index dof) {
      return owned.is_element(dof) ? double(dof) * dof : -1.;
    });
  bool right = squares.size() == asked.size();
  for (std::size_t k = 0; right && k < asked.size(); ++k)
    right = squares[k] == double(asked[k]) * asked[k];
  check("what owners answer", right);
  const auto even = known_to_owners(asked, owned, MPI_COMM_WORLD, dof_of, [](const Index dof) {
    return dof % 2 == 0;
  });
  right           = 2 * even.size() + 1 >= asked.size() && 2 * even.size() <= asked.size() + 1;
  for (const Index dof : even)
    right = right && dof % 2 == 0;
  check("what owners know", right);

  std::vector<double> list{1., double((rank + 1) % 2), double(n - rank)};
  const auto          first = first_of_ranks(list, 3, MPI_COMM_WORLD);
  // Odd ranks have a zero, and the last of them the smallest third number.
  const unsigned int of = n == 1 ? 0 : n % 2 == 0 ? n - 1 : n - 2;
  check("the first of all lists",
        first == std::vector<double>{1., n == 1 ? 1. : 0., double(n - of)});
  check("no list", first_of_ranks({}, 3, MPI_COMM_WORLD).empty());

  gathered = 0;
  near_ranks(boxes, boxes, MPI_COMM_WORLD);
  known_to_owners(asked, owned, MPI_COMM_WORLD, dof_of, [](const Index) { return true; });
  first_of_ranks(list, 3, MPI_COMM_WORLD);
  check("nothing is gathered on all ranks", gathered == 0);
  gather_all(asked, MPI_COMM_WORLD);
  check("what is gathered is counted", n == 1 || gathered == 2);
  return 0;
}
