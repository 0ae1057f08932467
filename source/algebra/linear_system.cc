#include <touchstone/algebra/linear_system.h>

#include <deal.II/base/mpi.h>

#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <algorithm>
#include <boost/serialization/utility.hpp>
#include <map>
#include <unordered_map>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A sparse row under construction. */
    using Row = std::vector<std::pair<Index, double>>;

    /** Add up the entries of equal columns. */
    void
    merge(Row &row)
    {
      std::sort(row.begin(), row.end(), [](const auto &a, const auto &b) {
        return a.first < b.first;
      });
      std::size_t last = 0;
      for (std::size_t i = 1; i < row.size(); ++i)
        if (row[i].first == row[last].first)
          row[last].second += row[i].second;
        else
          row[++last] = row[i];
      if (!row.empty())
        row.resize(last + 1);
    }

    /** Raw storage of an Epetra matrix whose storage is optimised. */
    struct RawRows
    {
      int    *begin  = nullptr;
      int    *column = nullptr;
      double *value  = nullptr;

      explicit RawRows(const Epetra_CrsMatrix &matrix)
      {
        const int error = matrix.ExtractCrsDataPointers(begin, column, value);
        AssertThrow(error == 0, ExcMessage("The stiffness matrix is not in compressed storage."));
      }
    };

    /** Collects the parts of the condensed system that differ from the plain
     * stiffness rows, and those that go to other ranks. */
    class Condensation
    {
    public:
      Condensation(const LinearSystem &system)
        : system(system)
        , constraints(system.constraints)
        , test_constraints(system.test_constraints ? *system.test_constraints : system.constraints)
        , owned(system.rhs.locally_owned_elements())
      {
      }

      /** Additions to owned rows, and to right-hand sides. */
      std::unordered_map<Index, Row>                  rows;
      std::unordered_map<Index, double>               values;
      std::map<unsigned int, std::vector<MatrixTerm>> remote;

      bool
      is_constrained(const Index i) const
      {
        return i < system.rhs.size() && constraints.is_constrained(i);
      }

      /** Right-multiply the row by T; returns row . g. */
      double
      expand(const Row &row, Row &expanded) const
      {
        double shift = 0.;
        for (const auto &[column, value] : row)
          if (is_constrained(column))
            {
              for (const auto &entry : *constraints.get_constraint_entries(column))
                expanded.emplace_back(entry.first, value * entry.second);
              shift += value * constraints.get_inhomogeneity(column);
            }
          else
            expanded.emplace_back(column, value);
        return shift;
      }

      /** Add row and value to the row that @p i stands for. */
      void
      scatter(const Index i, const Row &row, const double value)
      {
        if (is_constrained(i))
          for (const auto &entry : *test_constraints.get_constraint_entries(i))
            add(entry.first, entry.second, row, value);
        else
          add(i, 1., row, value);
      }

    private:
      const LinearSystem              &system;
      const AffineConstraints<double> &constraints, &test_constraints;
      const IndexSet                   owned;

      bool
      is_owned(const Index i) const
      {
        return i < system.rhs.size()
                 ? owned.is_element(i)
                 : i >= system.first_extra && i < system.first_extra + system.n_extra;
      }

      void
      add(const Index i, const double factor, const Row &row, const double value)
      {
        if (is_owned(i))
          {
            Row &target = rows[i];
            for (const auto &entry : row)
              target.emplace_back(entry.first, factor * entry.second);
            values[i] += factor * value;
          }
        else
          {
            foreign.emplace_back(i, factor * value);
            for (const auto &entry : row)
              foreign_terms.push_back({i, entry.first, factor * entry.second});
          }
      }

    public:
      std::vector<std::pair<Index, double>> foreign;
      std::vector<MatrixTerm>               foreign_terms;

      /** Send what belongs to other ranks; @p first are the first unknowns of
       * each rank, displacement and extra. */
      void
      exchange(const MPI_Comm communicator, const std::vector<std::pair<Index, Index>> &first)
      {
        const auto owner = [&](const Index i) {
          unsigned int rank  = 0;
          const bool   extra = i >= system.rhs.size();
          for (unsigned int r = 0; r < first.size(); ++r)
            if ((extra ? first[r].second : first[r].first) <= i)
              rank = r;
          return rank;
        };
        using Package = std::pair<std::vector<std::pair<Index, double>>, std::vector<double>>;
        std::map<unsigned int, Package> packages;
        for (const auto &entry : foreign)
          packages[owner(entry.first)].first.push_back(entry);
        for (const MatrixTerm &term : foreign_terms)
          {
            auto &flat = packages[owner(term.row)].second;
            flat.insert(flat.end(),
                        {static_cast<double>(term.row),
                         static_cast<double>(term.column),
                         term.value});
          }
        for (const auto &[rank, package] : Utilities::MPI::some_to_some(communicator, packages))
          {
            for (const auto &[i, value] : package.first)
              values[i] += value;
            for (std::size_t k = 0; k < package.second.size(); k += 3)
              rows[static_cast<Index>(package.second[k])].emplace_back(
                static_cast<Index>(package.second[k + 1]), package.second[k + 2]);
          }
      }
    };
  } // namespace



  CondensedSystem::CondensedSystem(const LinearSystem &system)
    : symmetric(system.symmetric)
    , definite(system.definite)
    , tolerance(system.tolerance)
  {
    const Epetra_CrsMatrix &stiffness = system.stiffness->trilinos_matrix();
    const RawRows           raw(stiffness);
    const Epetra_Map       &row_map      = stiffness.RowMap();
    const Epetra_Map       &col_map      = stiffness.ColMap();
    const int               n_rows       = row_map.NumMyElements();
    const int               n_cols       = col_map.NumMyElements();
    const MPI_Comm          communicator = system.rhs.get_mpi_communicator();

    // Which columns are constrained is asked 27 times for each of them: look it
    // up once.
    std::vector<Index> global_column(n_cols);
    std::vector<char>  column_constrained(n_cols);
    for (int j = 0; j < n_cols; ++j)
      {
        global_column[j]      = col_map.GID(j);
        column_constrained[j] = system.constraints.is_constrained(global_column[j]);
      }

    Condensation condensation(system);
    constrained.assign(n_rows + system.n_extra, 0);
    std::vector<char> replaced(n_rows, 0);
    const double     *shift =
      system.diagonal_shift.size() > 0 ? system.diagonal_shift.begin() : nullptr;
    Row    row, expanded;
    double diagonal = 0.;
    for (int i = 0; i < n_rows; ++i)
      {
        const Index global = row_map.GID(i);
        constrained[i]     = system.constraints.is_constrained(global);
        bool touched       = constrained[i];
        for (int k = raw.begin[i]; k < raw.begin[i + 1] && !touched; ++k)
          touched = column_constrained[raw.column[k]];
        const double extra_diagonal = shift ? shift[i] : 0.;
        if (!touched)
          {
            condensation.values[global] += system.rhs(global);
            if (extra_diagonal != 0.)
              condensation.rows[global].emplace_back(global, extra_diagonal);
            continue;
          }
        row.clear();
        expanded.clear();
        for (int k = raw.begin[i]; k < raw.begin[i + 1]; ++k)
          row.emplace_back(global_column[raw.column[k]], raw.value[k]);
        if (extra_diagonal != 0.)
          row.emplace_back(global, extra_diagonal);
        for (const auto &entry : row)
          if (entry.first == global)
            diagonal = std::max(diagonal, std::abs(entry.second));
        const double product = condensation.expand(row, expanded);
        // Each of its entries goes to all rows that this one stands for.
        merge(expanded);
        replaced[i] = 1;
        condensation.scatter(global, expanded, system.rhs(global) - product);
      }
    for (const MatrixTerm &term : system.terms)
      {
        expanded.clear();
        const double product = condensation.expand({{term.column, term.value}}, expanded);
        condensation.scatter(term.row, expanded, -product);
      }
    for (Index k = 0; k < system.n_extra; ++k)
      condensation.values[system.first_extra + k] += system.extra_rhs[k];

    const Index first_owned =
      n_rows > 0 ? static_cast<Index>(row_map.GID(0)) : static_cast<Index>(system.rhs.size());
    condensation.exchange(
      communicator,
      Utilities::MPI::all_gather(communicator, std::make_pair(first_owned, system.first_extra)));
    diagonal = Utilities::MPI::max(diagonal, communicator);
    if (diagonal == 0.)
      diagonal = 1.;

    // Columns: those of the stiffness keep their local numbers, new ones follow.
    std::vector<int> columns(col_map.MyGlobalElements(), col_map.MyGlobalElements() + n_cols);
    std::unordered_map<Index, int> new_columns;
    const auto                     local_column = [&](const Index j) {
      if (j < system.rhs.size())
        {
          const int local = col_map.LID(static_cast<int>(j));
          if (local >= 0)
            return local;
        }
      const auto [found, inserted] = new_columns.emplace(j, columns.size());
      if (inserted)
        columns.push_back(static_cast<int>(j));
      return found->second;
    };

    const int                        n_all = n_rows + system.n_extra;
    std::vector<std::vector<int>>    special_columns(n_all);
    std::vector<std::vector<double>> special_values(n_all);
    std::vector<int>                 lengths(n_all);
    std::vector<char>                special(n_all, 0);
    for (int i = 0; i < n_all; ++i)
      {
        const Index global =
          i < n_rows ? static_cast<Index>(row_map.GID(i)) : system.first_extra + (i - n_rows);
        const auto found = condensation.rows.find(global);
        special[i]       = (i >= n_rows || replaced[i] || found != condensation.rows.end());
        if (!special[i])
          {
            lengths[i] = raw.begin[i + 1] - raw.begin[i];
            continue;
          }
        row.clear();
        if (found != condensation.rows.end())
          row = found->second;
        if (constrained[i])
          row = {{global, diagonal}};
        else if (i < n_rows && !replaced[i])
          for (int k = raw.begin[i]; k < raw.begin[i + 1]; ++k)
            row.emplace_back(global_column[raw.column[k]], raw.value[k]);
        merge(row);
        for (const auto &[column, value] : row)
          {
            special_columns[i].push_back(local_column(column));
            special_values[i].push_back(value);
          }
        lengths[i] = row.size();
      }

    const Epetra_Comm &comm = stiffness.Comm();
    std::vector<int>   all_rows(row_map.MyGlobalElements(), row_map.MyGlobalElements() + n_rows);
    for (Index k = 0; k < system.n_extra; ++k)
      all_rows.push_back(static_cast<int>(system.first_extra + k));
    const Epetra_Map new_row_map(-1, n_all, all_rows.data(), 0, comm);
    const Epetra_Map new_col_map(-1, static_cast<int>(columns.size()), columns.data(), 0, comm);
    matrix =
      std::make_shared<Epetra_CrsMatrix>(Copy, new_row_map, new_col_map, lengths.data(), true);
    rhs = std::make_unique<Epetra_Vector>(new_row_map);
    for (int i = 0; i < n_all; ++i)
      {
        if (special[i])
          matrix->InsertMyValues(i,
                                 lengths[i],
                                 special_values[i].data(),
                                 special_columns[i].data());
        else
          matrix->InsertMyValues(i,
                                 lengths[i],
                                 raw.value + raw.begin[i],
                                 raw.column + raw.begin[i]);
        const auto found = condensation.values.find(new_row_map.GID(i));
        if (!constrained[i] && found != condensation.values.end())
          (*rhs)[i] = found->second;
      }
    matrix->FillComplete(new_row_map, new_row_map);
    matrix->OptimizeStorage();
  }
} // namespace Touchstone
