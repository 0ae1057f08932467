// SPDX-License-Identifier: LGPL-2.1-or-later
// The parts of multigrid: aggregates of nodes, the matrix of 3 x 3 blocks in single
// precision, whole and as half of a symmetric one, the coarse levels, and that a cycle is
// symmetric, as conjugate gradients need it, and works.

#include <touchstone/algebra/multigrid/aggregation.h>
#include <touchstone/algebra/multigrid/multigrid.h>

#include <deal.II/base/mpi.h>

#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>
#include <set>

using namespace Touchstone;
using namespace dealii;

namespace
{
  constexpr int side = 12, layer = side * side, n_nodes = layer * side;

  /** The bodies lie on top of each other. */
  unsigned int
  body_of(const int node)
  {
    return node / layer < side / 2 ? 0 : 1;
  }

  /** The nodes beside, in front of, behind, above and below. */
  std::vector<int>
  neighbours(const int node)
  {
    std::vector<int> result;
    for (const int stride : {1, side, layer})
      {
        const int i = node / stride % side;
        if (i > 0)
          result.push_back(node - stride);
        if (i + 1 < side)
          result.push_back(node + stride);
      }
    return result;
  }



  void
  test_aggregation()
  {
    std::vector<std::vector<int>> graph(n_nodes);
    std::vector<unsigned int>     body(n_nodes);
    for (int node = 0; node < n_nodes; ++node)
      {
        graph[node] = neighbours(node);
        body[node]  = body_of(node);
      }
    graph[5].clear(); // a node that is held in all directions
    for (auto &list : graph)
      list.erase(std::remove(list.begin(), list.end(), 5), list.end());
    const Aggregates aggregates = aggregate(graph, body);

    std::vector<std::set<unsigned int>> bodies(aggregates.n);
    int                                 without = 0;
    for (int node = 0; node < n_nodes; ++node)
      if (aggregates.of_node[node] < 0)
        ++without;
      else
        bodies[aggregates.of_node[node]].insert(body[node]);
    int mixed = 0, empty = 0;
    for (const auto &set : bodies)
      {
        mixed += set.size() > 1;
        empty += set.empty();
      }
    std::cout << "nodes per aggregate: " << double(n_nodes) / aggregates.n
              << ", without one: " << without << ", aggregates of two bodies: " << mixed
              << ", of none: " << empty << std::endl;

    // A chain of nodes that take part in two bodies by turns: nothing to put together.
    const Aggregates chain = aggregate({{1}, {0, 2}, {1, 3}, {2}}, {0, 1, 0, 1});
    std::cout << "by turns: " << chain.n << " aggregates, first node in " << chain.of_node[0]
              << std::endl;
  }



  /** Springs along the edges and softer ones between components, stiff in the upper body, so that
   * the blocks are full; the lowest layer is held. Blocks are not symmetric by themselves,
   * the matrix is where @p mirrored says so. */
  std::unique_ptr<Epetra_CrsMatrix>
  make_matrix(const Epetra_Map &map, const bool mirrored)
  {
    auto       matrix = std::make_unique<Epetra_CrsMatrix>(Copy, map, 0);
    const auto held   = [](const int node) { return node < layer; };
    for (int row = 0; row < map.NumMyElements(); ++row)
      {
        const int i = map.GID(row), node = i / 3;
        double    diagonal = 0.1;
        for (const int other : neighbours(node))
          {
            const double stiffness = body_of(node) == body_of(other) ? 1. + body_of(node) : 0.5;
            diagonal += stiffness;
            if (!held(node) && !held(other))
              for (int d = 0; d < 3; ++d)
                {
                  const int    j     = 3 * other + d;
                  const bool   upper = mirrored && node > other ? i % 3 > d : i % 3 < d;
                  const double soft  = upper ? 0.15 : 0.1;
                  const double value = i % 3 == d ? -stiffness : -soft * stiffness;
                  matrix->InsertGlobalValues(i, 1, &value, &j);
                }
          }
        diagonal *= 1.3;
        matrix->InsertGlobalValues(i, 1, &diagonal, &i);
      }
    matrix->FillComplete();
    return matrix;
  }



  double
  wave(const int i)
  {
    return std::sin(0.37 * i) + 0.5 * std::cos(1.7 * i);
  }



  using RowVector = LinearAlgebra::distributed::Vector<double>;

