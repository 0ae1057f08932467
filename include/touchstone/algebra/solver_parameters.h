#ifndef touchstone_algebra_solver_parameters_h
#define touchstone_algebra_solver_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Touchstone
{
  /** @brief Section "Linear solver". */
  struct LinearSolverParameters
  {
    /** "automatic", "MUMPS", "Belos CG" or "Belos GMRES". */
    std::string type = "automatic";
    /** Relative residual to which an iterative solver takes the system of a
     * Newton iteration (inexact Newton); no unit. */
    double       tolerance          = 1e-4;
    unsigned int maximum_iterations = 2000;
    /** Iterations of GMRES after which it starts anew, to save memory. */
    unsigned int restart = 100;
    /** Of iterative solvers: "multigrid" or "diagonal". */
    std::string preconditioner = "multigrid";
    /** No key: an iterative solver fails at once if it would take more iterations than these;
     * 0: it goes on. */
    unsigned int patience = 0;
    /** Of iterative solvers: "applied" or "assembled". */
    std::string contact_operator = "applied";
    /** Of MUMPS: relative size of what is left out of the blocks of its factors; 0
     * keeps all; no unit. */
    double low_rank_tolerance = 0.;
    /** Of MUMPS: the factors are kept in files. */
    bool out_of_core = false;

    /** @brief Whether the type is one that only iterates. */
    bool
    iterative() const
    {
      return type == "Belos CG" || type == "Belos GMRES";
    }

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif
