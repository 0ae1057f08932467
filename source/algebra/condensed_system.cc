#include <touchstone/algebra/applied_operator.h>
#include <touchstone/algebra/condensation.h>
#include <touchstone/algebra/condensed_system.h>

#include <algorithm>
#include <map>

namespace Touchstone
{
  namespace
  {
    /** Displacements, then extra unknowns, of this rank. */
    Epetra_Map
    unknowns(const LinearSystem &system)
    {
      const Epetra_Map &rows = system.stiffness->trilinos_matrix().RowMap();
      std::vector<int>  numbers(rows.MyGlobalElements(),
                               rows.MyGlobalElements() + rows.NumMyElements());
      for (Index k = 0; k < system.n_extra; ++k)
        numbers.push_back(static_cast<int>(system.first_extra + k));
      return Epetra_Map(-1, static_cast<int>(numbers.size()), numbers.data(), 0, rows.Comm());
    }

    /** A matrix together with the entries of its special rows. */
    struct MatrixWithStorage
    {
      std::vector<int>                  columns;
      std::vector<double>               values;
      std::unique_ptr<Epetra_CrsMatrix> matrix;
    };
  } // namespace



  CondensedSystem::CondensedSystem(const LinearSystem &system, const bool applied)
    : symmetric(system.symmetric)
    , definite(system.definite)
    , tolerance(system.tolerance)
    , system(system)
    , row_map(unknowns(system))
  {
    constrained.resize(row_map.NumMyElements());
    changed.resize(row_map.NumMyElements());
    for (int i = 0; i < system.stiffness->trilinos_matrix().NumMyRows(); ++i)
      {
        constrained[i] = system.constraints.is_constrained(row_map.GID(i));
        changed[i]     = !constrained[i] && system.basis_change.is_constrained(row_map.GID(i));
      }
    make_scale();
    if (applied)
      {
        factors = std::make_shared<AppliedOperator>(system, row_map, constrained, scale.get());
        rhs     = factors->right_hand_side();
        return;
      }
    std::vector<double> values;
    assembled = assemble(&values, true);
    rhs       = std::make_unique<Epetra_Vector>(Copy, row_map, values.data());
    if (scale)
      rhs->Multiply(1., *scale, *rhs, 0.);
  }



  Epetra_Operator &
  CondensedSystem::product() const
  {
    return factors ? static_cast<Epetra_Operator &>(*factors) : *assembled;
  }



  void
  CondensedSystem::expand(const Epetra_Vector &solution, Vector &displacement) const
  {
    Epetra_Vector all(solution);
    if (factors)
      {
        Epetra_Vector scaled(solution);
        if (scale)
          scaled.ReciprocalMultiply(1., *scale, solution, 0.);
        factors->expand(scaled, all);
      }
    std::copy(all.Values(), all.Values() + displacement.locally_owned_size(), displacement.begin());
    if (!factors)
      system.expand(displacement);
  }



  std::shared_ptr<Epetra_CrsMatrix>
  CondensedSystem::matrix(const bool complete) const
  {
    return assembled ? assembled : assemble(nullptr, complete);
  }



  std::shared_ptr<Epetra_CrsMatrix>
  CondensedSystem::assemble(std::vector<double> *values, const bool complete) const
  {
    const Epetra_CrsMatrix &stiffness = system.stiffness->trilinos_matrix();
    LocalNumbers            columns(stiffness.ColMap());
    Condensation            condensation(system, row_map, columns);
    if (values)
      values->swap(condensation.values);

    const unsigned int n_rows  = row_map.NumMyElements();
    const auto         storage = std::make_shared<MatrixWithStorage>();
    std::size_t        size    = 0;
    std::vector<int>   lengths(n_rows);
    for (unsigned int i = 0; i < n_rows; ++i)
      {
        const auto found = condensation.rows.find(i);
        lengths[i] =
          found == condensation.rows.end() ? stiffness.NumMyEntries(i) : found->second.size();
        if (found != condensation.rows.end())
          size += found->second.size();
      }
    storage->columns.reserve(size);
    storage->values.reserve(size);

    const Epetra_Map column_map(
      -1, static_cast<int>(columns.global().size()), columns.global().data(), 0, stiffness.Comm());
    const auto access = system.lasting_stiffness ? View : Copy;
    storage->matrix =
      std::make_unique<Epetra_CrsMatrix>(access, row_map, column_map, lengths.data(), true);
    for (unsigned int i = 0; i < n_rows; ++i)
      {
        const auto found = condensation.rows.find(i);
        int        n;
        double    *value;
        int       *column;
        if (found == condensation.rows.end())
          stiffness.ExtractMyRowView(i, n, value, column);
        else
          {
            const std::size_t begin = storage->columns.size();
            for (const auto &entry : found->second)
              {
                storage->columns.push_back(entry.first);
                storage->values.push_back(entry.second);
              }
            n      = static_cast<int>(found->second.size());
            column = storage->columns.data() + begin;
            value  = storage->values.data() + begin;
            SparseRow().swap(found->second);
          }
        const int error = storage->matrix->InsertMyValues(i, n, value, column);
        AssertThrow(error == 0, dealii::ExcMessage("A row does not fit into the matrix."));
      }
    const bool copied = !system.lasting_stiffness;
    if (complete || scale)
      storage->matrix->FillComplete(row_map, row_map, copied);
    if (copied)
      {
        storage->columns = {};
        storage->values  = {};
      }
    // Rows that refer to the stiffness have no entry in the columns that are scaled.
    if (scale)
      {
        storage->matrix->LeftScale(*scale);
        storage->matrix->RightScale(*scale);
      }
    return std::shared_ptr<Epetra_CrsMatrix>(storage, storage->matrix.get());
  }



  void
  CondensedSystem::make_scale()
  {
    int any = 0, here = std::count(changed.begin(), changed.end(), 1) > 0;
    row_map.Comm().MaxAll(&here, &any, 1);
    if (any == 0)
      return;
    // Any number would do: what constraints add to the entry of the diagonal is left out.
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

    const Epetra_CrsMatrix &stiffness = system.stiffness->trilinos_matrix();
    scale                             = std::make_unique<Epetra_Vector>(row_map);
    scale->PutScalar(1.);
    for (int i = 0; i < stiffness.NumMyRows(); ++i)
      if (const double spring = springs.begin()[i]; changed[i] && spring > 0.)
        {
          const double own = diagonal_entry(stiffness, i);
          (*scale)[i]      = own / (own + spring);
        }
  }
} // namespace Touchstone
