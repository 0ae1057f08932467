#include <touchstone/algebra/applied_operator.h>

#include <algorithm>

namespace Touchstone
{
  using namespace dealii;

  AppliedOperator::AppliedOperator(const LinearSystem      &system,
                                   const Epetra_Map        &rows,
                                   const std::vector<char> &constrained,
                                   const Epetra_Vector     *scale)
    : SquareOperator(rows, "stiffness beside contact")
    , system(system)
    , inhomogeneity(map)
    , diagonal(map)
    , all(map)
    , force(map)
    , part(map)
  {
    motion = std::make_unique<Factor>(
      *this, system.constraints, system.basis_change, scale, &inhomogeneity);
    if (system.test_constraints || system.test_basis_change)
      test = std::make_unique<Factor>(
        *this,
        system.test_constraints ? *system.test_constraints : system.constraints,
        system.test_basis_change ? *system.test_basis_change : system.basis_change,
        scale,
        nullptr);
    int any = 0, here = !system.terms.empty();
    map.Comm().MaxAll(&here, &any, 1);
    if (any != 0)
      {
        left    = forms(&RankOneTerm::left);
        right   = forms(&RankOneTerm::right);
        stretch = std::make_unique<Epetra_Vector>(right->RangeMap());
      }
    for (unsigned int i = 0; i < dim * system.stiffness->n_nodes(); ++i)
      if (constrained[i])
        {
          const double own = system.stiffness->diagonal(i);
          diagonal[i]      = own != 0. ? own : 1.;
        }
  }



  AppliedOperator::Factor::Factor(const AppliedOperator           &owner,
                                  const AffineConstraints<double> &constraints,
                                  const AffineConstraints<double> &basis_change,
                                  const Epetra_Vector             *scale,
                                  Epetra_Vector                   *shift)
  {
    LocalNumbers numbers(owner.map);
    Expansion expansion(constraints, basis_change, owner.system.rhs.size(), numbers);
    std::vector<SparseRow> rows;
    for (int i = 0; i < owner.map.NumMyElements(); ++i)
      if (const Expansion::Line *line = expansion.line(i))
        {
          unknowns.push_back(i);
          rows.push_back(line->entries);
          if (shift)
            (*shift)[i] = line->shift;
        }
    lines    = owner.make_matrix(rows, numbers);
    of_lines = std::make_unique<Epetra_Vector>(lines->RangeMap());
    // Only of unknowns that have a line here: of the others it is one.
    if (scale)
      lines->RightScale(*scale);
  }



  void
  AppliedOperator::Factor::apply(const Epetra_Vector &x, Epetra_Vector &result) const
  {
    lines->Multiply(false, x, *of_lines);
    std::copy(x.Values(), x.Values() + x.MyLength(), result.Values());
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      result[unknowns[k]] = (*of_lines)[k];
  }



  void
  AppliedOperator::Factor::apply_transposed(Epetra_Vector &x, Epetra_Vector &result) const
  {
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      {
        (*of_lines)[k] = x[unknowns[k]];
        x[unknowns[k]] = 0.;
      }
    lines->Multiply(true, *of_lines, result);
    result.Update(1., x, 1.);
  }



  std::unique_ptr<Epetra_CrsMatrix>
  AppliedOperator::forms(LinearForm RankOneTerm::*side) const
  {
    LocalNumbers           numbers(map);
    std::vector<SparseRow> rows(system.terms.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (const auto &[unknown, value] : system.terms[k].*side)
        rows[k].emplace_back(numbers.local(unknown), value);
    return make_matrix(rows, numbers);
  }



  std::unique_ptr<Epetra_CrsMatrix>
  AppliedOperator::make_matrix(const std::vector<SparseRow> &rows,
                               const LocalNumbers           &numbers) const
  {
    std::vector<int> lengths;
    for (const SparseRow &row : rows)
      lengths.push_back(static_cast<int>(row.size()));
    const Epetra_Map row_map(-1, static_cast<int>(rows.size()), 0, map.Comm());
    const Epetra_Map columns(
      -1, static_cast<int>(numbers.global().size()), numbers.global().data(), 0, map.Comm());
    auto result = std::make_unique<Epetra_CrsMatrix>(Copy, row_map, columns, lengths.data(), true);
    std::vector<int>    places;
    std::vector<double> values;
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        places.clear();
        values.clear();
        for (const auto &[place, value] : rows[k])
          {
            places.push_back(place);
            values.push_back(value);
          }
        result->InsertMyValues(k, values.size(), values.data(), places.data());
      }
    result->FillComplete(map, row_map);
    return result;
  }



  void
  AppliedOperator::multiply(const Epetra_Vector &x, Epetra_Vector &result) const
  {
    // Extra unknowns come last and have no stiffness.
    const int n = static_cast<int>(dim * system.stiffness->n_nodes());
    system.stiffness->multiply(result.Values(), x.Values());
    std::fill(result.Values() + n, result.Values() + result.MyLength(), 0.);
    if (system.diagonal_shift.size() > 0)
      {
        const double *shift = system.diagonal_shift.begin();
        for (int i = 0; i < n; ++i)
          result[i] += shift[i] * x[i];
      }
    if (right)
      {
        right->Multiply(false, x, *stretch);
        left->Multiply(true, *stretch, part);
        result.Update(1., part, 1.);
      }
  }



  std::unique_ptr<Epetra_Vector>
  AppliedOperator::right_hand_side() const
  {
    auto result = std::make_unique<Epetra_Vector>(map);
    multiply(inhomogeneity, force);
    force.Scale(-1.);
    const int n = static_cast<int>(dim * system.stiffness->n_nodes());
    for (int i = 0; i < n; ++i)
      force[i] += system.rhs.begin()[i];
    for (Index k = 0; k < system.n_extra; ++k)
      force[n + k] += system.extra_rhs[k];
    (test ? *test : *motion).apply_transposed(force, *result);
    return result;
  }



  void
  AppliedOperator::expand(const Epetra_Vector &y, Epetra_Vector &result) const
  {
    motion->apply(y, result);
    result.Update(1., inhomogeneity, 1.);
  }



  int
  AppliedOperator::Apply(const Epetra_MultiVector &x, Epetra_MultiVector &result) const
  {
    for (int v = 0; v < x.NumVectors(); ++v)
      {
        motion->apply(*x(v), all);
        multiply(all, force);
        (test ? *test : *motion).apply_transposed(force, *result(v));
        result(v)->Multiply(1., diagonal, *x(v), 1.);
      }
    return 0;
  }
} // namespace Touchstone
