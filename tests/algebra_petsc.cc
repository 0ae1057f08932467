// SPDX-License-Identifier: LGPL-2.1-or-later
// Solvers of PETSc against MUMPS on small systems: by default and with options, and what they
// say of options that are wrong, of systems that they cannot solve, and of too few iterations.

#include <touchstone/base/input_error.h>
#include <touchstone/base/non_convergence.h>

#include "spring_net.h"
#include <iostream>

using namespace Touchstone;
using namespace dealii;

namespace
{
  bool
  root()
  {
    return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  /** As a scene file sets it. */
  LinearSolverParameters
  parameters(const std::string &type, const std::string &options)
  {
    LinearSolverParameters result;
    ParameterHandler       prm;
    result.declare(prm);
    prm.set("Type", type);
    if (!options.empty())
      prm.set("PETSc options", options);
    return result;
  }

  /** What solve() has left; a new solver for each system, or @p n_solves with one. */
  std::unique_ptr<Epetra_Vector>
  solve(const LinearSolverParameters &parameters, SpringNet &net, const unsigned int n_solves = 1)
  {
    const auto solver = LinearSolverRegistry::make(parameters.type, parameters);
    auto       result = std::make_unique<Epetra_Vector>(net.condensed->rows());
    for (unsigned int k = 0; k < n_solves; ++k)
      solver->solve(*net.condensed, *net.motions, *result);
    const unsigned int n_set_up =
      solver->counts().preconditioner_setups + solver->counts().factorisations;
    if (n_solves > 1 && root())
      std::cout << n_solves << " solves of the same system, " << n_set_up << " set-up(s)\n";
    for (const std::string &remark : solver->take_remarks())
      if (root())
        std::cout << "remark: " << remark << '\n';
    return result;
  }

  void
  compare(const std::string &title,
          SpringNet         &net,
          const std::string &options,
          const unsigned int n_solves = 1)
  {
    if (root())
      std::cout << title << ", '" << options << "': " << std::flush;
    try
      {
        const auto exact  = solve(parameters("MUMPS", ""), net),
                   result = solve(parameters("PETSc", options), net, n_solves);
        double size = 0., error = 0.;
        exact->Norm2(&size);
        result->Update(-1., *exact, 1.);
        result->Norm2(&error);
        if (root())
          std::cout << (error <= 1e-7 * size ? "as MUMPS" : "differs FAILED") << std::endl;
      }
    catch (const LinearSolverFailure &failure)
      {
        if (root())
          std::cout << failure.what() << std::endl;
      }
  }

  void
  check(const std::string &type, const std::string &options)
  {
    std::string text = "accepted";
    try
      {
        parameters(type, options).check("Linear solver");
      }
    catch (const InputError &error)
      {
        text = error.what();
      }
    if (root())
      std::cout << "'" << options << "' of " << type << ": " << text << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  SpringNet symmetric(0., false), unsymmetric(0.8, false), extra(0., true);
  compare("symmetric", symmetric, "", 2);
  compare("symmetric", symmetric, "-pc_type hypre");
  compare("symmetric", symmetric, "-ksp_type preonly -pc_type lu -pc_factor_mat_solver_type mumps");
  compare("unsymmetric", unsymmetric, "");
  compare("unsymmetric", unsymmetric, "-pc_type hypre -ksp_type bcgs");
  compare("multiplier", extra, "");
  compare("symmetric", symmetric, "-ksp_max_it 2");
  compare("symmetric", symmetric, "-mg_levels_9_ksp_max_it 2");

  check("PETSc", "");
  check("PETSc", "-pc_type gamg -mg_levels_9_ksp_max_it 2 -pc_gamg_threshold 0.01");
  check("PETSc", "-ksp_type nonsense");
  check("PETSc", "-ksp_tpye cg");
  check("MUMPS", "-ksp_type cg");
  return 0;
}
