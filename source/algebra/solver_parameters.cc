#include <touchstone/algebra/solver_parameters.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/parameter_checks.h>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  void
  LinearSolverParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Type",
                      type,
                      "'MUMPS' factorises; 'Belos CG' and 'Belos GMRES' iterate with "
                      "multigrid, for large models without multipliers: CG takes "
                      "symmetric systems, GMRES also unsymmetric ones. 'automatic' takes, from "
                      "10,000 unknowns on and without multipliers, CG for symmetric systems and "
                      "GMRES for unsymmetric ones, and MUMPS otherwise or if these would take "
                      "longer, which the log says.",
                      Patterns::Selection("automatic|MUMPS|Belos CG|Belos GMRES"));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Relative residual to which an iterative solver takes the linear "
                      "system of a Newton iteration. Newton's own 'Residual tolerance' "
                      "decides how exact the result is. [no unit]",
                      Patterns::Double(0., 1.));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "Of Belos CG or GMRES in one solve.",
                      Patterns::Integer(1));
    prm.add_parameter("Restart",
                      restart,
                      "GMRES starts anew after this many iterations. It keeps two vectors "
                      "for each of them.",
                      Patterns::Integer(1));
    prm.add_parameter("Preconditioner",
                      preconditioner,
                      "Of Belos CG or GMRES: 'multigrid' by smoothed aggregation, in whose place "
                      "they keep the factors of a matrix where it would be slow; 'diagonal' "
                      "multiplies by the inverse 3 x 3 diagonal blocks of the nodes, many times "
                      "as slow, to compare with published work.",
                      Patterns::Selection("multigrid|diagonal"));
    prm.add_parameter("Contact operator",
                      contact_operator,
                      "How an iterative solver multiplies: 'applied' applies constraints and "
                      "contact terms beside the continuum matrix, and assembles all in "
                      "one matrix only where multigrid is set up; 'assembled' does so in each "
                      "Newton iteration.",
                      Patterns::Selection("applied|assembled"));
    prm.add_parameter(
      "Low rank tolerance",
      low_rank_tolerance,
      "MUMPS compresses the blocks of its factors, up to this relative error: less "
      "memory for large models, at about the same time; 0: not at all. 1e-8 costs no "
      "Newton iteration. [no unit]",
      Patterns::Double(0., 1e-2));
    prm.add_parameter("Out of core",
                      out_of_core,
                      "MUMPS keeps its factors in files, in the folder that the environment "
                      "variable MUMPS_OOC_TMPDIR names or in /tmp: for models that memory has "
                      "no room for.",
                      Patterns::Bool());
  }



  void
  LinearSolverParameters::check(const std::string &section) const
  {
    check_positive(section,
                   "Tolerance",
                   tolerance,
                   "two to four digits a Newton iteration are usual: 1e-3");
    if (preconditioner != "multigrid" && !iterative())
      throw InputError(section,
                       "Preconditioner",
                       preconditioner,
                       "is for solvers that iterate, but 'Type' is '" + type + "'",
                       "remove it, or set 'Type' to 'Belos CG' or 'Belos GMRES'");
    if (iterative())
      for (const auto &[key, set, value] :
           {std::make_tuple("Low rank tolerance",
                            low_rank_tolerance > 0.,
                            Patterns::Tools::to_string(low_rank_tolerance)),
            std::make_tuple("Out of core", out_of_core, std::string("true"))})
        if (set)
          throw InputError(section,
                           key,
                           value,
                           "is an option of MUMPS, but 'Type' is '" + type + "'",
                           "remove it, or set 'Type' to 'MUMPS'");
  }
} // namespace Touchstone
