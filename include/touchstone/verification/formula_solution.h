// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_verification_formula_solution_h
#define touchstone_verification_formula_solution_h

#include <touchstone/base/formula.h>
#include <touchstone/verification/reference_solution.h>

#include <array>
#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief An exact or manufactured solution, given by formulas of the scene: the
   * displacements in the sections of the bodies, the contact pressure in "Reference
   * solution". Compared in the norm of L2, which has a rate of convergence.
   */
  class FormulaSolution : public ReferenceSolution
  {
  public:
    explicit FormulaSolution(const Scene &scene);

    ReferenceComparison
    compare(const ReferenceInput &input) const override;

  private:
    Formulas formulas;
    /** Components of each body; null if they are not compared. */
    std::vector<std::array<std::shared_ptr<const Formula>, dim>> displacement;
    /** Null if it is not compared. */
    std::shared_ptr<const Formula> pressure;
    unsigned int                   pair = 0;
    /** At which the result is compared. */
    double end_time;

    /** @brief Add an error relative to the exact solution, from the integrals of the squares of
     * both on this rank. Collective. */
    void
    add_relative(ReferenceComparison         &result,
                 const std::string           &name,
                 const std::string           &what,
                 const std::array<double, 2> &integrals,
                 MPI_Comm                     communicator) const;

    /** @brief Integrals of the squares of error and exact displacement on this rank,
     * length^5. */
    std::array<double, 2>
    displacement_integrals(const ReferenceInput &input) const;

    /** @brief The same sums over the slave nodes, force^2 per area. */
    std::array<double, 2>
    pressure_integrals(const ReferenceInput &input) const;
  };
} // namespace Touchstone

#endif
