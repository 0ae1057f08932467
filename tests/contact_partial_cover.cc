// SPDX-License-Identifier: LGPL-2.1-or-later
// Averaged rows while the edge of the master surface goes over slave faces: what a row weighs
// stays bounded and changes smoothly, forces and moments balance, areas add up to what is
// covered, and no gap is smaller than that of the surfaces. And a node on a plane of symmetry,
// where the master surface ends, is covered or not by round-off: its gap does not change by a jump.

#include "contact_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** The slave has four faces in x over 0 to 2, the master ends at x = 1. */
  const std::string edge = two_bodies("lower",
                                      "set Lower corner = 0, 0, 0\n"
                                      "set Upper corner = 1, 1, 0.5\n"
                                      "set Cells        = 3, 2, 1",
                                      "upper",
                                      "set Lower corner = 0, 0, 0.51\n"
                                      "set Upper corner = 2, 1, 1\n"
                                      "set Cells        = 4, 3, 1",
                                      slave_and_master("upper", "bottom", "lower", "top"));

  /** The same with the edge and a corner over both directions. */
  const std::string corner = two_bodies("lower",
                                        "set Lower corner = 0, 0, 0\n"
                                        "set Upper corner = 1, 1, 0.5\n"
                                        "set Cells        = 3, 2, 1",
                                        "upper",
                                        "set Lower corner = 0, 0, 0.51\n"
                                        "set Upper corner = 2, 2, 1\n"
                                        "set Cells        = 4, 4, 1",
                                        slave_and_master("upper", "bottom", "lower", "top"));

  /** A coarse ball over a plate: gap 0.01 at the lowest point. */
  const std::string ball = two_bodies("plate",
                                      "set Lower corner = -2, -2, -0.5\n"
                                      "set Upper corner = 2, 2, 0\n"
                                      "set Cells        = 7, 6, 1",
                                      "ball",
                                      "set Type   = ball\n"
                                      "set Centre = 0, 0, 1.01\n"
                                      "set Radius = 1\n"
                                      "set Cells  = 2, 2",
                                      slave_and_master("ball", "surface", "plate", "top"));

  /** A quarter of a ball on a quarter of a plate: its lowest node lies on both planes of
   * symmetry. */
  const std::string quarter = two_bodies("plate",
                                         "set Lower corner = 0, 0, -0.5\n"
                                         "set Upper corner = 2, 2, 0\n"
                                         "set Cells        = 5, 6, 1",
                                         "ball",
                                         "set Type   = ball\n"
                                         "set Centre = 0, 0, 1\n"
                                         "set Radius = 1\n"
                                         "set Keep   = +, +, -\n"
                                         "set Cells  = 2, 2",
                                         slave_and_master("ball", "surface", "plate", "top"));

  /** Largest over all positions. */
  struct Worst
  {
    double weight = 0., pressure = 0., balance = 0., gap = 0., area = 0., jump = 0.;
  };

  void
  slide(const std::string                   &name,
        const std::string                   &text,
        const std::vector<std::string>      &overrides,
        const Tensor<1, dim>                &motion,
        const double                         true_gap,
        const std::function<double(double)> &covered,
        const double                         balance = 1e-11)
  {
    PairOfScene            pair(text, overrides);
    Worst                  worst;
    constexpr unsigned int n_positions = 1600;
    std::vector<double>    before;
    for (unsigned int i = 0; i <= n_positions; ++i)
      {
        // Not on the edges of faces, where the last digit decides what is covered.
        const double             part = (i + 1e-4) / n_positions;
        const Touchstone::Vector u =
          pair.displacement([&](const Point<dim> &, const unsigned int body) {
            return body == 1 ? part * motion : Tensor<1, dim>();
          });
        pair.update(u);
        Touchstone::Vector positions(pair.solid.owned, pair.solid.relevant, MPI_COMM_WORLD);
        Touchstone::Vector x =
          pair.displacement([&](const Point<dim> &X, unsigned int) { return Tensor<1, dim>(X); });
        x += u;
        positions        = x;
        const auto place = [&](const Index node) {
          return Tensor<1, dim>(
            {positions(dim * node), positions(dim * node + 1), positions(dim * node + 2)});
        };
        double              area = 0.;
        std::vector<double> now;
        for (const ContactRow &row : pair.rows)
          {
            // Those between nodes have no area.
            if (row.between_nodes)
              continue;
            const bool there = row.has_partner;
            // What a row contributes where it could bear: its gap is small.
            const double open = there ? (row.gap / row.share - true_gap) / row.size : 1e10;
            const double acts = 1. / (1. + 1e3 * std::max(open, 0.));
            now.push_back(there ? acts * row.area : 0.);
            now.push_back(there ? acts * row.share : 0.);
            if (!there)
              continue;
            double         sum      = 0.;
            Tensor<1, dim> relative = place(row.slave);
            for (const StencilEntry &entry : row.stencil)
              {
                sum += entry.weight;
                relative -= entry.weight * place(entry.node);
                worst.weight = std::max(worst.weight, std::abs(entry.weight));
              }
            // Across the normal the points of attack of both forces are the same.
            relative -= (relative * row.normal) * row.normal;
            worst.balance = std::max({worst.balance, std::abs(sum - 1.), relative.norm()});
            worst.gap     = std::max(worst.gap, true_gap - row.gap / row.share);
            worst.pressure =
              std::max(worst.pressure,
                       acts * pair.slave->owned_nodes()[&row - &pair.rows[0]].area / row.area);
            area += acts * row.area * row.share;
          }
        area = Utilities::MPI::sum(area, MPI_COMM_WORLD);
        if (covered)
          worst.area = std::max(worst.area, std::abs(area / covered(part) - 1.));
        for (std::size_t k = 0; k < before.size(); ++k)
          worst.jump = std::max(worst.jump, std::abs(now[k] - before[k]));
        before = now;
      }
    const auto print = [&](const char *const what, const double value, const double bound) {
      const double largest = Utilities::MPI::max(value, MPI_COMM_WORLD);
      if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        {
          std::cout << name << ": " << what;
          if (largest <= bound)
            std::cout << " at most " << bound << std::endl;
          else
            std::cout << ' ' << largest << " FAILED, should be " << bound << std::endl;
        }
    };
    print("weight", worst.weight, 5.);
    print("area of a node over what is covered of it", worst.pressure, 30.);
    print("gap below that of the surfaces", worst.gap, 1e-12);
    if (covered)
      {
        print("force and moment that are left", worst.balance, balance);
        print("area that is missing", worst.area, 0.2);
        print("change of a row from one position to the next", worst.jump, 0.15);
      }
  }



  /** The gap of the lowest node of the quarter while it comes down by 0.01 to 0.005 below the
   * plate. */
  void
  press()
  {
    PairOfScene            pair(quarter);
    double                 steepest = 0., before = 0.;
    constexpr unsigned int n_positions = 1000;
    constexpr double       motion      = 1e-5;
    for (unsigned int i = 0; i < n_positions; ++i)
      {
        pair.update(pair.displacement([&](const Point<dim> &, const unsigned int body) {
          return Tensor<1, dim>({0., 0., body == 1 ? 0.005 - i * motion : 0.});
        }));
        for (const ContactRow &row : pair.rows)
          if (row.reference.norm() < 1e-10 && !row.between_nodes)
            {
              if (i > 0)
                steepest = std::max(steepest, std::abs(row.gap - before) / motion);
              before = row.gap;
            }
      }
    steepest = Utilities::MPI::max(steepest, MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "quarter of a ball: change of the gap over the motion "
                << (steepest <= 3. ? "at most 3" : std::to_string(steepest) + " FAILED")
                << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string degree : {"1", "2"})
    {
      const std::vector<std::string> overrides{"Discretisation/Degree=" + degree};
      // Nine functions on a sliver can hardly be told apart.
      const double balance = degree == "1" ? 1e-11 : 1e-8;
      slide(
        "edge, degree " + degree,
        edge,
        overrides,
        Tensor<1, dim>({-0.9, 0., 0.}),
        0.01,
        [](const double) { return 1.; },
        balance);
      slide(
        "corner, degree " + degree,
        corner,
        overrides,
        Tensor<1, dim>({-0.9, -0.8, 0.}),
        0.01,
        [](const double) { return 1.; },
        balance);
    }
  slide("ball", ball, {}, Tensor<1, dim>({1.1, 0.7, 0.}), 0.01, {});
  press();
  return 0;
}
