// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_solver_parameters_h
#define touchstone_algebra_solver_parameters_h

#include <touchstone/base/keyword.h>
#include <touchstone/base/plugin_parameters.h>
#include <touchstone/base/registry.h>

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <memory>
#include <string>

namespace Touchstone
{
  /**
   * @brief Keys of a linear solver or preconditioner of its own, registered under its name. They
   * stand in the section "Linear solver" whatever solver is chosen, since solvers use each other
   * ("automatic" uses MUMPS), so their names are unlike those of all others of the section; a
   * scene that sets keys of a solver that it does not use is rejected.
   */
  using LinearSolverOptionsRegistry = Registry<PluginParameters>;

  /** @brief Section "Linear solver". */
  struct LinearSolverParameters
  {
    /** A name of LinearSolverRegistry. */
    std::string type = "automatic";
    /** Relative residual to which an iterative solver takes the system of a
     * Newton iteration (inexact Newton); no unit. */
    double       tolerance          = 1e-4;
    unsigned int maximum_iterations = 2000;
    /** Iterations of GMRES between restarts, which bound its memory. */
    unsigned int restart = 100;
    /** Of the Krylov solvers of Belos: a name of PreconditionerRegistry. */
    std::string preconditioner = "multigrid";
    /** Not a key of the input: an iterative solver fails as soon as it is expected to take more
     * iterations than these; 0: no limit of this kind. */
    unsigned int patience = 0;
    /** Unknowns up to which factors take the place of multigrid where that is slow: they take some
     * GB of memory. */
    unsigned int factorise_up_to = 200000;
    /** Not a key of the input: the largest ratio of bulk to shear modulus among the materials,
     * where nothing but their stiffness is in the system; 0: no such system. */
    double bulk_over_shear = 0.;
    /** How iterative solvers multiply: factor by factor, or with the assembled matrix. */
    enum class ContactOperator
    {
      applied,
      assembled
    };
    Keyword<ContactOperator> contact_operator{ContactOperator::applied,
                                              {{"applied", ContactOperator::applied},
                                               {"assembled", ContactOperator::assembled}}};
    /** Keys of the registered solvers and preconditioners, by their names. */
    std::map<std::string, std::shared_ptr<PluginParameters>> options = all_options();

    /** @brief The keys of the class that is registered as @p name. */
    template <class Options>
    const Options &
    options_of(const std::string &name) const
    {
      return dynamic_cast<const Options &>(*options.at(name));
    }

    /** @brief Whether the materials are so nearly incompressible that multigrid needs more
     * iterations than factors are worth (doc/solvers.md). */
    bool
    nearly_incompressible() const;

    /** @brief The same, of a system that is small enough for factors. */
    bool
    prefers_factors(int n_dofs) const;

    /** @brief What the log says of nearly_incompressible() materials. */
    std::string
    incompressibility() const;

    /** @brief What the solver of this type can do (LinearSolver). */
    bool
    takes_multipliers() const;
    bool
    symmetric_only() const;

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;

  private:
    static std::map<std::string, std::shared_ptr<PluginParameters>>
    all_options();
  };
} // namespace Touchstone

#endif
