// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_formula_h
#define touchstone_base_formula_h

#include <touchstone/base/types.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Values that a formula may have: between two numbers, which it must not reach. */
  struct FormulaBounds
  {
    double lower = -std::numeric_limits<double>::infinity(),
           upper = std::numeric_limits<double>::infinity();
    /** What is wrong with other values, a sentence for messages. */
    std::string reason = "";

    /** @brief False for what is not finite, too. */
    bool
    admit(const double value) const
    {
      return value > lower && value < upper;
    }
  };

  /** @brief A formula of the scene in x, y, z, t and pi (muParser's language), which
   * knows the entry that it comes from. */
  class Formula
  {
  public:
    /** @param section, key The entry of the scene file, for messages.
     * @param text The formula.
     * @param bounds Of its values. */
    Formula(const std::string   &section,
            const std::string   &key,
            const std::string   &text,
            const FormulaBounds &bounds = {});

    /** @brief Value at the point @p x (length) and time @p t. A value that the bounds do not admit
     * is returned as it is, and remembered for Formulas::check(). */
    double
    value(const dealii::Point<dim> &x, double t) const;

    /** @brief Whether the formula names x, y or z, or the time. */
    bool
    depends_on_position() const
    {
      return of_position;
    }
    bool
    depends_on_time() const
    {
      return of_time;
    }

    /** @brief Section, key and text of the entry, for messages. */
    std::vector<std::string>
    entry() const
    {
      return {section, key, text};
    }

  private:
    friend class Formulas;

    const std::string                            section, key, text;
    const FormulaBounds                          bounds;
    const bool                                   of_position, of_time;
    std::unique_ptr<dealii::FunctionParser<dim>> function;

    /** Where the first value was that is not admitted. */
    struct Failure
    {
      double             value;
      dealii::Point<dim> x;
      double             t;
    };
    mutable std::optional<Failure> failure;

    /** What has failed, as a sentence; and what the formula must be instead, a verb. */
    std::pair<std::string, std::string>
    problem() const;
  };

  /**
   * @brief The formulas of one part of the program, whose values must be finite and within their
   * bounds.
   *
   * Each rank computes values at its own points, and must not throw alone, since the
   * others would wait for it. Failures are collected, and reported by all ranks together.
   */
  class Formulas
  {
  public:
    /** @return null for an empty @p text. */
    std::shared_ptr<const Formula>
    add(const std::string   &section,
        const std::string   &key,
        const std::string   &text,
        const FormulaBounds &bounds = {});

    /** @brief Call after values have been computed. Collective.
     * @throws InputError on all ranks if one of them was not admitted on any rank; names
     * formula, entry, point and time. */
    void
    check(MPI_Comm communicator) const;

  private:
    std::vector<std::shared_ptr<const Formula>> all;
  };

  /** @brief Evaluate a formula that depends on nothing but the time at the ends of all
   * steps, before the run starts; formulas that depend on the point are skipped.
   * @param section, key, text As of Formula; an empty text is skipped.
   * @param times The ends of the steps; time 0 is tried as well.
   * @param bounds As of Formula.
   * @throws InputError if a value is not admitted. */
  void
  check_at_all_steps(const std::string         &section,
                     const std::string         &key,
                     const std::string         &text,
                     const std::vector<double> &times,
                     const FormulaBounds       &bounds = {});
} // namespace Touchstone

#endif
