// SPDX-License-Identifier: LGPL-2.1-or-later
// Whatever goes wrong in a linear solver is a LinearSolverFailure with its reason, on all
// ranks: systems that are not finite, indefinite or singular, and what libraries throw. And
// `automatic`: what it takes, when it falls back to MUMPS, and what it says of that.

#include <touchstone/algebra/convergence_watch.h>
#include <touchstone/algebra/mumps_factors.h>
#include <touchstone/base/non_convergence.h>

#include "spring_net.h"
#include <iostream>
#include <limits>

using namespace Touchstone;

namespace
{
  bool
  root()
  {
    return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  /** Throws what it is told to. */
  class Thrower : public LinearSolver
  {
  public:
    explicit Thrower(const LinearSolverParameters &parameters)
      : LinearSolver(parameters)
    {
    }

  private:
    void
    do_solve(const CondensedSystem &, const RigidMotions &, Epetra_Vector &) override
    {
      if (parameters.type == "of memory")
        throw std::bad_alloc();
      if (parameters.type == "of Epetra")
        throw -7;
      throw std::out_of_range("what a library says\nwith a trace");
    }
  };

  const LinearSolverRegistry::Entry<Thrower> memory("of memory", ""), epetra("of Epetra", ""),
    library("of a library", "");

  std::string
  failure(SpringNet &net, LinearSolverParameters parameters)
  {
    try
      {
        const auto    solver = LinearSolverRegistry::make(parameters.type, parameters);
        Epetra_Vector result(net.condensed->rows());
        solver->solve(*net.condensed, *net.motions, result);
        return "solved FAILED";
      }
    catch (const LinearSolverFailure &failure)
      {
        return failure.what();
      }
    catch (const SingularSystem &failure)
      {
        return std::string("singular: ") + failure.what();
      }
  }

  void
  fails(const std::string &title, SpringNet &net, const bool with_cg = true)
  {
    for (const std::string type : {"MUMPS", "Belos CG", "Belos GMRES", "automatic"})
      for (const std::string preconditioner : {"multigrid", "diagonal"})
        {
          const bool iterative = type.substr(0, 5) == "Belos";
          if ((!iterative && preconditioner == "diagonal") || (!with_cg && type == "Belos CG"))
            continue;
          LinearSolverParameters parameters;
          parameters.type           = type;
          parameters.preconditioner = preconditioner;
          const std::string text    = failure(net, parameters);
          if (root())
            std::cout << title << ", " << type << (iterative ? ", " + preconditioner : "") << ": "
                      << text << std::endl;
        }
  }

  void
  automatic(const std::string &title, SpringNet &net, const unsigned int iterations)
  {
    LinearSolverParameters parameters;
    parameters.maximum_iterations = iterations;
    const auto    solver          = LinearSolverRegistry::make("automatic", parameters);
    Epetra_Vector result(net.condensed->rows());
    for (unsigned int k = 0; k < 2; ++k)
      solver->solve(*net.condensed, *net.motions, result);
    const std::vector<std::string> remarks = solver->take_remarks();
    if (!root())
      return;
    std::cout << "automatic, " << title << ": "
              << (solver->counts().factorisations > 0 ? "MUMPS" : "iterations") << std::endl;
    for (const std::string &remark : remarks)
      std::cout << "  " << remark << std::endl;
    if (!solver->take_remarks().empty())
      std::cout << "said twice FAILED" << std::endl;
  }

  /** Residuals that fall by a factor each. */
  void
  watch(const double factor)
  {
    ConvergenceWatch watch(1e-6, 100);
    std::string      text = "goes on";
    try
      {
        for (double residual = 1.; watch.iterations() < 50; residual *= factor)
          watch.next(residual);
      }
    catch (const SlowConvergence &slowness)
      {
        text = "after " + std::to_string(watch.iterations()) + ": " + slowness.what();
      }
    if (root())
      std::cout << "residuals fall by " << factor << ": " << text << std::endl;
  }



  /** A spring of an unknown to the ground, on one rank. */
  std::function<void(LinearSystem &)>
  spring(const Index i, const double stiffness)
  {
    return [=](LinearSystem &system) {
      if (root())
        system.terms.push_back({{{i, stiffness}}, {{i, 1.}}});
    };
  }



  /** Values that are not finite, in the right-hand side or in the matrix, are seen. */
  void
  not_finite()
  {
    const double nan      = std::numeric_limits<double>::quiet_NaN();
    const double inf      = std::numeric_limits<double>::infinity();
    const auto   set_last = [](const double value) {
      return [value](LinearSystem &system) {
        if (system.rhs.in_local_range(1665))
          system.rhs(1665) = value;
      };
    };
    {
      SpringNet net(0., false, 10, set_last(nan));
      fails("right-hand side NaN", net);
    }
    {
      SpringNet net(0., false, 10, set_last(inf));
      fails("right-hand side infinite", net);
    }
    {
      SpringNet net(0., false, 10, spring(1665, nan));
      fails("matrix NaN", net);
    }
    {
      SpringNet net(0., false, 10, spring(1665, inf));
      fails("matrix infinite", net);
    }
  }



  /** Conjugate gradients need a definite matrix. */
  void
  indefinite()
  {
    SpringNet              net(0., false, 10, [](LinearSystem &system) {
      for (Index i = 1500; i < 1800 && root(); ++i)
        system.terms.push_back({{{i, -100.}}, {{i, 1.}}});
    });
    LinearSolverParameters parameters;
    parameters.type           = "Belos CG";
    parameters.preconditioner = "diagonal";
    const std::string text    = failure(net, parameters);
    if (root())
      std::cout << "indefinite, Belos CG, diagonal: " << text << std::endl;
  }



  /** MUMPS sees a singular matrix. */
  void
  singular()
  {
    // A multiplier of nothing.
    SpringNet              net(0., true, 10, [](LinearSystem &system) { system.terms.clear(); });
    LinearSolverParameters parameters;
    parameters.type        = "MUMPS";
    const std::string text = failure(net, parameters);
    if (root())
      std::cout << "singular, MUMPS: " << text.substr(0, text.find(':', 10)) << std::endl;
  }



  /** Smoothers and scaling divide by the diagonal. */
  void
  zero_on_the_diagonal()
  {
    // An entry of the diagonal that is zero: not what smoothers can divide by.
    SpringNet              net(0., false, 10, spring(1665, -10.), 0.);
    LinearSolverParameters parameters;
    parameters.patience = 100; // or factors take the place of multigrid
    for (const std::string type : {"Belos CG", "Belos GMRES"})
      for (const std::string preconditioner : {"multigrid", "diagonal"})
        {
          parameters.type           = type;
          parameters.preconditioner = preconditioner;
          const std::string text    = failure(net, parameters);
          if (root())
            std::cout << "zero on the diagonal, " << type << ", " << preconditioner << ": " << text
                      << std::endl;
        }
  }



  /** Exceptions of libraries, and the codes of MUMPS, become reasons. */
  void
  exceptions_of_libraries()
  {
    for (const std::string type : {"of memory", "of Epetra", "of a library"})
      {
        SpringNet              net(0., false, 4);
        LinearSolverParameters parameters;
        parameters.type        = type;
        const std::string text = failure(net, parameters);
        if (root())
          std::cout << text << std::endl;
      }
    if (root())
      for (const int code : {-6, -9, -10, -13, -40, -51, -90, -1000})
        std::cout << "MUMPS: " << MumpsFactors::reason(code, 3) << std::endl;
  }



  /** The automatic choice of the solver, and what takes over where iterations are too slow. */
  void
  automatic_choice()
  {
    SpringNet small(0.8, false), large(0., false, 16), friction(0.8, false, 16),
      multiplier(0., true, 16);
    automatic("small", small, 2000);
    automatic("large", large, 2000);
    automatic("large with friction", friction, 2000);
    automatic("large with multipliers", multiplier, 2000);
    automatic("large, too slow", large, 2);
    automatic("large with friction, too slow", friction, 2);
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  not_finite();
  indefinite();
  singular();
  zero_on_the_diagonal();
  exceptions_of_libraries();
  for (const double factor : {0.5, 0.85, 0.9, 1.1})
    watch(factor);
  automatic_choice();
  return 0;
}
