// SPDX-License-Identifier: LGPL-2.1-or-later
// Averaged rows look for the faces that face each other only after some motion. Rows of a
// pairing that has seen earlier displacements against those of one that has not: a face that
// comes to overlap after a small motion must have been among those that may, and a large
// motion must have been noticed.

#include "contact_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  // Edges lie above each other: any motion lets other faces overlap.
  const std::string matching = two_bodies("lower",
                                          "set Cells = 4, 4, 2",
                                          "upper",
                                          "set Lower corner = 0, 0, 1.02\n"
                                          "set Upper corner = 1, 1, 2\n"
                                          "set Cells        = 4, 4, 2",
                                          slave_and_master("upper", "bottom", "lower", "top"));

  const std::string tubes = two_bodies("outer",
                                       "set Type         = tube\n"
                                       "set Axis         = x\n"
                                       "set Start        = 0\n"
                                       "set End          = 0.8\n"
                                       "set Inner radius = 1.02\n"
                                       "set Outer radius = 1.5\n"
                                       "set Cells        = 1, 5, 4",
                                       "inner",
                                       "set Type         = tube\n"
                                       "set Axis         = x\n"
                                       "set Start        = 0\n"
                                       "set End          = 1\n"
                                       "set Inner radius = 0.5\n"
                                       "set Outer radius = 1\n"
                                       "set Outer slope  = 0.01\n"
                                       "set Cells        = 1, 5, 5",
                                       slave_and_master("outer", "inner", "inner", "outer"));

  double
  difference(const ContactRow &a, const ContactRow &b)
  {
    if (a.has_partner != b.has_partner || a.stencil.size() != b.stencil.size())
      return 1.;
    if (!a.has_partner)
      return 0.; // the rest stays what it was
    double result = std::max({std::abs(a.gap - b.gap),
                              std::abs(a.area - b.area),
                              (a.normal - b.normal).norm(),
                              (a.gap_vector - b.gap_vector).norm()});
    for (std::size_t m = 0; m < a.stencil.size(); ++m)
      result = std::max(result,
                        a.stencil[m].node == b.stencil[m].node
                          ? std::abs(a.stencil[m].weight - b.stencil[m].weight)
                          : 1.);
    return result;
  }

  void
  check(const std::string &name, const std::string &text, const std::vector<std::string> &overrides)
  {
    PairOfScene  watched(text, overrides);
    const double limit =
      0.02 * std::min(watched.slave->shortest_edge(), watched.master->shortest_edge());
    const bool     root  = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    double         worst = 0.;
    std::string    looked;
    std::uint64_t  before = 0;
    Tensor<1, dim> slide;
    const auto     step = [&](const double scatter_size, const Tensor<1, dim> &motion) {
      slide += motion;
      const Touchstone::Vector u =
        watched.displacement([&](const Point<dim> &x, const unsigned int body) {
          return scatter_size * limit * scattered(x, 5) / std::sqrt(3.) +
                 (body == 1 ? 1. : 0.) * slide;
        });
      watched.update(u);
      const std::uint64_t work =
        Utilities::MPI::sum(watched.pairing->search_work().candidates, MPI_COMM_WORLD);
      looked += work > before ? " anew" : " -";
      before = work;
      PairOfScene fresh(text, overrides);
      fresh.update(u);
      for (std::size_t k = 0; k < fresh.rows.size(); ++k)
        worst = std::max(worst, difference(watched.rows[k], fresh.rows[k]));
    };
    const Tensor<1, dim> along({1., 0., 0.});
    step(0., Tensor<1, dim>());
    step(0.99, Tensor<1, dim>());
    step(-0.99, Tensor<1, dim>());
    // It adds up.
    step(0., 0.6 * limit * along);
    step(0., 0.6 * limit * along);
    step(0.3, 0.3 * limit * along);
    step(0., 20. * limit * along);
    step(0.9, Tensor<1, dim>());
    step(0., -35. * limit * along);
    worst = Utilities::MPI::max(worst, MPI_COMM_WORLD);
    if (root)
      std::cout << name << ": looked for" << looked << ", rows "
                << (worst < 1e-10 ? "the same" : "DIFFER") << std::endl;

    // A step that ends starts anew: what has gone through a face since then counts.
    Touchstone::Vector ghosted(watched.solid.owned, watched.solid.relevant, MPI_COMM_WORLD);
    watched.pairing->commit_positions(ghosted);
    looked.clear();
    slide = Tensor<1, dim>();
    step(0., Tensor<1, dim>());
    step(0.5, Tensor<1, dim>());
    if (root)
      std::cout << name << ": after the end of a step" << looked << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string degree : {"1", "2"})
    {
      const std::vector<std::string> overrides{"Discretisation/Degree=" + degree};
      check("matching, degree " + degree, matching, overrides);
      check("overhang, degree " + degree, overhang, overrides);
      check("tubes, degree " + degree, tubes, overrides);
    }
  return 0;
}
