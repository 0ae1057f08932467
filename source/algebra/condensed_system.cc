// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/applied_operator.h>
#include <touchstone/algebra/condensed_system.h>

#include <algorithm>
#include <map>

// From a LinearSystem, the parts of a Newton iteration, to what linear solvers see: the
// transformations T and S of trial and test functions, the scaling of elongation dofs, and the
// operator, applied factor by factor or assembled (doc/theory.md, section 7). A solver returns y;
// expand() makes the displacement increment x = T y + g of it.
namespace Touchstone
{
  namespace
  {
    /** Displacements, then multipliers, of this rank. */
    Epetra_Map
    all_dofs(const LinearSystem &system)
    {
      const Epetra_Map &rows = system.stiffness->rows();
      // Copies share their numbers.
      int any = 0, here = system.n_extra > 0;
      rows.Comm().MaxAll(&here, &any, 1);
      if (any == 0)
        return rows;
      std::vector<int> numbers(rows.MyGlobalElements(),
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
    // S differs from T where the force of a condition is not along its own coefficients:
    // friction, and the change of normals with consistent linearisation (doc/theory.md 6.3,
    // equation (22)). In a symmetric system both are one object.
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



  // Multipliers, behind the displacements, are not transformed and are left out here.
  void
  CondensedSystem::expand(const Epetra_Vector &solution, Vector &displacement) const
  {
    Epetra_Vector all(dofs);
    trial->expand(solution, all);
    std::copy(all.Values(), all.Values() + displacement.locally_owned_size(), displacement.begin());
  }



  // In the units s the diagonal of such a row is s^2 A_pp = s K_pp. Those that have the scale one
  // count in full already.
  void
  CondensedSystem::correct_elongations(const Epetra_Vector &rest, Epetra_Vector &solution) const
  {
    if (!units)
      return;
    for (unsigned int i = 0; i < dim * system.stiffness->n_nodes(); ++i)
      if (changed[i] && (*units)[i] < 1.)
        solution[i] += rest[i] / ((*units)[i] * system.stiffness->diagonal(i));
  }



  // The scales s = K_pp / A_pp of elongation dofs (doc/theory.md, section 7, equation (23)).
  // A_pp, the diagonal of the condensed matrix, is the stiffness of the continuum and that of the
  // springs. Without the scale a stiff spring (penalty) dominates the residual norm by which a
  // Krylov solver stops, and the displacements would be left inaccurate.
  void
  CondensedSystem::make_units()
  {
    int any = 0, here = std::count(changed.begin(), changed.end(), 1) > 0;
    dofs.Comm().MaxAll(&here, &any, 1);
    if (any == 0)
      return;
    // A_pp need not be exact, since any positive scale has the same solution: what constraints
    // add to this entry of the diagonal is left out.
    //
    // The part of the springs on the diagonal: of each term l r^T the products l_i r_i of changed
    // dofs. Coefficients of equal dofs add up first, as a form may name a dof several times.
    // Terms of a rank can refer to dofs of others, hence the distributed sum.
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
          // Between 0 and 1; springs with negative diagonals (unsymmetric ones) keep the scale
          // one.
          const double own = system.stiffness->diagonal(i);
          (*units)[i]      = own / (own + spring);
        }
  }
} // namespace Touchstone
