// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_shared_lines_h
#define touchstone_algebra_shared_lines_h

#include <touchstone/base/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/affine_constraints.h>

#include <mpi.h>
#include <vector>

// Constraint lines of which each rank has those of its own dofs and needs some of others.
namespace Touchstone
{
  /** @brief @p known and @p more dofs. IndexSet takes single ones one by one into a sorted
   * list, which takes the square of their number. */
  dealii::IndexSet
  add_indices(const dealii::IndexSet &known, std::vector<Index> more);

  /**
   * @brief Constraints, not closed, of the lines of the @p needed dofs, of all dofs that these
   * lines refer to, of all that the latter refer to, and so on; owners send those that others
   * need.
   *
   * deal.II's make_consistent_in_parallel() looks for each line among all that there are, which
   * takes the square of their number, and takes the set of dofs for complete. Collective.
   *
   * @param own_lines Lines of @p owned dofs.
   * @param needed    Contains @p owned.
   */
  dealii::AffineConstraints<double>
  gather_lines(std::vector<dealii::AffineConstraints<double>::ConstraintLine> own_lines,
               const dealii::IndexSet                                        &owned,
               const dealii::IndexSet                                        &needed,
               MPI_Comm                                                       communicator);
} // namespace Touchstone

#endif
