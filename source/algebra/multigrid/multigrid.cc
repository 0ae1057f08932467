// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/multigrid/multigrid.h>
#include <touchstone/base/free_memory.h>
#include <touchstone/base/non_convergence.h>

#include <deal.II/lac/vector_memory.h>

#include <Amesos.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

// Set-up of the levels and the V-cycle of smoothed aggregation (doc/theory.md, section 8). A
// level is a matrix in single precision, its Chebyshev smoother, and the prolongation from the
// next level; on the coarsest one KLU factorises in double precision. As a preconditioner a
// V-cycle has to be accurate to a few digits only.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * Degree of the polynomials, and the part of the spectrum that they smooth: from the largest
     * eigenvalue to a twentieth of it. Lower modes are smooth and left to the coarse level.
     * Unlike Gauss-Seidel, a polynomial needs products alone, is the same on any number of ranks
     * and symmetric, as conjugate gradients require.
     */
    constexpr int    degree = 3;
    constexpr double range  = 20.;

    /**
     * Conjugate gradients that estimate the largest eigenvalue, and the factor by which deal.II
     * enlarges the estimate, which bounds it from below; largest_eigenvalue() divides by it.
     */
    constexpr unsigned int estimate_iterations = 10;
    constexpr double       margin              = 1.2;

    /** Size at and below which a level is solved directly: too small for several ranks to gain. */
    constexpr Index few = 1000;

    /**
     * Throw on all ranks if a call of Amesos failed on any, or the others would wait for ever in
     * their next collective call.
     */
    void
    check(int error, const Epetra_Comm &communicator)
    {
      error       = std::abs(error);
      int largest = 0;
      communicator.MaxAll(&error, &largest, 1);
      if (largest != 0)
        throw LinearSolverFailure("the coarsest level of multigrid cannot be solved (Amesos: " +
                                  std::to_string(largest) + ")");
    }
  } // namespace



  Multigrid::Level::Level(BlockRows &rows, const bool symmetric)
    : matrix(rows, symmetric)
  {
  }



  // The diagonal D is the inner preconditioner of the polynomial: eigenvalues are those of
  // D^-1 A.
  void
  Multigrid::Level::make_smoother(Chebyshev         &result,
                                  const unsigned int iterations,
                                  const double       eigenvalue) const
  {
    Chebyshev::AdditionalData data(degree, range, iterations, /*residual*/ 1e-2, eigenvalue);
    data.preconditioner = std::make_shared<DiagonalMatrix<VectorType>>(matrix.inverse_diagonal());
    result.initialize(matrix, data);
  }



  Multigrid::Multigrid(const Epetra_Map                &map,
                       std::unique_ptr<BlockRows>       rows,
                       Prolongation::NearKernel         near_kernel,
                       const std::vector<unsigned int> &body,
                       const bool                       symmetric)
    : SquareOperator(map, "smoothed aggregation")
  {
    // Bodies by node; motions.body is by dof.
    std::vector<unsigned int> bodies(map.NumMyElements() / dim);
    for (unsigned int node = 0; node < bodies.size(); ++node)
      bodies[node] = body[dim * node];
    unsigned int group = 1;
    // From fine to coarse until few dofs are left. The rows of a level are made by the Galerkin
    // product of the one above and are read twice, for the copy in single precision and for the
    // next product in double, which frees them one by one: the set-up is among what takes most
    // memory of a run.
    while (rows->numbers()->size() > few)
      {
        give_back_free_memory();
        levels.push_back(std::make_unique<Level>(*rows, symmetric));
        Level       &level   = *levels.back();
        const double largest = largest_eigenvalue(level);
        auto         prolongation =
          std::make_unique<Prolongation>(level.matrix, near_kernel, bodies, group, largest);
        const auto  kernel   = prolongation->coarse_near_kernel();
        const Index n_coarse = kernel->GlobalLength();
        near_kernel          = [kernel] { return kernel; };
        if (n_coarse == 0 || n_coarse > rows->numbers()->size() * 4 / 5)
          {
            // The coarse level is hardly smaller. On the finest level nothing is coupled then, and
            // smoothing is enough. On a later one few nodes are left of many bodies and ranks; as
            // this matrix is sparse, the direct solver takes it although it is larger than usual.
            if (levels.size() == 1)
              {
                make_work_space();
                return;
              }
            levels.pop_back();
            break;
          }
        rows   = prolongation->galerkin(*rows, symmetric);
        bodies = prolongation->coarse_body();
        group  = Prolongation::n_nodes_of_aggregate;
        prolongation->initialize_coarse_vector(level.coarse_values);
        level.prolongation = std::move(prolongation);
      }
    make_work_space();
    make_coarsest(*rows, symmetric);
  }



  // Last, when the set-up needs no memory any more; what it has freed is given back.
  void
  Multigrid::make_work_space()
  {
    give_back_free_memory();
    for (const auto &level : levels)
      {
        level->make_smoother(level->smoother, 0, level->eigenvalue);
        for (VectorType *vector : {&level->rhs, &level->solution, &level->residual})
          level->matrix.initialize_vector(*vector);
      }
  }



  // By a polynomial of its own: that of the cycles is made when the set-up is done, for it keeps
  // three vectors.
  double
  Multigrid::largest_eigenvalue(Level &level)
  {
    const auto fail = [](const std::string &reason) {
      throw LinearSolverFailure("multigrid cannot be set up: the largest eigenvalue of a level "
                                "cannot be estimated, " +
                                reason);
    };
    // Sums over all ranks decide: all throw or none.
    try
      {
        Chebyshev  estimate;
        VectorType layout;
        level.matrix.initialize_vector(layout);
        level.make_smoother(estimate, estimate_iterations, 1.);
        level.eigenvalue = estimate.estimate_eigenvalues(layout).max_eigenvalue_estimate;
        // Vectors of its conjugate gradients, which deal.II would keep for later ones.
        GrowingVectorMemory<VectorType>::release_unused_memory();
        level.matrix.free_work_space();
      }
    catch (const ExceptionBase &)
      {
        fail("for the matrix is indefinite, singular or not finite");
      }
    const double largest = level.eigenvalue / margin;
    if (!std::isfinite(largest) || !(largest > 0.))
      fail("for it comes out as " + std::to_string(largest));
    return largest;
  }



  // The coarsest matrix is regular: motions without stiffness got a one on their diagonal
  // (AggregateRows), or else KLU reports it. Its rows stay distributed; Amesos gathers them.
  void
  Multigrid::make_coarsest(BlockRows &rows, const bool symmetric)
  {
    const auto      &numbers = *rows.numbers();
    const Epetra_Map own(-1, static_cast<int>(numbers.locally_owned_size()), 0, map.Comm());
    coarsest_matrix = std::make_unique<Epetra_CrsMatrix>(Copy, own, 0);
    // A block by the first local dofs of its row and column. Small, so that blocks are inserted
    // one by one.
    const auto insert = [&](const unsigned int row, const unsigned int column, const auto &entry) {
      int indices[dim];
      for (unsigned int c = 0; c < dim; ++c)
        indices[c] = static_cast<int>(numbers.local_to_global(column + c));
      for (unsigned int r = 0; r < dim; ++r)
        {
          double values[dim];
          for (unsigned int c = 0; c < dim; ++c)
            values[c] = entry(r, c);
          coarsest_matrix->InsertGlobalValues(own.GID(row + r), dim, values, indices);
        }
    };
    for (unsigned int node = 0; node < rows.n_nodes(); ++node)
      {
        const auto &row = rows.read(node);
        for (unsigned int k = 0; k < row.columns.size(); ++k)
          {
            const BlockRows::Block &block = row.blocks[k];
            const unsigned int      other = row.columns[k];
            if (symmetric && other < node)
              continue;
            insert(dim * node, dim * other, [&](const unsigned int r, const unsigned int c) {
              return block[dim * r + c];
            });
            if (symmetric && other > node && other < rows.n_nodes())
              insert(dim * other, dim * node, [&](const unsigned int r, const unsigned int c) {
                return block[dim * c + r];
              });
          }
      }
    coarsest_matrix->FillComplete();
    coarsest_rhs      = std::make_unique<Epetra_Vector>(own);
    coarsest_solution = std::make_unique<Epetra_Vector>(own);
    coarsest_problem.SetOperator(coarsest_matrix.get());
    coarsest_problem.SetLHS(coarsest_solution.get());
    coarsest_problem.SetRHS(coarsest_rhs.get());
    coarsest.reset(Amesos().Create("Amesos_Klu", coarsest_problem));
    check(coarsest->SymbolicFactorization(), map.Comm());
    check(coarsest->NumericFactorization(), map.Comm());
  }



  int
  Multigrid::ApplyInverse(const Epetra_MultiVector &rhs, Epetra_MultiVector &result) const
  {
    // Krylov methods may pass the same vector for both.
    for (int v = 0; v < rhs.NumVectors(); ++v)
      cycle(0, rhs[v], result[v]);
    return 0;
  }



  // V-cycle from zero: smooth, correct by the coarser level, smooth again by the same polynomial,
  // so that the operator is symmetric. The outer level has double and the others single
  // precision, hence the template; without a prolongation the level is smoothed only.
  template <typename Number>
  void
  Multigrid::cycle(const unsigned int k, const Number *rhs, Number *solution) const
  {
    if (k == levels.size())
      {
        std::copy(rhs, rhs + coarsest_rhs->MyLength(), coarsest_rhs->Values());
        check(coarsest->Solve(), map.Comm());
        std::copy(coarsest_solution->Values(),
                  coarsest_solution->Values() + coarsest_solution->MyLength(),
                  solution);
        return;
      }
    Level &level = *levels[k];
    std::copy(rhs, rhs + level.rhs.locally_owned_size(), level.rhs.begin());
    level.smoother.vmult(level.solution, level.rhs);
    if (level.prolongation)
      {
        level.matrix.vmult(level.residual, level.solution);
        level.residual.sadd(-1.f, 1.f, level.rhs);
        level.prolongation->restrict_to(level.coarse_values, level.residual);
        cycle(k + 1, level.coarse_values.begin(), level.coarse_values.begin());
        level.prolongation->prolongate_and_add(level.solution, level.coarse_values);
      }
    level.smoother.step(level.solution, level.rhs);
    std::copy(level.solution.begin(),
              level.solution.begin() + level.solution.locally_owned_size(),
              solution);
  }
} // namespace Touchstone
