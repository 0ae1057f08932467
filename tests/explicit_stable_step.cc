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

  Scene
  scene_of(const std::string &element,
           const std::string &law,
           const double       poisson,
           const std::string &more = "")
  {
    return Scene("set Bodies = cells\nsubsection Body cells\n set Element = " + element +
                   "\n subsection Geometry\n  set Type = file\n  set File = cells.vtk\n end\n"
                   " subsection Material\n  set Law = " +
                   law + "\n  set Young modulus = 1\n  set Poisson ratio = " +
                   std::to_string(poisson) + "\n  set Density = 1\n" + more +
                   " end\nend\nsubsection Time integration\n set Scheme = "
                   "central_differences\nend\n",
                 "scene.prm",
                 {});
  }

  using Matrices = std::vector<LAPACKFullMatrix<double>>;

  /** Stiffness of each cell by itself at the displacement @p at, by the roots of masses: cells
   * share no nodes, so that a column of all matrices comes at once, by central differences of
   * forces. */
  Matrices
  stiffness_of(CellForces                                 &cells,
               const NodeMap                              &map,
               const NodeField                            &at,
               const std::vector<CellForces::NodalMasses> &masses,
               const double                                small)
  {
    Matrices  result(n_cells, LAPACKFullMatrix<double>(n));
    NodeField v(map.n_local()), force(map.n_local()), other(force);
    for (unsigned int j = 0; j < n; ++j)
      for (const double side : {1., -1.})
        {
          NodeField u = at;
          std::fill(force.begin(), force.end(), Tensor<1, dim>());
          for (unsigned int c = 0; c < n_cells; ++c)
            u[map.nodes(c)[j / dim]][j % dim] += side * small;
          cells.subtract_forces(u, v, 0., nullptr, force, other);
          for (unsigned int c = 0; c < n_cells; ++c)
            for (unsigned int i = 0; i < n; ++i)
              result[c](i, j) -= side * force[map.nodes(c)[i / dim]][i % dim] /
                                 (2. * small * std::sqrt(masses[c][i / dim] * masses[c][j / dim]));
        }
    for (LAPACKFullMatrix<double> &of_cell : result)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < i; ++j)
          of_cell(i, j) = of_cell(j, i) = 0.5 * (of_cell(i, j) + of_cell(j, i));
    return result;
  }

  double
  largest_value(LAPACKFullMatrix<double> &matrix)
  {
    dealii::Vector<double> values(n);
    FullMatrix<double>     vectors(n, n);
    matrix.compute_eigenvalues_symmetric(-1e10, 1e10, 1e-12, values, vectors);
    return values(values.size() - 1);
  }

  void
  test(const std::string &element, const std::string &law, const double poisson)
  {
    const Scene   scene = scene_of(element, law, poisson);
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
    NodeField           u(map.n_local());
    std::vector<double> squares;
    cells->square_frequencies(u, squares);
    double error = 0.;
    for (unsigned int c = 0; c < n_cells; ++c)
      for (unsigned int i = 0; i < 8; ++i)
        error = std::max(error, std::abs(cells->masses(c)[i] / masses[c][i] - 1.));
    // Round-off of positions of up to 3,000.
    if (!(error < 1e-11))
      std::cout << "  masses are off by " << error << std::endl;

    std::fill(u.begin(), u.end(), Tensor<1, dim>());
    Matrices stiffness = stiffness_of(*cells, map, u, masses, 1e-6);
    double   lowest = 1e300, highest = 0., mean = 0.;
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        // The ratio of the stable steps.
        const double ratio = std::sqrt(largest_value(stiffness[c]) / squares[c]);
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

  /** Cells of F-bar that have flowed until some of their points are thin, by how they unload: their
   * state, given to cells that do not flow. */
  void
  test_thin_points()
  {
    const auto law = [](const char *yield_stress) {
      return scene_of("F-bar",
                      "finite-strain von Mises",
                      0.3,
                      std::string("  subsection Plasticity\n   set Yield stress = ") +
                        yield_stress + "\n  end\n");
    };
    const Scene   soft = law("1e-5"), strong = law("1e3");
    const Forest  forest(soft.forest_input(), "", MPI_COMM_WORLD);
    const Solid   solid(soft.bodies, 1, forest, MPI_COMM_WORLD);
    const NodeMap map(solid);

    std::vector<unsigned int>            numbers;
    std::vector<CellForces::NodalMasses> masses(n_cells);
    NodeField                            u(map.n_local());
    Hexahedron                           shapes, present;
    double                               thinnest = 1.;
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        numbers.push_back(c);
        shapes.reinit(corners(map, map.nodes(c)));
        for (unsigned int a = 0; a < 8; ++a)
          masses[c][a] = shapes.nodal_volume(a);
        double smallest = 0.;
        while (!(smallest > 0.02))
          {
            for (const unsigned int node : map.nodes(c))
              for (unsigned int d = 0; d < dim; ++d)
                u[node][d] = random(-0.2, 0.2);
            if (!(present.reinit(corners(map, map.nodes(c), &u)) > 0.))
              continue;
            smallest = 1.;
            for (unsigned int q = 0; q < Hexahedron::n_points; ++q)
              smallest =
                std::min(smallest,
                         present.weight(q) / shapes.weight(q) * shapes.volume() / present.volume());
          }
        // Without change of volume.
        const double scale = std::cbrt(shapes.volume() / present.volume());
        for (const unsigned int node : map.nodes(c))
          u[node] = (scale - 1.) * map.positions()[node] + scale * u[node];
        thinnest = std::min(thinnest, smallest);
      }
    const auto flowing = CellForces::make(map, numbers, soft.bodies[0]),
               elastic = CellForces::make(map, numbers, strong.bodies[0]);
    NodeField v(map.n_local()), force(map.n_local()), other(force), on_the_way(u);
    for (unsigned int k = 1; k <= 10; ++k)
      {
        for (unsigned int i = 0; i < u.size(); ++i)
          on_the_way[i] = 0.1 * k * u[i];
        flowing->subtract_forces(on_the_way, v, 0., nullptr, force, other);
      }
    flowing->history()->commit();
    for (unsigned int c = 0; c < n_cells; ++c)
      elastic->set_state(c, flowing->state(c));
    elastic->subtract_forces(u, v, 0., nullptr, force, other);
    std::vector<double> squares;
    elastic->square_frequencies(u, squares);
    Matrices stiffness = stiffness_of(*elastic, map, u, masses, 1e-7);
    double   lowest = 1e300, highest = 0.;
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        const double ratio = std::sqrt(largest_value(stiffness[c]) / squares[c]);
        lowest             = std::min(lowest, ratio);
        highest            = std::max(highest, ratio);
      }
    std::cout << "F-bar with thin points: step not above the exact one by more than 1e-3: "
              << (highest <= 1.001 ? "yes" : "NO")
              << ", not below 0.9 of it: " << (lowest >= 0.9 ? "yes" : "NO") << std::endl;
    if (highest > 1.001 || lowest < 0.9)
      std::cout << "  from " << lowest << " to " << highest << ", thinnest point " << thinnest
                << std::endl;
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
  test_thin_points();

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