  /** Of rows that are symmetric those blocks are taken that stand for others, too. */
  RowVector
  product_of(BlockRows &rows, const double *values, const bool symmetric)
  {
    RowVector x(rows.numbers()), result(rows.numbers());
    std::copy(values, values + x.locally_owned_size(), x.begin());
    x.update_ghost_values();
    for (unsigned int node = 0; node < rows.n_nodes(); ++node)
      {
        const auto &row = rows.read(node);
        for (std::size_t k = 0; k < row.columns.size(); ++k)
          {
            const unsigned int other = row.columns[k];
            const bool         twice = symmetric && other > node && other < rows.n_nodes();
            for (unsigned int r = 0; r < 3 && !(symmetric && other < node); ++r)
              for (unsigned int c = 0; c < 3; ++c)
                {
                  const double entry = row.blocks[k][3 * r + c];
                  result.local_element(3 * node + r) += entry * x.local_element(3 * other + c);
                  if (twice)
                    result.local_element(3 * other + c) += entry * x.local_element(3 * node + r);
                }
          }
      }
    return result;
  }



  double
  dot(const RowVector &a, const double *b, const MPI_Comm communicator)
  {
    return Utilities::MPI::sum(
      std::inner_product(a.begin(), a.begin() + a.locally_owned_size(), b, 0.), communicator);
  }



  using Motions = std::shared_ptr<const Epetra_MultiVector>;

  /** What takes motions from a coarser level and forces to it; then the same of that one.
   * @param rows,whole The matrix, of which the first may be stored by halves. */
  void
  test_prolongation(BlockRows                       &rows,
                    BlockRows                       &whole,
                    const Motions                   &given,
                    const unsigned int               n_given,
                    const std::vector<unsigned int> &body,
                    const unsigned int               group)
  {
    const Epetra_MultiVector &motions = *given;
    using VectorType                  = Prolongation::VectorType;
    const BlockMatrix<float> blocks(rows, true);
    const auto              &partitioner = blocks.vector_partitioner();
    VectorType               fine(partitioner), forces(partitioner), coarse, gathered;
    const auto               fill = [](VectorType &vector) {
      for (const auto i : vector.locally_owned_elements())
        vector(i) = static_cast<float>(wave(i));
    };
    const MPI_Comm communicator = partitioner->get_mpi_communicator();
    const bool     root         = Utilities::MPI::this_mpi_process(communicator) == 0;

    // Motions come back smoothed by one step of Jacobi's method, whatever the aggregates.
    const double       largest = 2.;
    const Prolongation smooth(
      blocks, [&] { return given; }, body, group, largest);
    smooth.initialize_coarse_vector(coarse);
    smooth.initialize_coarse_vector(gathered);
    const int n_ranks = Utilities::MPI::sum(coarse.locally_owned_size() > 0 ? 1 : 0, communicator);
    const VectorType inverse = blocks.inverse_diagonal();
    double           wrong = 0., size = 0.;
    for (int d = 0; d < motions.NumVectors(); ++d)
      {
        const RowVector smoothed  = product_of(rows, motions[d], true);
        const double   *of_coarse = (*smooth.coarse_near_kernel())[d];
        std::copy(of_coarse, of_coarse + coarse.locally_owned_size(), coarse.begin());
        fine = 0.f;
        smooth.prolongate_and_add(fine, coarse);
        for (int i = 0; i < motions.MyLength(); ++i)
          {
            const double step = 4. / 3. / largest * smoothed.local_element(i);
            wrong             = std::max(wrong,
                             std::abs(fine.local_element(i) - motions[d][i] +
                                      step * inverse.local_element(i)));
            size              = std::max(size, std::abs(motions[d][i]));
          }
      }
    wrong = Utilities::MPI::max(wrong, communicator);
    size  = Utilities::MPI::max(size, communicator);

    // x . P^T A P x = P x . A P x, and forces gather as motions spread.
    fill(coarse);
    fill(forces);
    fine = 0.f;
    smooth.prolongate_and_add(fine, coarse);
    smooth.restrict_to(gathered, forces);
    const double spread = fine * forces, back = coarse * gathered;

    const std::vector<double> x(coarse.begin(), coarse.begin() + coarse.locally_owned_size()),
      px(fine.begin(), fine.begin() + fine.locally_owned_size());
    // Before the rows are forgotten by the product.
    double energy_of_fine    = dot(product_of(whole, px.data(), false), px.data(), communicator),
           alone             = 0.;
    const auto product       = smooth.galerkin(rows, /*symmetric=*/true),
               whole_product = smooth.galerkin(whole, /*symmetric=*/false);
    const double energy      = dot(product_of(*product, x.data(), true), x.data(), communicator),
                 of_whole =
                   dot(product_of(*whole_product, x.data(), false), x.data(), communicator);
    // The unknowns of motions that are not given stand alone, with one.
    for (std::size_t i = 0; i < x.size(); ++i)
      if (i % Prolongation::n_modes >= n_given)
        alone += x[i] * x[i];
    energy_of_fine += Utilities::MPI::sum(alone, communicator);
    if (root)
      std::cout << "motions over the coarser level: "
                << (wrong < 1e-6 * size ? "smoothed" : "WRONG") << ", forces: "
                << (std::abs(spread - back) < 1e-5 * std::abs(spread) ? "transposed" : "WRONG")
                << ", coarser matrix: "
                << (std::abs(energy - energy_of_fine) < 1e-6 * energy &&
                        std::abs(energy - of_whole) < 1e-12 * energy
                      ? "of the same energy"
                      : "WRONG")
                << ", of " << (coarse.size() < 1000 ? "few" : "many") << " unknowns, on " << n_ranks
                << " rank(s)" << std::endl;
    if (group == 1)
      test_prolongation(*product,
                        *whole_product,
                        smooth.coarse_near_kernel(),
                        n_given,
                        smooth.coarse_body(),
                        Prolongation::n_nodes_of_aggregate);
  }



