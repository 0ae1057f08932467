// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/applied_operator.h>

#include <algorithm>

namespace Touchstone
{
  using namespace dealii;

  AppliedOperator::AppliedOperator(const CondensationInput &input)
    : SquareOperator(input.dofs, "stiffness beside contact")
    , input(input)
    , diagonal(map)
    , all(map)
    , force(map)
    , part(map)
  {
    int any = 0, here = !input.system.terms.empty();
    map.Comm().MaxAll(&here, &any, 1);
    if (any != 0)
      {
        left        = forms(&RankOneTerm::left);
        right       = forms(&RankOneTerm::right);
        elongations = std::make_unique<Epetra_Vector>(right->RangeMap());
      }
    for (unsigned int i = 0; i < dim * input.system.stiffness->n_nodes(); ++i)
      if (input.constrained[i])
        {
          const double own = input.system.stiffness->diagonal(i);
          diagonal[i]      = own != 0. ? own : 1.;
        }
  }



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
    // Multipliers come last and have no stiffness.
    const int n = static_cast<int>(dim * input.system.stiffness->n_nodes());
    input.system.stiffness->multiply(result.Values(), x.Values());
    std::fill(result.Values() + n, result.Values() + result.MyLength(), 0.);
    if (input.system.diagonal_shift.size() > 0)
      {
        const double *shift = input.system.diagonal_shift.begin();
        for (int i = 0; i < n; ++i)
          result[i] += shift[i] * x[i];
      }
    if (right)
      {
        right->Multiply(false, x, *elongations);
        left->Multiply(true, *elongations, part);
        result.Update(1., part, 1.);
      }
  }



  std::unique_ptr<Epetra_Vector>
  AppliedOperator::right_hand_side() const
  {
    auto result = std::make_unique<Epetra_Vector>(map);
    multiply(input.trial.inhomogeneity(), force);
    force.Scale(-1.);
    const int n = static_cast<int>(dim * input.system.stiffness->n_nodes());
    for (int i = 0; i < n; ++i)
      force[i] += input.system.rhs.begin()[i];
    for (Index k = 0; k < input.system.n_extra; ++k)
      force[n + k] += input.system.extra_rhs[k];
    input.test.apply_transposed(force, *result);
    return result;
  }



  int
  AppliedOperator::Apply(const Epetra_MultiVector &x, Epetra_MultiVector &result) const
  {
    for (int v = 0; v < x.NumVectors(); ++v)
      {
        input.trial.apply(*x(v), all);
        multiply(all, force);
        input.test.apply_transposed(force, *result(v));
        result(v)->Multiply(1., diagonal, *x(v), 1.);
      }
    return 0;
  }
} // namespace Touchstone
