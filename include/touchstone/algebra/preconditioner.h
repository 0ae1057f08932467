// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_preconditioner_h
#define touchstone_algebra_preconditioner_h

#include <touchstone/algebra/condensed_system.h>
#include <touchstone/base/registry.h>

#include <Epetra_MultiVector.h>
#include <Epetra_Operator.h>
#include <Epetra_Vector.h>
#include <memory>
#include <vector>

namespace Touchstone
{
  /** @brief The rigid motions of the bodies over the displacements, for multigrid. */
  struct RigidMotions
  {
    /** The coordinate of each row of the stiffness along its own direction, from a centre and
     * over a length that are those of all bodies: a motion restricted to a body is one of that
     * body. The six motions themselves would take six times the memory. */
    Epetra_Vector position;
    /** Body of each row of this rank. */
    std::vector<unsigned int> body;
    /** Translations, then rotations. */
    unsigned int n = 2 * dim;

    /** @brief Displacement of a row of this rank in the motion @p k: e_k, or e_(k-3) x position. */
    double
    operator()(const unsigned int k, const int row) const
    {
      const unsigned int along = row % dim, axis = k % dim;
      if (k < dim)
        return along == axis ? 1. : 0.;
      const int first = row - static_cast<int>(along);
      if (along == (axis + 1) % dim)
        return -position[first + (axis + 2) % dim];
      return along == (axis + 2) % dim ? position[first + (axis + 1) % dim] : 0.;
    }
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