  /** Whether blocks in single precision have the product and the diagonal of a matrix. */
  void
  test_blocks(const Epetra_CrsMatrix &matrix, const bool symmetric, const Epetra_Vector &x)
  {
    Epetra_Vector exact(x), of_matrix(x);
    matrix.Multiply(false, x, exact);
    matrix.ExtractDiagonalCopy(of_matrix);
    MatrixRows                     rows(matrix);
    const BlockMatrix<float>       blocks(rows, symmetric);
    BlockMatrix<float>::VectorType in, out;
    blocks.initialize_vector(in);
    blocks.initialize_vector(out);
    std::copy(x.Values(), x.Values() + x.MyLength(), in.begin());
    blocks.vmult(out, in);
    const BlockMatrix<float>::VectorType inverse = blocks.inverse_diagonal();
    double                               largest = 0., difference = 0., diagonal = 0.;
    for (int i = 0; i < x.MyLength(); ++i)
      {
        largest    = std::max(largest, std::abs(exact[i]));
        difference = std::max(difference, std::abs(exact[i] - out.local_element(i)));
        diagonal   = std::max(diagonal, std::abs(of_matrix[i] * inverse.local_element(i) - 1.));
      }
    const MPI_Comm communicator = rows.numbers()->get_mpi_communicator();
    difference                  = Utilities::MPI::max(difference, communicator);
    largest                     = Utilities::MPI::max(largest, communicator);
    diagonal                    = Utilities::MPI::max(diagonal, communicator);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      std::cout << (symmetric ? "half of the blocks" : "all blocks") << ": product "
                << (difference < 1e-6 * largest ? "the same" : "WRONG") << ", diagonal "
                << (diagonal < 1e-6 ? "the same" : "WRONG") << std::endl;
  }



  /** The rigid motions of the bodies: translations, and rotations about each axis. */
  Epetra_MultiVector
  rigid_motions(const Epetra_Map &map, const std::vector<int> &rows)
  {
    Epetra_MultiVector motions(map, 6);
    for (std::size_t i = 0; i < rows.size(); ++i)
      {
        if (rows[i] / 3 < layer)
          continue;
        const int    node = rows[i] / 3, d = rows[i] % 3;
        const double place[]        = {double(node % side),
                                       double(node / side % side),
                                       double(node / layer)};
        motions[d][i]               = 1.;
        motions[3 + (d + 1) % 3][i] = place[(d + 2) % 3] - side / 2.;
        motions[3 + (d + 2) % 3][i] = side / 2. - place[(d + 1) % 3];
      }
    return motions;
  }



