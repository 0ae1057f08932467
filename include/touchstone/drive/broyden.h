// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_broyden_h
#define touchstone_drive_broyden_h

#include <deal.II/lac/lapack_full_matrix.h>

#include <optional>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Broyden's update (1965, Math. Comp. 19) of the inverse of a matrix of derivatives, such
   * that it takes the change @p dr of the residual to the change @p dx of the unknowns. Only a part
   * of it is made where the new matrix would come near to a singular one: More and Trangenstein
   * (1976, Math. Comp. 30).
   * @param inverse Row by row; the unknowns have one unit, and so have the residuals.
   */
  void
  broyden_update(std::vector<double>       &inverse,
                 const std::vector<double> &dx,
                 const std::vector<double> &dr);

  /**
   * @brief Broyden's method for a few unknowns whose residual costs a solution of all bodies: the
   * caller evaluates the residual at x(), and advance() finds the next one.
   *
   * It goes back to the best state where the residual grows much, and takes finite differences
   * where the updates lead nowhere. Where far away there may be other solutions, which are not
   * meant, it is cautious: the residual may not grow, and changes are larger than at first only
   * where they have paid off. Unknowns are lengths, residuals forces.
   */
  class Broyden
  {
  public:
    using Numbers = std::vector<double>;

    /** Change of each unknown by each residual, row by row: kept from step to step by the caller;
     * zero where nothing is known. */
    Numbers inverse;

    /** @brief Begin with these unknowns. */
    void
    begin(const Numbers &guess);

    const Numbers &
    x() const
    {
      return present;
    }

    /** @brief Number of calls of advance() since begin(). */
    unsigned int
    n_changes() const
    {
      return changes;
    }

    /** @brief Forget what the last residuals were, and go on at @p elsewhere. */
    void
    jump(const Numbers &elsewhere);

    /** @brief Say that the next residual is not that at x(), but at @p elsewhere. */
    void
    move(const Numbers &elsewhere);

    /** @brief Whether x() is there for a finite difference. */
    bool
    in_differences() const
    {
      return !directions.empty();
    }

    /** What an iteration is measured by. */
    struct Sizes
    {
      /** What each unknown is expected to meet, force per length. */
      Numbers stiffness;
      /** Of the forces on obstacles, to which residuals are exact. */
      double force;
      /** No change is larger, length; if it is cautious, at first. */
      double largest_step;
      bool   cautious = false;
    };

    /** @brief Take the residual at x(), and go on to another x().
     * @return a direction in which the residual does not change, if finite differences show one. */
    std::optional<Numbers>
    advance(const Numbers &residual, const Sizes &sizes);

  private:
    Numbers present;
    /** Where the last residual was found, and what it was. */
    Numbers last, last_residual;
    /** The state with the smallest residual. */
    Numbers best, best_residual;
    /** No change is larger, length. */
    double       longest  = 0.;
    bool         cautious = false;
    unsigned int changes  = 0;
    /** Finite differences: along all unknowns, and then along those directions that look soft; what
     * has been found so far; the present step, and the stiffness below which there is none. */
    std::vector<Numbers> directions, columns;
    double               width = 0., floor = 0.;
    unsigned int         n_differences = 0;

    void
    learn(const Numbers &residual, const Sizes &sizes);
    /** A step from the best state that is no longer than @p allowed. */
    void
    step_from_best(double allowed);
    void
    take_difference(const Sizes &sizes);
    dealii::LAPACKFullMatrix<double>
    derivatives() const;
    void
    doubt_soft_directions(const Sizes &sizes);
    std::optional<Numbers>
    end_differences();
  };
} // namespace Touchstone

#endif
