// Iterative solvers against MUMPS, on a small elastic-like system without and with
// an unsymmetric part as friction makes it; conjugate gradients must refuse the
// latter, and multigrid extra unknowns.

#include <touchstone/algebra/linear_solver.h>
#include <touchstone/algebra/non_convergence.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Epetra_Map.h>
#include <cmath>
#include <iostream>

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** Nodes of a cube with three unknowns each. */
  constexpr unsigned int side = 10, n_nodes = side * side * side, n = 3 * n_nodes;

  /** Neighbours of a node, and whether they differ in the direction d. */
  void
  for_neighbours(const unsigned int                                            node,
                 const std::function<void(unsigned int node, unsigned int d)> &action)
  {
    unsigned int stride = 1;
    for (unsigned int d = 0; d < 3; ++d, stride *= side)
      {
        const unsigned int i = node / stride % side;
        if (i > 0)
          action(node - stride, d);
        if (i + 1 < side)
          action(node + stride, d);
      }
  }

  /** A net of springs, with its lowest layer held and an upper corner coupled to
   * its neighbours by @p friction in one triangle of the matrix only. */
  struct System
  {
    Matrix                           stiffness;
    LinearSystem                     system;
    std::unique_ptr<CondensedSystem> condensed;
    std::unique_ptr<RigidMotions>    motions;

    System(const double friction, const bool multiplier)
    {
      const MPI_Comm     communicator = MPI_COMM_WORLD;
      const unsigned int rank         = Utilities::MPI::this_mpi_process(communicator);
      const unsigned int n_ranks      = Utilities::MPI::n_mpi_processes(communicator);
      const unsigned int begin        = n_nodes * rank / n_ranks;
      const unsigned int end          = n_nodes * (rank + 1) / n_ranks;
      IndexSet           owned(n);
      owned.add_range(3 * begin, 3 * end);

      IndexSet nodes(n_nodes);
      nodes.add_range(begin, end);
      DynamicSparsityPattern pattern(n_nodes, n_nodes, nodes);
      const auto             springs = [&](const auto &set) {
        for (unsigned int node = begin; node < end; ++node)
          for_neighbours(node, [&](const unsigned int other, const unsigned int d) {
            set(node, other, d);
          });
      };
      springs([&](const unsigned int node, const unsigned int other, unsigned int) {
        pattern.add(node, node);
        pattern.add(node, other);
      });
      stiffness.reinit(owned, pattern, communicator, true);
      springs([&](const unsigned int node, const unsigned int other, const unsigned int d) {
        const int          rows[]  = {stiffness.row(3 * node), -1};
        const unsigned int nodes[] = {stiffness.node(3 * node), stiffness.node(3 * other)};
        stiffness.add(2, rows, nodes, [&](const unsigned int i, const unsigned int j) {
          const double k = d == i ? 3. : 1.;
          return i != j % 3 ? 0. : j < 3 ? k + 1e-6 / 6. : -k;
        });
      });

      system.stiffness = &stiffness;
      system.tolerance = 1e-10;
      system.rhs.reinit(owned, communicator);
      for (unsigned int i = 3 * begin; i < 3 * end; ++i)
        system.rhs[i] = std::sin(1. + i);
      system.rhs.compress(VectorOperation::insert);
      AffineConstraints<double> constraints(complete_index_set(n));
      for (unsigned int i = 0; i < 3 * side * side; ++i)
        constraints.add_line(i);
      constraints.close();
      system.constraints.copy_from(constraints);
      // As the tangential force mu lambda of sliding nodes: from normal to
      // tangential unknowns and not back.
      if (friction != 0.)
        {
          system.symmetric = false;
          if (rank == 0)
            for (unsigned int node = n_nodes - side * side; node < n_nodes; ++node)
              for_neighbours(node, [&](const unsigned int other, unsigned int) {
                system.terms.push_back({{{3 * node, friction}}, {{3 * other + 2, 1.}}});
              });
        }
      system.first_extra = n;
      if (multiplier)
        {
          system.definite = false;
          if (rank == 0)
            {
              system.n_extra   = 1;
              system.extra_rhs = {1.};
              system.terms.push_back({{{n, 1.}}, {{n - 1, 1.}}});
              system.terms.push_back({{{n - 1, 1.}}, {{n, 1.}}});
            }
          else
            ++system.first_extra;
        }
      condensed = std::make_unique<CondensedSystem>(system);

      const Epetra_Map &map = stiffness.rows();
      motions.reset(new RigidMotions{Epetra_MultiVector(map, 3), {}});
      motions->body.resize(map.NumMyElements());
      for (int i = 0; i < map.NumMyElements(); ++i)
        motions->columns[i % 3][i] = 1.;
    }
  };



  std::unique_ptr<Epetra_Vector>
  solve(const std::string &type, System &system, const unsigned int restart = 100)
  {
    LinearSolverParameters parameters;
    parameters.type    = type;
    parameters.restart = restart;
    const auto solver  = LinearSolverRegistry::make(type, parameters);
    auto       result  = std::make_unique<Epetra_Vector>(system.condensed->rows());
    solver->solve(*system.condensed, *system.motions, *result);
    return result;
  }



  void
  compare(const std::string &title, System &system, const std::string &type, const unsigned int m)
  {
    const bool root = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    try
      {
        const auto exact = solve("MUMPS", system), result = solve(type, system, m);
        double     size = 0., error = 0.;
        exact->Norm2(&size);
        result->Update(-1., *exact, 1.);
        result->Norm2(&error);
        if (root)
          std::cout << title << ", " << type << ", restart " << m << ": "
                    << (error <= 1e-7 * size ? "as MUMPS" : "differs FAILED") << std::endl;
      }
    catch (const LinearSolverFailure &failure)
      {
        if (root)
          std::cout << title << ": " << failure.what() << std::endl;
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool                       root = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  for (const std::string type : {"MUMPS", "Belos CG", "Belos GMRES"})
    if (root)
      std::cout << type
                << (LinearSolverRegistry::make(type, LinearSolverParameters())->symmetric_only()
                      ? ": symmetric only"
                      : ": any symmetry")
                << std::endl;

  System symmetric(0., false), unsymmetric(0.8, false), extra(0., true);
  compare("symmetric", symmetric, "Belos CG", 100);
  compare("symmetric", symmetric, "Belos GMRES", 100);
  compare("unsymmetric", unsymmetric, "Belos GMRES", 100);
  compare("unsymmetric", unsymmetric, "Belos GMRES", 4);
  compare("unsymmetric", unsymmetric, "Belos CG", 100);
  compare("multiplier", extra, "Belos GMRES", 100);
}
