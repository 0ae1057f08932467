// SPDX-License-Identifier: LGPL-2.1-or-later

// The bound of the largest frequency of single cells against dense eigenvalues: 1,000 cells by
// themselves, one of four a box and the others distorted, with all elements; never below the exact
// one, and hardly above it. And exact sums, which depend on no order.

#include <touchstone/base/exact_sum.h>
#include <touchstone/explicit/cell_forces.h>
#include <touchstone/explicit/hexahedron.h>
#include <touchstone/scene/scene.h>
#include <touchstone/solid/solid.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <random>

using namespace Touchstone;
using namespace dealii;

namespace
{
  constexpr unsigned int n_cells = 1000, n = 24;
  std::mt19937           generator(7);

  double
  random(const double low, const double high)
  {
    return low + (high - low) * generator() / double(generator.max());
  }

  /** Corners in the order of deal.II. */
  Hexahedron::Corners
  random_cell(const bool distorted)
  {
    Hexahedron shapes;
    while (true)
      {
        Hexahedron::Corners x;
        const double        size[3] = {random(0.3, 1.), random(0.3, 1.), random(0.3, 1.)};
        for (unsigned int a = 0; a < 8; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            x[a][d] = size[d] * (((a >> d) & 1) + (distorted ? random(-0.25, 0.25) : 0.));
        if (shapes.reinit(x) > 0.1 * shapes.volume())
          return x;
      }
  }

  /** Separate cells as a mesh file. */
  void
  write_mesh(const std::string &name)
  {
    std::ofstream out(name);
    out.precision(17);
    out << "# vtk DataFile Version 3.0\ncells\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
        << 8 * n_cells << " double\n";
    for (unsigned int c = 0; c < n_cells; ++c)
      for (const auto &x : random_cell(/*distorted=*/c % 4 > 0))
        out << x[0] + 3. * c << ' ' << x[1] << ' ' << x[2] << '\n';
    out << "CELLS " << n_cells << ' ' << 9 * n_cells << '\n';
    const unsigned int order[] = {0, 1, 3, 2, 4, 5, 7, 6};
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        out << 8;
        for (const unsigned int a : order)
          out << ' ' << 8 * c + a;
        out << '\n';
      }
    out << "CELL_TYPES " << n_cells << '\n';
    for (unsigned int c = 0; c < n_cells; ++c)
      out << "12\n";
  }

