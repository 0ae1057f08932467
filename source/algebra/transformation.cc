// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/transformation.h>

#include <algorithm>

// The substitution x = T y + g with T = C B D (doc/theory.md, section 7) in two forms: row by row
// for Condensation, which assembles, and as a small distributed matrix of the rows that are not
// those of the identity, for AppliedOperator and the expansion of solutions.
namespace Touchstone
{
  using namespace dealii;

  // Column indices are given beforehand and are local, so Epetra neither searches nor
  // communicates until FillComplete(), which plans the exchange of ghosts.
  std::unique_ptr<Epetra_CrsMatrix>
  make_matrix(const std::vector<SparseRow> &rows,
              const LocalIndices           &indices,
              const Epetra_Map             &domain)
  {
    std::vector<int> lengths;
    for (const SparseRow &row : rows)
      lengths.push_back(static_cast<int>(row.size()));
    // Rows get consecutive numbers on each rank, which only products with vectors use.
    const Epetra_Map range(-1, static_cast<int>(rows.size()), 0, domain.Comm());
    const Epetra_Map columns(
      -1, static_cast<int>(indices.global().size()), indices.global().data(), 0, domain.Comm());
    auto result = std::make_unique<Epetra_CrsMatrix>(Copy, range, columns, lengths.data(), true);
    std::vector<int>    of_row;
    std::vector<double> values;
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        of_row.clear();
        values.clear();
        for (const auto &[index, value] : rows[k])
          {
            of_row.push_back(index);
            values.push_back(value);
          }
        result->InsertMyValues(k, values.size(), values.data(), of_row.data());
      }
    result->FillComplete(domain, range);
    return result;
  }



  Transformation::Transformation(const AffineConstraints<double> &constraints,
                                 const AffineConstraints<double> &basis_change,
                                 const Epetra_Map                &dofs,
                                 const Index                      n_displacements,
                                 const Epetra_Vector             *units)
    : constraints(constraints)
    , basis_change(basis_change)
    , dofs(dofs)
    , n_displacements(n_displacements)
    , units(units)
  {
  }



  void
  Transformation::append(const Index dof, const double factor, LinearForm &entries) const
  {
    // A dof of changed basis is x_i = y_i + sum_j c_j x_j: its own new dof, the elongation, and
    // what a rigid spring would prescribe.
    if (basis_change.is_constrained(dof))
      for (const auto &[other, coefficient] : *basis_change.get_constraint_entries(dof))
        entries.emplace_back(other, factor * coefficient);
    entries.emplace_back(dof, factor);
  }



  // C B of one dof: the line of the constraint, in which dofs of changed basis are replaced.
  // Constraint lines come without chains, so one level is enough; multipliers are never
  // transformed.
  std::optional<Transformation::Row>
  Transformation::row(const Index dof) const
  {
    if (dof >= n_displacements)
      return std::nullopt;
    Row result;
    if (constraints.is_constrained(dof))
      {
        for (const auto &[other, factor] : *constraints.get_constraint_entries(dof))
          append(other, factor, result.entries);
        result.inhomogeneity = constraints.get_inhomogeneity(dof);
      }
    else if (basis_change.is_constrained(dof))
      append(dof, 1., result.entries);
    else
      return std::nullopt;
    return result;
  }



  // Collective where it is made: all ranks reach it in the same product.
  const Transformation::OwnRows &
  Transformation::own_rows() const
  {
    if (made)
      return *made;
    auto result = std::make_unique<OwnRows>();
    // Columns are the own dofs first, then those of other ranks that the lines refer to.
    LocalIndices           indices(dofs);
    std::vector<SparseRow> rows;
    for (int i = 0; i < dofs.NumMyElements(); ++i)
      if (const auto of_dof = row(dofs.GID(i)))
        {
          result->rows.push_back(i);
          rows.emplace_back();
          for (const auto &[other, factor] : of_dof->entries)
            rows.back().emplace_back(indices.local(other), factor);
          result->inhomogeneities.push_back(of_dof->inhomogeneity);
        }
    result->entries = make_matrix(rows, indices, dofs);
    result->values  = std::make_unique<Epetra_Vector>(result->entries->RangeMap());
    // D scales columns: the substitution of elongations is x = .. + s w (equation (23)).
    if (units)
      result->entries->RightScale(*units);
    made = std::move(result);
    return *made;
  }



  Epetra_Vector
  Transformation::inhomogeneity() const
  {
    const OwnRows &t = own_rows();
    Epetra_Vector  result(dofs);
    for (std::size_t k = 0; k < t.rows.size(); ++k)
      result[t.rows[k]] = t.inhomogeneities[k];
    return result;
  }



  // All rows are copied as those of the identity, then the others are overwritten. The identity
  // needs no D, for dofs with units other than one have rows of their own.
  void
  Transformation::apply(const Epetra_Vector &y, Epetra_Vector &result) const
  {
    const OwnRows &t = own_rows();
    t.entries->Multiply(false, y, *t.values);
    std::copy(y.Values(), y.Values() + y.MyLength(), result.Values());
    for (std::size_t k = 0; k < t.rows.size(); ++k)
      result[t.rows[k]] = (*t.values)[k];
  }



  // Scatter: entries of rows that are not those of the identity go to the dofs that these refer
  // to; what is left goes to its own dof. Contributions to dofs of other ranks are added there.
  void
  Transformation::apply_transposed(Epetra_Vector &x, Epetra_Vector &work) const
  {
    const OwnRows &t = own_rows();
    for (std::size_t k = 0; k < t.rows.size(); ++k)
      {
        (*t.values)[k] = x[t.rows[k]];
        x[t.rows[k]]   = 0.;
      }
    t.entries->Multiply(true, *t.values, work);
    x.Update(1., work, 1.);
  }



  void
  Transformation::expand(const Epetra_Vector &y, Epetra_Vector &result) const
  {
    apply(y, result);
    const OwnRows &t = own_rows();
    for (std::size_t k = 0; k < t.rows.size(); ++k)
      result[t.rows[k]] += t.inhomogeneities[k];
  }
} // namespace Touchstone
