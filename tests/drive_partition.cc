// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact does not respect the partition: a block pressed on another and drawn over it, with
// friction, on one rank and on several, to the same result node by node. The bodies
// have one layer of cells, numbered in rows, so that ranks cut the surfaces of both
// in the middle of a row, and master faces are hardly ever with the rank of their slave nodes.
// What each rank owns is printed.

#include "drive_support.h"
#include <map>

using namespace Touchstone;
using namespace dealii;

namespace
{
  // Contact weighs nothing, or ranks would cut the surfaces elsewhere; by coordinates they
  // would share them fairly.
  const std::vector<std::string> one_layer = {"Discretisation/Contact weight=0",
                                              "Discretisation/Partitioner=p4est",
                                              "Body base/Geometry/Cells=6, 5, 1",
                                              "Body block/Geometry/Cells=5, 4, 1"};

  const std::vector<std::string> more_slaves = {"Discretisation/Partitioner=p4est",
                                                "Body base/Geometry/Cells=5, 4, 1",
                                                "Body block/Geometry/Cells=6, 5, 1"};

  /** Numbers of all slave nodes, by their place. */
  using Numbers = std::map<std::array<long, 3>, std::vector<double>>;

  void
  take(Numbers &numbers, const std::vector<ContactPoint> &points)
  {
    for (const ContactPoint &point : points)
      {
        std::array<long, 3> place;
        std::vector<double> values;
        for (unsigned int d = 0; d < dim; ++d)
          {
            place[d] = std::lround(1e6 * point.reference_position[d]);
            values.push_back(point.displacement[d]);
            values.push_back(point.slip[d]);
            values.push_back(point.traction[d] / 1000.);
          }
        values.push_back(point.gap);
        values.push_back(point.friction_work);
        values.push_back(static_cast<double>(point.status));
        numbers[place].insert(numbers[place].end(), values.begin(), values.end());
      }
  }



  Numbers
  solve(Run &run)
  {
    Numbers numbers;
    for (unsigned int step = 1; step <= 4; ++step)
      {
        run.solve(run.scene.newton, 0.5 * step);
        run.problem.commit();
        take(numbers,
             contact_points(run.problem.state().contact, run.problem.state().displacement));
      }
    return numbers;
  }



  /** How many slave and master faces each rank owns. */
  std::string
  ownership(const Run &run)
  {
    unsigned int counts[2] = {0, 0};
    for (const auto &cell : run.forest.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              const Point<dim> x = face->center();
              counts[0] += (cell->material_id() == 1 && std::abs(x[2] - 0.501) < 1e-9);
              counts[1] += (cell->material_id() == 0 && std::abs(x[2] - 0.5) < 1e-9);
            }
    std::string text;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(MPI_COMM_WORLD, std::make_pair(counts[0], counts[1])))
      text += (text.empty() ? "" : ", ") + std::to_string(of_rank.first) + "+" +
              std::to_string(of_rank.second);
    return text;
  }



  void
  compare(std::vector<std::string> overrides, const std::vector<std::string> &cells = one_layer)
  {
    overrides.insert(overrides.end(), cells.begin(), cells.end());
    Run alone(blocks, overrides, MPI_COMM_SELF), together(blocks, overrides, MPI_COMM_WORLD);
    const Numbers expected = solve(alone), found = solve(together);
    double        difference = 0.;
    for (const auto &[place, values] : found)
      {
        const auto same = expected.find(place);
        if (same == expected.end() || same->second.size() != values.size())
          difference = 1e9;
        else
          for (std::size_t k = 0; k < values.size(); ++k)
            difference = std::max(difference, std::abs(values[k] - same->second[k]));
      }
    difference       = Utilities::MPI::max(difference, MPI_COMM_WORLD);
    const auto nodes = Utilities::MPI::sum(found.size(), MPI_COMM_WORLD);
    const auto text  = ownership(together);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout << overrides[0].substr(overrides[0].find('=') + 1) << ", "
                  << overrides[1].substr(overrides[1].find('=') + 1)
                  << "; slave and master faces of the ranks: " << text << "; "
                  << (nodes == expected.size() ? "all nodes" : "NODES MISSING");
        print_agreement(difference, 1e-8);
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                pairing = "Contact pair contact/Pairing=";
  compare({"Contact/Enforcement=elimination", pairing + "pointwise"});
  compare({"Contact/Enforcement=elimination", pairing + "averaged"});
  compare({"Contact/Enforcement=lagrange multipliers", pairing + "averaged"});
  // Most cells are the block's: the second of two ranks has slave nodes as well.
  compare({"Contact/Enforcement=elimination", pairing + "averaged"}, more_slaves);
  return 0;
}
