#include <touchstone/algebra/applied_operator.h>
#include <touchstone/algebra/condensation.h>

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
    motion = expansion(system.constraints, scale, &inhomogeneity);
    if (system.test_constraints)
      test = expansion(*system.test_constraints, scale, nullptr);
    int any = 0, here = !system.terms.empty();
    map.Comm().MaxAll(&here, &any, 1);
    if (any != 0)
      {
        left  = forms(&RankOneTerm::left);
        right = forms(&RankOneTerm::right);
      }
    // Of few rows: ExtractDiagonalCopy() would search all.
    const Epetra_CrsMatrix &stiffness = system.stiffness->trilinos_matrix();
    for (int i = 0; i < stiffness.NumMyRows(); ++i)
      if (constrained[i])
        {
          const double own = diagonal_entry(stiffness, i);
          diagonal[i]      = own != 0. ? own : 1.;
        }
  }



  std::unique_ptr<Epetra_CrsMatrix>
  AppliedOperator::expansion(const AffineConstraints<double> &constraints,
                             const Epetra_Vector             *scale,
                             Epetra_Vector                   *shift) const
  {
    LocalNumbers     numbers(map);
    Expansion        lines(constraints, system.basis_change, system.rhs.size(), numbers);
    const int        n = map.NumMyElements();
    std::vector<int> lengths(n, 1);
    for (int i = 0; i < n; ++i)
      if (const Expansion::Line *line = lines.line(i))
        {
          lengths[i] = static_cast<int>(line->entries.size());
          if (shift)
            (*shift)[i] = line->shift;
        }
    const Epetra_Map columns(
      -1, static_cast<int>(numbers.global().size()), numbers.global().data(), 0, map.Comm());
    auto result = std::make_unique<Epetra_CrsMatrix>(Copy, map, columns, lengths.data(), true);
    std::vector<int>    place;
    std::vector<double> value;
    for (int i = 0; i < n; ++i)
      {
        place.assign(1, i);
        value.assign(1, 1.);
        if (const Expansion::Line *line = lines.line(i))
          {
            place.clear();
            value.clear();
            for (const auto &[column, factor] : line->entries)
              {
                place.push_back(column);
                value.push_back(factor);
              }
          }
        result->InsertMyValues(i, place.size(), value.data(), place.data());
      }
    result->FillComplete(map, map);
    if (scale)
      result->RightScale(*scale);
    return result;
  }



  std::unique_ptr<Epetra_CrsMatrix>
  AppliedOperator::forms(LinearForm RankOneTerm::*side) const
  {
    LocalNumbers                  numbers(map);
    std::vector<int>              lengths, place;
    std::vector<double>           value;
    std::vector<std::vector<int>> places;
    for (const RankOneTerm &term : system.terms)
      {
        place.clear();
        for (const auto &entry : term.*side)
          place.push_back(numbers.local(entry.first));
        lengths.push_back(static_cast<int>(place.size()));
        places.push_back(place);
      }
    const Epetra_Map rows(-1, static_cast<int>(lengths.size()), 0, map.Comm());
    const Epetra_Map columns(
      -1, static_cast<int>(numbers.global().size()), numbers.global().data(), 0, map.Comm());
    auto result = std::make_unique<Epetra_CrsMatrix>(Copy, rows, columns, lengths.data(), true);
    for (std::size_t k = 0; k < system.terms.size(); ++k)
      {
        value.clear();
        for (const auto &entry : system.terms[k].*side)
          value.push_back(entry.second);
        result->InsertMyValues(k, value.size(), value.data(), places[k].data());
      }
    result->FillComplete(map, rows);
    return result;
  }



  void
  AppliedOperator::multiply(const Epetra_Vector &x, Epetra_Vector &result) const
  {
    // Extra unknowns come last and have no stiffness.
    const Epetra_CrsMatrix &stiffness = system.stiffness->trilinos_matrix();
    const int               n         = stiffness.NumMyRows();
    const Epetra_Vector     displacement(View, stiffness.DomainMap(), x.Values());
    Epetra_Vector           internal(View, stiffness.RangeMap(), result.Values());
    stiffness.Multiply(false, displacement, internal);
    std::fill(result.Values() + n, result.Values() + result.MyLength(), 0.);
    if (system.diagonal_shift.size() > 0)
      {
        const double *shift = system.diagonal_shift.begin();
        for (int i = 0; i < n; ++i)
          result[i] += shift[i] * x[i];
      }
    if (right)
      {
        Epetra_Vector stretch(right->RangeMap());
        right->Multiply(false, x, stretch);
        left->Multiply(true, stretch, part);
        result.Update(1., part, 1.);
      }
  }



  std::unique_ptr<Epetra_Vector>
  AppliedOperator::right_hand_side() const
  {
    auto result = std::make_unique<Epetra_Vector>(map);
    multiply(inhomogeneity, force);
    force.Scale(-1.);
    const int n = system.stiffness->trilinos_matrix().NumMyRows();
    for (int i = 0; i < n; ++i)
      force[i] += system.rhs.begin()[i];
    for (Index k = 0; k < system.n_extra; ++k)
      force[n + k] += system.extra_rhs[k];
    (test ? *test : *motion).Multiply(true, force, *result);
    return result;
  }



  int
  AppliedOperator::Apply(const Epetra_MultiVector &x, Epetra_MultiVector &result) const
  {
    for (int v = 0; v < x.NumVectors(); ++v)
      {
        motion->Multiply(false, *x(v), all);
        multiply(all, force);
        (test ? *test : *motion).Multiply(true, force, *result(v));
        result(v)->Multiply(1., diagonal, *x(v), 1.);
      }
    return 0;
  }
} // namespace Touchstone
