// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_preconditioner_h
#define touchstone_algebra_preconditioner_h

#include <touchstone/algebra/condensed_system.h>
#include <touchstone/base/registry.h>

#include <Epetra_MultiVector.h>
#include <Epetra_Operator.h>
#include <memory>
#include <vector>

namespace Touchstone
{
  /** @brief The rigid motions of the bodies over the displacements, for multigrid. */
  struct RigidMotions
  {
    /** Three translations and three rotations, over the rows of the stiffness. Bodies
     * share the columns: one restricted to a body is a motion of that body. */
    Epetra_MultiVector columns;
    /** Body of each row of this rank. */
    std::vector<unsigned int> body;
  };

  /** @brief Displacements with little or no energy, which coarse levels of multigrid must be
   * able to represent: the rigid motions, zero at constrained dofs and at those that count the
   * elongation of a spring. */
  Epetra_MultiVector
  near_null_space(const CondensedSystem &system, const RigidMotions &motions);

  /**
   * @brief Makes preconditioners of the Krylov solvers; registered under the name that the key
   * `Preconditioner` of the section `Linear solver` takes.
   *
   * One class in one file: set_up() reads what it needs of the matrix, as rows of 3 x 3 blocks
   * (CondensedSystem::block_rows()) or as a whole (CondensedSystem::matrix()).
   */
  class Preconditioner
  {
  public:
    virtual ~Preconditioner() = default;

    /**
     * @brief A linear operator whose ApplyInverse() is close to the inverse of the system's
     * matrix, and which stays valid when @p system is gone: it serves until the active set
     * changes. Collective.
     * @throws LinearSolverFailure on all ranks if the matrix admits none.
     */
    virtual std::unique_ptr<Epetra_Operator>
    set_up(const CondensedSystem &system, const RigidMotions &motions) const = 0;

    /** @brief Whether the number of iterations hardly depends on the mesh, so that many of them
     * show that something is wrong and factors are the better preconditioner. */
    virtual bool
    multilevel() const
    {
      return true;
    }
  };

  using PreconditionerRegistry = Registry<Preconditioner>;
} // namespace Touchstone

#endif
