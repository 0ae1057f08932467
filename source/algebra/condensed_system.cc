// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/applied_operator.h>
#include <touchstone/algebra/condensed_system.h>

#include <algorithm>
#include <map>

namespace Touchstone
{
  namespace
  {
    /** Displacements, then multipliers, of this rank. */
    Epetra_Map
    all_dofs(const LinearSystem &system)
    {
      const Epetra_Map &rows = system.stiffness->rows();
      std::vector<int>  numbers(rows.MyGlobalElements(),
                               rows.MyGlobalElements() + rows.NumMyElements());
      for (Index k = 0; k < system.n_extra; ++k)
        numbers.push_back(static_cast<int>(system.first_extra + k));
      return Epetra_Map(-1, static_cast<int>(numbers.size()), numbers.data(), 0, rows.Comm());
    }
  } // namespace



  CondensedSystem::CondensedSystem(const LinearSystem &system, const bool applied)
    : symmetric(system.symmetric)
    , definite(system.definite)
    , tolerance(system.tolerance)
    , system(system)
    , dofs(all_dofs(system))
  {
    constrained.resize(dofs.NumMyElements());
    changed.resize(dofs.NumMyElements());
    for (unsigned int i = 0; i < dim * system.stiffness->n_nodes(); ++i)
      {
        constrained[i] = system.constraints.is_constrained(dofs.GID(i));
        changed[i]     = !constrained[i] && system.basis_change.is_constrained(dofs.GID(i));
      }
    make_units();
    trial = std::make_unique<Transformation>(
      system.constraints, system.basis_change, dofs, system.rhs.size(), units.get());
    if (system.test_constraints || system.test_basis_change)
      test = std::make_unique<Transformation>(system.test_constraints ? *system.test_constraints
                                                                      : system.constraints,
                                              system.test_basis_change ? *system.test_basis_change
                                                                       : system.basis_change,
                                              dofs,
                                              system.rhs.size(),
                                              units.get());
    const CondensationInput input{
      system, dofs, *trial, test ? *test : *trial, units.get(), constrained};
    if (applied)
      condensed = std::make_unique<AppliedOperator>(input);
    else
      condensed = std::make_unique<AssembledOperator>(input);
    rhs = condensed->right_hand_side();
  }



  void
  CondensedSystem::expand(const Epetra_Vector &solution, Vector &displacement) const
  {
    Epetra_Vector all(dofs);
    trial->expand(solution, all);
    std::copy(all.Values(), all.Values() + displacement.locally_owned_size(), displacement.begin());
  }



  void
  CondensedSystem::make_units()
  {
    int any = 0, here = std::count(changed.begin(), changed.end(), 1) > 0;
    dofs.Comm().MaxAll(&here, &any, 1);
    if (any == 0)
      return;
    // Any number would do: what constraints add to the entry of the diagonal is
    // left out.
    Vector springs(system.rhs.locally_owned_elements(), system.rhs.get_mpi_communicator());
    std::map<Index, double> sums;
    std::map<Index, double> left, right;
    for (const RankOneTerm &term : system.terms)
      {
        left.clear();
        right.clear();
        for (const auto &[row, value] : term.left)
          if (system.basis_change.is_constrained(row))
            left[row] += value;
        if (left.empty())
          continue;
        for (const auto &[column, value] : term.right)
          if (left.count(column) > 0)
            right[column] += value;
        for (const auto &[i, value] : right)
          sums[i] += left[i] * value;
      }
    for (const auto &[i, value] : sums)
      springs(i) += value;
    springs.compress(dealii::VectorOperation::add);
    if (system.diagonal_shift.size() > 0)
      springs += system.diagonal_shift;

    units = std::make_unique<Epetra_Vector>(dofs);
    units->PutScalar(1.);
    for (unsigned int i = 0; i < dim * system.stiffness->n_nodes(); ++i)
      if (const double spring = springs.begin()[i]; changed[i] && spring > 0.)
        {
          const double own = system.stiffness->diagonal(i);
          (*units)[i]      = own / (own + spring);
        }
  }
} // namespace Touchstone
