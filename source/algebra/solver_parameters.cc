// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/linear_solver.h>
#include <touchstone/algebra/solver_parameters.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/parameter_checks.h>

#include <cmath>
#include <sstream>
#include <string>

// Section 'Linear solver' of the input file. Keys of single solvers and preconditioners are
// declared by these (LinearSolverOptionsRegistry), and keys that have no effect with the chosen
// 'Type' are errors: a user who sets them expects something.
namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    /**
     * The lines "KEY = VALUE" of the present values of options: printing them is the one way to
     * compare keys of any type without knowing them.
     */
    std::vector<std::string>
    lines(PluginParameters &options)
    {
      ParameterHandler prm;
      options.declare(prm);
      std::stringstream text;
      prm.print_parameters(text, ParameterHandler::ShortPRM);
      std::vector<std::string> result;
      for (std::string line; std::getline(text, line);)
        if (const std::size_t begin = line.find("set "); begin != std::string::npos)
          result.push_back(line.substr(begin + 4));
      return result;
    }

    /**
     * Reject values other than the defaults for options of a solver that is not used: a key set
     * to its default cannot be told from one that is not set, and does no harm.
     */
    void
    refuse_unused(const std::string &section,
                  const std::string &type,
                  const std::string &name,
                  PluginParameters  &options)
    {
      const auto                     fresh = LinearSolverOptionsRegistry::make(name);
      const std::vector<std::string> given = lines(options), defaults = lines(*fresh);
      for (std::size_t k = 0; k < given.size(); ++k)
        if (given[k] != defaults[k])
          {
            const std::size_t equal = given[k].find('=');
            throw InputError(section,
                             dealii::Utilities::trim(given[k].substr(0, equal)),
                             dealii::Utilities::trim(given[k].substr(equal + 1)),
                             "is an option of " + name + ", but 'Type' is '" + type + "'",
                             "remove it, or set '" +
                               std::string(LinearSolverRegistry::knows(name) ? "Type"
                                                                             : "Preconditioner") +
                               "' to '" + name + "'");
          }
    }
  } // namespace



  std::map<std::string, std::shared_ptr<PluginParameters>>
  LinearSolverParameters::all_options()
  {
    std::map<std::string, std::shared_ptr<PluginParameters>> result;
    for (const std::string &name : LinearSolverOptionsRegistry::names())
      result[name] = LinearSolverOptionsRegistry::make(name);
    return result;
  }



  bool
  LinearSolverParameters::nearly_incompressible() const
  {
    // Poisson's ratio 0.485. The table in doc/solvers.md has what multigrid and factors take on
    // both sides of it.
    constexpr double much = 33.;
    return bulk_over_shear > much;
  }



  bool
  LinearSolverParameters::prefers_factors(const int n_dofs) const
  {
    return nearly_incompressible() && static_cast<unsigned int>(n_dofs) <= factorise_up_to;
  }



  std::string
  LinearSolverParameters::incompressibility() const
  {
    return "multigrid takes many iterations near incompressibility (bulk over shear modulus " +
           std::to_string(std::lround(bulk_over_shear)) + ")";
  }



  // What a type of solver can do is the solver's own knowledge: one is made to be asked, which
  // costs nothing before its first solve.
  bool
  LinearSolverParameters::takes_multipliers() const
  {
    return LinearSolverRegistry::make(type, *this)->takes_multipliers();
  }



  bool
  LinearSolverParameters::symmetric_only() const
  {
    return LinearSolverRegistry::make(type, *this)->symmetric_only();
  }



  void
  LinearSolverParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Type",
                      type,
                      "What solves the linear systems of Newton's method. " +
                        LinearSolverRegistry::documentation(),
                      Patterns::Selection(LinearSolverRegistry::selection()));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Relative residual to which an iterative solver takes the linear "
                      "system of a Newton iteration. Newton's own 'Residual tolerance' "
                      "decides how exact the result is. [no unit]",
                      Patterns::Double(0., 1.));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "Of solvers that iterate, in one solve.",
                      Patterns::Integer(1));
    prm.add_parameter("Restart",
                      restart,
                      "GMRES starts anew after this many iterations. It keeps two vectors "
                      "for each of them.",
                      Patterns::Integer(1));
    prm.add_parameter("Preconditioner",
                      preconditioner,
                      "Of Belos CG or GMRES. " + PreconditionerRegistry::documentation(),
                      Patterns::Selection(PreconditionerRegistry::selection()));
    prm.add_parameter("Factorise up to",
                      factorise_up_to,
                      "Unknowns of a system up to which factors of MUMPS take the place of "
                      "multigrid where this is slow: as the preconditioner of Belos CG and GMRES, "
                      "and near incompressibility in 'automatic'. [no unit]",
                      Patterns::Integer(0));
    contact_operator.declare(prm,
                             "Contact operator",
                             "How an iterative solver multiplies: 'applied' applies constraints "
                             "and contact terms beside the continuum matrix, and assembles all in "
                             "one matrix only where multigrid is set up; 'assembled' does so in "
                             "each Newton iteration.");
    // All are declared whatever the type is, since the parser must know each key before it reads
    // 'Type'.
    for (const auto &of_one : options)
      of_one.second->declare(prm);
  }



  // Errors of the input that only the combination of keys shows: a preconditioner for a direct
  // solver, keys of a solver that is not used. Each message names the key, its value and the
  // remedy.
  void
  LinearSolverParameters::check(const std::string &section) const
  {
    check_positive(section,
                   "Tolerance",
                   tolerance,
                   "two to four digits a Newton iteration are usual: 1e-3");
    const auto solver = LinearSolverRegistry::make(type, *this);
    if (preconditioner != LinearSolverParameters().preconditioner &&
        !solver->takes_preconditioner())
      throw InputError(section,
                       "Preconditioner",
                       preconditioner,
                       "is for solvers that iterate, but 'Type' is '" + type + "'",
                       "remove it, or set 'Type' to 'Belos CG' or 'Belos GMRES'");
    const std::set<std::string> used = solver->used_options();
    for (const auto &[name, of_one] : options)
      if (used.count(name) > 0)
        of_one->check(section);
      else
        refuse_unused(section, type, name, *of_one);
  }
} // namespace Touchstone
