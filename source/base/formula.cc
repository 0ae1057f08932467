// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/formula.h>
#include <touchstone/base/input_error.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <regex>
#include <sstream>

/**
 * @file
 * Formulas of the scene in x, y, z and t, evaluated by muParser. A value that is not finite, or
 * not within its bounds, is recorded and the evaluation goes on; the user of the formulas asks
 * Formulas::check() after a loop, on all ranks together. Throwing at once would stop one rank
 * alone.
 */

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Whether the formula depends on the position. */
    bool
    depends_on_place(const std::string &text)
    {
      return std::regex_search(text, std::regex("\\b[xyz]\\b"));
    }

    /** Blank text stands for no formula. */
    bool
    empty(const std::string &text)
    {
      return text.find_first_not_of(" \t") == std::string::npos;
    }
  } // namespace



  Formula::Formula(const std::string   &section,
                   const std::string   &key,
                   const std::string   &text,
                   const FormulaBounds &bounds)
    : section(section)
    , key(key)
    , text(text)
    , bounds(bounds)
    , of_position(depends_on_place(text))
    , of_time(std::regex_search(text, std::regex("\\bt\\b")))
    , function(std::make_unique<FunctionParser<dim>>(1))
  {
    // All variables are declared, also where a formula must not use them: check_expression() finds
    // that with a message of its own.
    function->initialize("x,y,z,t", text, {{"pi", numbers::PI}}, /*time_dependent=*/true);
  }



  double
  Formula::value(const Point<dim> &x, const double t) const
  {
    if (function->get_time() != t)
      function->set_time(t);
    const double result = function->value(x);
    // Only the first failure is kept: it has position and time for the message.
    if (!bounds.admit(result) && !failure)
      failure = Failure{result, x, t};
    return result;
  }



  std::pair<std::string, std::string>
  Formula::problem() const
  {
    const bool         finite = std::isfinite(failure->value);
    std::ostringstream out;
    // Decimal points, whatever the locale of the user.
    out.imbue(std::locale::classic());
    out << "its value is ";
    if (finite)
      out << failure->value;
    else
      out << (std::isnan(failure->value) ? "not a number" : "infinite");
    out << " at ";
    if (of_position)
      out << "x = " << failure->x[0] << ", y = " << failure->x[1] << ", z = " << failure->x[2]
          << " and ";
    out << "t = " << failure->t;
    if (finite)
      out << ": " << bounds.reason;
    return {out.str(), finite ? "has possible values" : "is finite"};
  }



  std::shared_ptr<const Formula>
  Formulas::add(const std::string   &section,
                const std::string   &key,
                const std::string   &text,
                const FormulaBounds &bounds)
  {
    if (empty(text))
      return nullptr;
    all.push_back(std::make_shared<const Formula>(section, key, text, bounds));
    return all.back();
  }



  void
  Formulas::check(const MPI_Comm communicator) const
  {
    // Of all formulas that failed on any rank the first of the scene is reported, with the position
    // on the lowest rank that has one. All ranks have added the same formulas in the same order.
    unsigned int first = 0;
    while (first < all.size() && !all[first]->failure)
      ++first;
    const unsigned int failed = Utilities::MPI::min(first, communicator);
    if (failed == all.size())
      return;
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int who =
      Utilities::MPI::min(all[failed]->failure ? rank : numbers::invalid_unsigned_int,
                          communicator);
    const auto [problem, demand] =
      Utilities::MPI::broadcast(communicator,
                                rank == who ? all[failed]->problem()
                                            : std::pair<std::string, std::string>(),
                                who);
    throw InputError(all[failed]->section,
                     all[failed]->key,
                     all[failed]->text,
                     problem,
                     "give a formula that " + demand +
                       " everywhere on the body and at all times, from t = 0 on");
  }



  void
  check_at_all_steps(const std::string         &section,
                     const std::string         &key,
                     const std::string         &text,
                     const std::vector<double> &times,
                     const FormulaBounds       &bounds)
  {
    if (empty(text) || depends_on_place(text))
      return;
    Formulas   one;
    const auto formula = one.add(section, key, text, bounds);
    formula->value(Point<dim>(), 0.);
    for (const double t : times)
      formula->value(Point<dim>(), t);
    one.check(MPI_COMM_SELF);
  }
} // namespace Touchstone