  void
  test(const std::string &element, const std::string &law, const double poisson)
  {
    const Scene scene(
      "set Bodies = cells\nsubsection Body cells\n set Element = " + element +
        "\n subsection Geometry\n  set Type = file\n  set File = cells.vtk\n end\n"
        " subsection Material\n  set Law = " +
        law + "\n  set Young modulus = 1\n  set Poisson ratio = " + std::to_string(poisson) +
        "\n  set Density = 1\n end\nend\nsubsection Time integration\n set Scheme = "
        "central_differences\nend\n",
      "scene.prm",
      {});
    const Forest  forest(scene.forest_input(), "", MPI_COMM_WORLD);
    const Solid   solid(scene.bodies, 1, forest, MPI_COMM_WORLD);
    const NodeMap map(solid);

    std::vector<unsigned int>            numbers;
    std::vector<CellForces::NodalMasses> masses;
    Hexahedron                           shapes;
    for (unsigned int c = 0; c < map.cells().size(); ++c)
      {
        numbers.push_back(c);
        shapes.reinit(corners(map, map.nodes(c)));
        masses.emplace_back();
        for (unsigned int a = 0; a < 8; ++a)
          masses.back()[a] = shapes.nodal_volume(a);
      }
    const auto          cells = CellForces::make(map, numbers, scene.bodies[0]);
    NodeField           u(map.n_local()), v(map.n_local()), force(map.n_local()), other(force);
    std::vector<double> squares;
    cells->square_frequencies(u, squares);
    double error = 0.;
    for (unsigned int c = 0; c < n_cells; ++c)
      for (unsigned int i = 0; i < 8; ++i)
        error = std::max(error, std::abs(cells->masses(c)[i] / masses[c][i] - 1.));
    // Round-off of positions of up to 3,000.
    if (!(error < 1e-11))
      std::cout << "  masses are off by " << error << std::endl;

    // The cells share no nodes: a column of all matrices at once, by central differences of the
    // forces.
    std::vector<LAPACKFullMatrix<double>> stiffness(n_cells, LAPACKFullMatrix<double>(n));
    const double                          small = 1e-6;
    for (unsigned int j = 0; j < n; ++j)
      for (const double side : {1., -1.})
        {
          std::fill(u.begin(), u.end(), Tensor<1, dim>());
          std::fill(force.begin(), force.end(), Tensor<1, dim>());
          for (const unsigned int c : numbers)
            u[map.nodes(c)[j / dim]][j % dim] = side * small;
          cells->subtract_forces(u, v, 0., nullptr, force, other);
          for (unsigned int c = 0; c < n_cells; ++c)
            for (unsigned int i = 0; i < n; ++i)
              stiffness[c](i, j) -=
                side * force[map.nodes(c)[i / dim]][i % dim] /
                (2. * small * std::sqrt(masses[c][i / dim] * masses[c][j / dim]));
        }
    double lowest = 1e300, highest = 0., mean = 0.;
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < i; ++j)
            stiffness[c](i, j) = stiffness[c](j, i) =
              0.5 * (stiffness[c](i, j) + stiffness[c](j, i));
        dealii::Vector<double> values(n);
        FullMatrix<double>     vectors(n, n);
        stiffness[c].compute_eigenvalues_symmetric(-1e10, 1e10, 1e-12, values, vectors);
        // The ratio of the stable steps.
        const double ratio = std::sqrt(values(values.size() - 1) / squares[c]);
        lowest             = std::min(lowest, ratio);
        highest            = std::max(highest, ratio);
        mean += ratio / n_cells;
      }
    std::cout << element << ", " << law << ", nu = " << poisson
              << ": step never above the exact one: " << (highest <= 1. + 1e-7 ? "yes" : "NO")
              << ", never below 0.99 of it: " << (lowest >= 0.99 ? "yes" : "NO") << std::endl;
    if (highest > 1. + 1e-7 || lowest < 0.99)
      std::cout << "  from " << lowest << " to " << highest << ", mean " << mean << std::endl;
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  write_mesh("cells.vtk");
  for (const double poisson : {0., 0.3, 0.49})
    for (const std::string element : {"full", "b-bar", "incompatible modes", "one point"})
      test(element, "linear elastic", poisson);
  test("F-bar", "neo-Hookean", 0.3);
  test("one point", "neo-Hookean", 0.45);

  // Numbers of very different size, whose sum is small: the same bits in any order and with parts
  // of the numbers summed apart.
  std::vector<double> numbers;
  for (unsigned int i = 0; i < 1000; ++i)
    numbers.push_back(std::ldexp(random(-1., 1.), generator() % 200));
  const unsigned int half = numbers.size();
  for (unsigned int i = 0; i < half; ++i)
    numbers.push_back(-numbers[i]);
  numbers.push_back(1.25);
  numbers.push_back(5e-324);
  bool same = true;
  for (unsigned int k = 0; k < 20; ++k)
    {
      std::shuffle(numbers.begin(), numbers.end(), generator);
      ExactSum parts[2];
      for (std::size_t i = 0; i < numbers.size(); ++i)
        parts[i % 3 == 0].add(numbers[i]);
      parts[0].add(parts[1]);
      same = same && parts[0].value() == 1.25 && parts[0].value(MPI_COMM_WORLD) == 1.25;
    }
  ExactSum negative;
  negative.add(-1e300);
  negative.add(1e300);
  negative.add(-0.1);
  std::cout << "Exact sums: " << (same && negative.value() == -0.1 ? "yes" : "NO") << std::endl;
  return 0;
}
