#include <touchstone/algebra/condensation.h>
#include <touchstone/algebra/condensed_system.h>

#include <algorithm>

namespace Touchstone
{
  namespace
  {
    /** A matrix together with the entries of its special rows. */
    struct MatrixWithStorage
    {
      std::vector<int>                  columns;
      std::vector<double>               values;
      std::unique_ptr<Epetra_CrsMatrix> matrix;
    };
  } // namespace



  CondensedSystem::CondensedSystem(const LinearSystem &system)
    : symmetric(system.symmetric)
    , definite(system.definite)
    , tolerance(system.tolerance)
  {
    const Epetra_CrsMatrix &stiffness = system.stiffness->trilinos_matrix();
    const Epetra_Map       &old_rows  = stiffness.RowMap();
    std::vector<int>        numbers(old_rows.MyGlobalElements(),
                             old_rows.MyGlobalElements() + old_rows.NumMyElements());
    for (Index k = 0; k < system.n_extra; ++k)
      numbers.push_back(static_cast<int>(system.first_extra + k));
    const int        n_rows = static_cast<int>(numbers.size());
    const Epetra_Map row_map(-1, n_rows, numbers.data(), 0, stiffness.Comm());

    LocalNumbers columns(stiffness.ColMap());
    Condensation condensation(system, row_map, columns);
    constrained = std::move(condensation.constrained);
    changed.resize(n_rows);
    for (int i = 0; i < old_rows.NumMyElements(); ++i)
      changed[i] = !constrained[i] && system.basis_change.is_constrained(old_rows.GID(i));

    const auto       storage = std::make_shared<MatrixWithStorage>();
    std::size_t      size    = 0;
    std::vector<int> lengths(n_rows);
    for (int i = 0; i < n_rows; ++i)
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
    for (int i = 0; i < n_rows; ++i)
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
    storage->matrix->FillComplete(row_map, row_map, copied);
    if (copied)
      {
        storage->columns = {};
        storage->values  = {};
      }
    matrix = std::shared_ptr<Epetra_CrsMatrix>(storage, storage->matrix.get());
    rhs    = std::make_unique<Epetra_Vector>(Copy, row_map, condensation.values.data());
    scale_changed(stiffness);
  }



  void
  CondensedSystem::scale_changed(const Epetra_CrsMatrix &stiffness)
  {
    int any = 0, here = std::count(changed.begin(), changed.end(), 1) > 0;
    matrix->Comm().MaxAll(&here, &any, 1);
    if (any == 0)
      return;
    Epetra_Vector present(rhs->Map()), own(stiffness.RowMap());
    matrix->ExtractDiagonalCopy(present);
    stiffness.ExtractDiagonalCopy(own);
    scale = std::make_unique<Epetra_Vector>(rhs->Map());
    scale->PutScalar(1.);
    for (int i = 0; i < own.MyLength(); ++i)
      if (changed[i] && present[i] > own[i])
        (*scale)[i] = own[i] / present[i];
    // Rows that refer to the stiffness have no entry in these columns.
    matrix->LeftScale(*scale);
    matrix->RightScale(*scale);
    for (int i = 0; i < own.MyLength(); ++i)
      (*rhs)[i] *= (*scale)[i];
  }
} // namespace Touchstone
