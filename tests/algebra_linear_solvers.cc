// SPDX-License-Identifier: LGPL-2.1-or-later
// Iterative solvers against MUMPS, on a small elastic-like system without and with
// an unsymmetric part as friction makes it; conjugate gradients must refuse the
// latter, and multigrid extra unknowns.

#include <touchstone/base/non_convergence.h>

#include "spring_net.h"
#include <iostream>

using namespace Touchstone;
using namespace dealii;

namespace
{
  std::unique_ptr<Epetra_Vector>
  solve(const std::string &type,
        SpringNet         &system,
        const unsigned int restart        = 100,
        const std::string &preconditioner = "multigrid")
  {
    LinearSolverParameters parameters;
    parameters.type           = type;
    parameters.restart        = restart;
    parameters.preconditioner = preconditioner;
    const auto solver         = LinearSolverRegistry::make(type, parameters);
    auto       result         = std::make_unique<Epetra_Vector>(system.condensed->rows());
    solver->solve(*system.condensed, *system.motions, *result);
    return result;
  }



  void
  compare(const std::string &title,
          SpringNet         &system,
          const std::string &type,
          const unsigned int m,
          const std::string &preconditioner = "multigrid")
  {
    const bool root = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    try
      {
        const auto exact = solve("MUMPS", system), result = solve(type, system, m, preconditioner);
        double     size = 0., error = 0.;
        exact->Norm2(&size);
        result->Update(-1., *exact, 1.);
        result->Norm2(&error);
        if (root)
          std::cout << title << ", " << type << ", restart " << m
                    << (preconditioner == "diagonal" ? ", diagonal: " : ": ")
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

  SpringNet symmetric(0., false), unsymmetric(0.8, false), extra(0., true);
  compare("symmetric", symmetric, "Belos CG", 100);
  compare("symmetric", symmetric, "Belos GMRES", 100);
  compare("unsymmetric", unsymmetric, "Belos GMRES", 100);
  compare("unsymmetric", unsymmetric, "Belos GMRES", 4);
  compare("unsymmetric", unsymmetric, "Belos CG", 100);
  compare("multiplier", extra, "Belos GMRES", 100);
  compare("symmetric", symmetric, "Belos CG", 100, "diagonal");
  compare("unsymmetric", unsymmetric, "Belos GMRES", 100, "diagonal");
  return 0;
}
