// SPDX-License-Identifier: LGPL-2.1-or-later

// Hexahedra with 2x2x2 points, eight at a time, against the kernel of implicit runs: the same
// forces and the same history in distorted cells that go on over several cycles, with blocks that
// are full and one that is not. And the roots of the vector kernels.

#include <touchstone/explicit/gauss_cells.h>
#include <touchstone/explicit/lanes.h>
#include <touchstone/scene/scene.h>
#include <touchstone/solid/solid.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

using namespace Touchstone;
using namespace dealii;

namespace
{
  std::mt19937 generator(7);

  double
  random(const double low, const double high)
  {
    return low + (high - low) * generator() / double(generator.max());
  }

  void
  test(const std::string &element, const std::string &law, const double strain, const bool rows)
  {
    const Scene   scene("set Bodies = rod\nsubsection Body rod\n set Element = " + element +
                        "\n subsection Geometry\n  set Type = cylinder\n  set Radius = 1\n  set "
                          "Start = 0\n  set End = 1\n  set Part = quarter\n  set Cells = 1, 1, 7\n "
                          "end\n subsection Material\n" +
                        law +
                        "  set Young modulus = 1000\n  set Poisson ratio = 0.3\n  set Density = "
                          "1\n end\nend\nsubsection Time integration\n set Scheme = "
                          "central_differences\nend\n",
                      "scene.prm",
                      {});
    const Forest  forest(scene.forest_input(), "", MPI_COMM_WORLD);
    const Solid   solid(scene.bodies, 1, forest, MPI_COMM_WORLD);
    const NodeMap map(solid);

    std::vector<unsigned int> numbers(map.cells().size());
    for (unsigned int c = 0; c < numbers.size(); ++c)
      numbers[c] = c;
    const BodyParameters &body = scene.bodies[0];
    GaussCells            together(map, numbers, body);
    KernelCells           singly(map, numbers, body);
    NodeField             u(map.n_local()), velocity(u), none(u);
    for (auto &v : velocity)
      for (unsigned int d = 0; d < dim; ++d)
        v[d] = random(-strain, strain);
    double error = 0., size = 0., difference = 0., flow = 0.;
    for (unsigned int cycle = 0; cycle < 5; ++cycle)
      {
        for (unsigned int i = 0; i < u.size(); ++i)
          u[i] += velocity[i];
        NodeField a(u.size()), b(u.size());
        if (together.subtract_forces(u, none, 1e-3, nullptr, a, none) !=
              numbers::invalid_unsigned_int ||
            singly.subtract_forces(u, none, 1e-3, nullptr, b, none) !=
              numbers::invalid_unsigned_int)
          std::cout << "  A cell has failed." << std::endl;
        for (unsigned int i = 0; i < u.size(); ++i)
          {
            error = std::max(error, (a[i] - b[i]).norm());
            size  = std::max(size, b[i].norm());
          }
      }
    if (CellStates *const states = together.history())
      {
        states->commit();
        singly.history()->commit();
      }
    for (const unsigned int c : numbers)
      {
        const auto a = together.state(c), b = singly.state(c);
        for (unsigned int k = 0; k < a.size(); ++k)
          difference = std::max(difference, std::abs(a[k] - b[k]));
        if (!a.empty())
          flow = std::max(flow, a[0]);
      }
    const bool same = size > 1. && error < 1e-12 * size && difference < 1e-12 &&
                      (flow > 1e-4) == rows && GaussCells::suits(body) && numbers.size() % 8 != 0;
    std::cout << element << (rows ? ", von Mises, " : ", neo-Hookean, ") << strain << ": "
              << (same ? "the same" : "NOT the same") << std::endl;
    if (!same)
      std::cout << "  " << error << " of " << size << ", " << difference << ", " << flow << ", "
                << numbers.size() << std::endl;

    // One cell inside out is the one that is named.
    const unsigned int last = numbers.size() - 1;
    for (const unsigned int node : map.nodes(last))
      u[node] = -2. * map.positions()[node];
    const unsigned int failed = together.subtract_forces(u, none, 1e-3, nullptr, none, none);
    const unsigned int other  = singly.subtract_forces(u, none, 1e-3, nullptr, none, none);
    if (failed == numbers::invalid_unsigned_int || failed != other)
      std::cout << "  The inverted cell is " << other << ", not " << failed << std::endl;
  }

  TOUCHSTONE_VECTORISED
  void
  roots(const double *x, double *cube, double *square)
  {
    store(inverse_cube_root(load(x)), cube);
    store(square_root(load(x)), square);
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                hooke = "  set Law = neo-Hookean\n",
                    linear = "  set Law = finite-strain von Mises\n  subsection Plasticity\n   set "
                             "Yield stress = 2\n   set Hardening = linear\n   set Hardening "
                             "modulus = 10\n  end\n";
  for (const std::string element : {"full", "F-bar"})
    {
      test(element, hooke, 0.01, false);
      test(element, linear, 0.0005, true);
      // Beyond the series of the formulas: the law itself.
      test(element, linear, 0.01, true);
    }

  double error = 0.;
  for (unsigned int k = 0; k < 1000; ++k)
    {
      double x[8], cube[8], square[8];
      for (double &number : x)
        number = std::exp(random(-20., 20.));
      roots(x, cube, square);
      for (unsigned int i = 0; i < 8; ++i)
        error = std::max({error,
                          std::abs(cube[i] * std::cbrt(x[i]) - 1.),
                          std::abs(square[i] / std::sqrt(x[i]) - 1.)});
    }
  const double zero[8] = {};
  double       cube[8], square[8];
  roots(zero, cube, square);
  std::cout << "Roots: " << (error < 2e-15 && square[0] == 0. ? "exact" : "NOT exact") << std::endl;
  return 0;
}