  /** A cycle is symmetric and reduces the error. */
  void
  test_cycle(const Epetra_CrsMatrix          &matrix,
             const Epetra_MultiVector        &motions,
             const std::vector<unsigned int> &body,
             const Epetra_Vector             &x,
             const Epetra_Vector             &y,
             const bool                       root)
  {
    const Epetra_Map &map = matrix.RowMap();
    const Multigrid   multigrid(
      map,
      std::make_unique<MatrixRows>(matrix),
      [&] { return std::make_shared<const Epetra_MultiVector>(motions); },
      body,
      true);
    Epetra_Vector of_x(map), of_y(map), rest(x), product(map);
    multigrid.ApplyInverse(x, of_x);
    multigrid.ApplyInverse(y, of_y);
    double a, b, before, after;
    of_x.Dot(y, &a);
    of_y.Dot(x, &b);
    // Iterating with it alone, by how much the error falls in each of the last cycles.
    for (int cycle = 0; cycle < 12; ++cycle)
      {
        rest.Norm2(&before);
        matrix.Multiply(false, rest, product);
        multigrid.ApplyInverse(product, of_x);
        rest.Update(-1., of_x, 1.);
      }
    rest.Norm2(&after);
    if (root)
      std::cout << "cycle: "
                << (std::abs(a - b) < 1e-5 * std::abs(a) ? "symmetric" : "NOT SYMMETRIC")
                << ", error falls " << (after < 0.35 * before ? "fast" : "slowly") << std::endl;
  }



  /** Nothing is coupled: there is no coarse level to be made. */
  void
  test_nothing_coupled(const std::vector<int>          &rows,
                       const Epetra_MultiVector        &motions,
                       const std::vector<unsigned int> &body,
                       const Epetra_Vector             &x,
                       const bool                       root)
  {
    const Epetra_Map map(-1, rows.size(), rows.data(), 0, Epetra_MpiComm(MPI_COMM_WORLD));
    auto             diagonal_matrix = std::make_unique<Epetra_CrsMatrix>(Copy, map, 1);
    for (const int i : rows)
      {
        const double two = 2.;
        diagonal_matrix->InsertGlobalValues(i, 1, &two, &i);
      }
    diagonal_matrix->FillComplete();
    const Multigrid alone(
      map,
      std::make_unique<MatrixRows>(*diagonal_matrix),
      [&] { return std::make_shared<const Epetra_MultiVector>(motions); },
      body,
      true);
    Epetra_Vector half(map);
    alone.ApplyInverse(x, half);
    double error = 0., norm = 0.;
    half.Update(-0.5, x, 1.);
    half.Norm2(&error);
    x.Norm2(&norm);
    if (root)
      std::cout << "nothing coupled: " << (error < 0.3 * norm ? "smoothed" : "WRONG") << std::endl;
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                   communicator = MPI_COMM_WORLD;
  const bool                       root = Utilities::MPI::this_mpi_process(communicator) == 0;
  if (root)
    test_aggregation();

  const int        rank = Utilities::MPI::this_mpi_process(communicator);
  const int        n    = Utilities::MPI::n_mpi_processes(communicator);
  std::vector<int> rows;
  for (int node = n_nodes * rank / n; node < n_nodes * (rank + 1) / n; ++node)
    for (int d = 0; d < 3; ++d)
      rows.push_back(3 * node + d);
  const Epetra_Map map(-1, rows.size(), rows.data(), 0, Epetra_MpiComm(communicator));
  const std::shared_ptr<Epetra_CrsMatrix> matrix = make_matrix(map, true);

  Epetra_Vector x(map), y(map);
  for (int i = 0; i < x.MyLength(); ++i)
    {
      x[i] = wave(rows[i]);
      y[i] = wave(3 * rows[i] + 1);
    }
  test_blocks(*make_matrix(map, false), false, x);
  test_blocks(*matrix, true, x);

  const Epetra_MultiVector  motions = rigid_motions(map, rows);
  std::vector<unsigned int> body, body_of_nodes;
  for (const int row : rows)
    body.push_back(body_of(row / 3));
  for (std::size_t i = 0; i < rows.size(); i += 3)
    body_of_nodes.push_back(body[i]);
  MatrixRows rows_of_matrix(*matrix);
  for (const int n_given : {3, 6})
    {
      const auto some = std::make_shared<const Epetra_MultiVector>(Copy, motions, 0, n_given);
      test_prolongation(rows_of_matrix, rows_of_matrix, some, n_given, body_of_nodes, 1);
    }

  test_cycle(*matrix, motions, body, x, y, root);
  test_nothing_coupled(rows, motions, body, x, root);
  return 0;
}
