// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/applied_operator.h>

#include <algorithm>

// Products with the condensed matrix S^T (A + D + C) T, and its right-hand side S^T (b - A g),
// without assembling it (doc/theory.md, section 7, 'applied'). A Krylov solver calls Apply() once
// per iteration. A change of the active set alters T, S and C, which are small, and leaves the
// large stiffness A alone; only where a preconditioner is set up are the rows assembled
// (assembled_operator.cc).
namespace Touchstone
{
  using namespace dealii;

  AppliedOperator::AppliedOperator(const CondensationInput &input)
    : SquareOperator(input.dofs, "stiffness beside contact")
    , input(input)
  {
    // Matrices of Epetra are made collectively: if any rank has contact terms, all ranks make
    // them, also those that have no row of their own.
    int any = 0, here = !input.system.terms.empty();
    map.Comm().MaxAll(&here, &any, 1);
    if (any != 0)
      {
        left        = forms(&RankOneTerm::left);
        right       = forms(&RankOneTerm::right);
        elongations = std::make_unique<Epetra_Vector>(right->RangeMap());
        part        = std::make_unique<Epetra_Vector>(map);
      }
    // The row and column of a constrained dof in S^T A T are zero. Its own diagonal entry makes
    // the matrix invertible; as it is of the size of the other stiffnesses (force per length), it
    // leaves the condition number alone. The right-hand side is zero there, so the value has no
    // effect.
    for (unsigned int i = 0; i < dim * input.system.stiffness->n_nodes(); ++i)
      if (input.constrained[i])
        {
          const double own = input.system.stiffness->diagonal(i);
          diagonal.emplace_back(i, own != 0. ? own : 1.);
        }
  }



  // A contact term l r^T is kept as two sparse rows. A spring between a node and a surface of m
  // nodes has (3 (1 + m))^2 entries as a block, but 6 (1 + m) as two rows. Columns may be dofs of
  // other ranks, for LocalIndices extends the own ones.
  std::unique_ptr<Epetra_CrsMatrix>
  AppliedOperator::forms(LinearForm RankOneTerm::*side) const
  {
    LocalIndices           indices(map);
    std::vector<SparseRow> rows(input.system.terms.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (const auto &[dof, value] : input.system.terms[k].*side)
        rows[k].emplace_back(indices.local(dof), value);
    return make_matrix(rows, indices, map);
  }



  void
  AppliedOperator::multiply(const Epetra_Vector &x, Epetra_Vector &result) const
  {
    // Multipliers come last and have no stiffness; they enter through the terms only.
    const int n = static_cast<int>(dim * input.system.stiffness->n_nodes());
    input.system.stiffness->multiply(result.Values(), x.Values());
    std::fill(result.Values() + n, result.Values() + result.MyLength(), 0.);
    if (input.system.diagonal_shift.size() > 0)
      {
        const double *shift = input.system.diagonal_shift.begin();
        for (int i = 0; i < n; ++i)
          result[i] += shift[i] * x[i];
      }
    // (C x) = L^T (R x): R gives the elongations, whose number is that of this rank's terms, and
    // the transposed L sends the forces to all dofs, those of other ranks included.
    if (right)
      {
        right->Multiply(false, x, *elongations);
        left->Multiply(true, *elongations, *part);
        result.Update(1., *part, 1.);
      }
  }



  // S^T (b - A g): the inhomogeneity g prescribes displacements of constrained dofs, and the
  // forces that these cause have to be on the right-hand side before S^T condenses it.
  std::unique_ptr<Epetra_Vector>
  AppliedOperator::right_hand_side() const
  {
    auto           result  = std::make_unique<Epetra_Vector>(map);
    Epetra_Vector &balance = *result;
    multiply(input.trial.inhomogeneity(), balance);
    balance.Scale(-1.);
    const int n = static_cast<int>(dim * input.system.stiffness->n_nodes());
    for (int i = 0; i < n; ++i)
      balance[i] += input.system.rhs.begin()[i];
    for (Index k = 0; k < input.system.n_extra; ++k)
      balance[n + k] += input.system.extra_rhs[k];
    Epetra_Vector work(map);
    input.test.apply_transposed(balance, work);
    return result;
  }



  // S^T (A + D + C) (T x) factor by factor, from right to left; the last line adds the diagonal
  // entries of constrained dofs, whose rows of S^T ... T are zero.
  int
  AppliedOperator::Apply(const Epetra_MultiVector &x, Epetra_MultiVector &result) const
  {
    if (!all)
      all = std::make_unique<Epetra_Vector>(map);
    for (int v = 0; v < x.NumVectors(); ++v)
      {
        input.trial.apply(*x(v), *all);
        multiply(*all, *result(v));
        input.test.apply_transposed(*result(v), *all);
        for (const auto &[i, entry] : diagonal)
          result[v][i] += entry * x[v][i];
      }
    return 0;
  }
} // namespace Touchstone
