// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/condensation.h>
#include <touchstone/base/exchange.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Visit the entries of dof @p i of a node's row: local indices and values.
     */
    template <class Visit>
    void
    for_each_entry(const Matrix::Rows::Row &row, const int i, const Visit &visit)
    {
      for (std::size_t k = 0; k < row.columns.size(); ++k)
        for (unsigned int c = 0; c < dim; ++c)
          visit(static_cast<int>(dim * row.columns[k] + c), row.blocks[k][dim * c + i % dim]);
    }

    /** A row of S^T A T for the rank that owns it: its right-hand side, and how
     * many of the entries that are sent beside it belong to it. */
    struct SentRow
    {
      Index       row;
      double      value;
      std::size_t n_entries;
    };

    struct SentEntry
    {
      Index  column;
      double value;
    };
  } // namespace



  const TransformationRows::Row *
  TransformationRows::row(const int local)
  {
    if (static_cast<std::size_t>(local) >= number.size())
      number.resize(indices.global().size(), not_looked_up);
    if (number[local] == not_looked_up)
      {
        number[local] = identity;
        if (const auto global = transformation.row(indices.global()[local]))
          {
            Row result;
            result.inhomogeneity = global->inhomogeneity;
            for (const auto &[dof, factor] : global->entries)
              result.entries.emplace_back(indices.local(dof), factor);
            number[local] = static_cast<int>(rows.size());
            rows.push_back(std::move(result));
          }
      }
    return number[local] == identity ? nullptr : &rows[number[local]];
  }



  SparseRow
  SparseRowAccumulator::take()
  {
    for (const auto &entry : row)
      position[entry.first] = -1;
    SparseRow result(row);
    row.clear();
    std::sort(result.begin(), result.end());
    return result;
  }



  Condensation::Condensation(const CondensationInput &input, LocalIndices &columns)
    : values(input.dofs.NumMyElements())
    , system(input.system)
    , dofs(input.dofs)
    , row_indices(input.dofs)
    , columns(columns)
    , trial(input.trial, columns)
    , test(input.test, row_indices)
    , number(input.dofs.NumMyElements(), -1)
    , replaced(input.dofs.NumMyElements())
  {
    add_stiffness();
    add_terms();
    if (Utilities::MPI::n_mpi_processes(system.rhs.get_mpi_communicator()) > 1)
      exchange();
    gather();
  }



  SparseRow &
  Condensation::new_row(const int i)
  {
    if (number[i] < 0)
      {
        number[i] = static_cast<int>(rows.size());
        rows.emplace_back();
      }
    return rows[number[i]];
  }



  double
  Condensation::add_transformed(const int column, const double value)
  {
    const TransformationRows::Row *row = trial.row(column);
    if (!row)
      {
        accumulator.add(column, value);
        return 0.;
      }
    for (const auto &[other, factor] : row->entries)
      accumulator.add(other, value * factor);
    return value * row->inhomogeneity;
  }



  void
  Condensation::add_source(const int row, const double value)
  {
    const int source = static_cast<int>(sources.size());
    sources.push_back(accumulator.take());
    source_values.push_back(value);
    if (const TransformationRows::Row *of_test = test.row(row))
      for (const auto &[target, factor] : of_test->entries)
        parts.push_back({target, source, factor});
    else
      parts.push_back({row, source, 1.});
  }



  std::vector<char>
  Condensation::affected_nodes()
  {
    // Each column is asked for 27 times: look it up once.
    const BlockPattern &pattern = system.stiffness->couplings();
    std::vector<char>   affected(pattern.n_nodes()), plain(pattern.n_local_nodes(), 1);
    for (unsigned int node = 0; node < plain.size(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        if (trial.row(static_cast<int>(dim * node + d)))
          plain[node] = 0;
    for (unsigned int node = 0; node < affected.size(); ++node)
      {
        for (std::size_t k = pattern.start[node]; k < pattern.start[node + 1]; ++k)
          affected[node] |= !plain[pattern.column[k]];
        if (!plain[node])
          for (std::size_t k = pattern.start[node]; k < pattern.upper_end[node]; ++k)
            affected[pattern.column[k]] = 1;
      }
    return affected;
  }



  void
  Condensation::add_stiffness()
  {
    const Matrix &stiffness = *system.stiffness;
    const double *shift =
      system.diagonal_shift.size() > 0 ? system.diagonal_shift.begin() : nullptr;
    const std::vector<char> affected = affected_nodes();
    double                  diagonal = 0.;
    std::vector<int>        constrained_rows;
    Matrix::Rows            matrix_rows(stiffness);
    for (int i = 0; i < static_cast<int>(dim * stiffness.n_nodes()); ++i)
      {
        const bool constrained = system.constraints.is_constrained(dofs.GID(i));
        if (constrained)
          constrained_rows.push_back(i);
        if (!affected[i / dim] && !constrained && !(shift && shift[i] != 0.))
          {
            values[i] = system.rhs.begin()[i];
            continue;
          }
        values[i]   = 0.;
        replaced[i] = 1;
        diagonal    = std::max(diagonal, std::abs(stiffness.diagonal(i)));
        if (const auto *of_test = test.row(i); of_test && of_test->entries.empty())
          continue; // a support: its equation goes to no other dof
        double product = 0.;
        for_each_entry(matrix_rows.read(i / dim), i, [&](const int column, const double value) {
          product += add_transformed(column, value);
        });
        if (shift)
          product += add_transformed(i, shift[i]);
        add_source(i, system.rhs.begin()[i] - product);
      }
    add_own_rows(constrained_rows, diagonal);
  }



  void
  Condensation::add_own_rows(const std::vector<int> &constrained, double diagonal)
  {
    // Of the size of others, so that it changes no condition number.
    diagonal = Utilities::MPI::max(diagonal, system.rhs.get_mpi_communicator());
    if (diagonal == 0.)
      diagonal = 1.;
    for (const int i : constrained)
      new_row(i) = {{i, diagonal}};
    const int n = static_cast<int>(dim * system.stiffness->n_nodes());
    for (Index k = 0; k < system.n_extra; ++k)
      {
        values[n + k]   = system.extra_rhs[k];
        replaced[n + k] = 1;
        new_row(n + k);
      }
  }



  void
  Condensation::add_terms()
  {
    for (const RankOneTerm &term : system.terms)
      {
        double inhomogeneity = 0.;
        for (const auto &[column, value] : term.right)
          inhomogeneity += add_transformed(columns.local(column), value);
        sources.push_back(take_without_round_off());
        source_values.push_back(-inhomogeneity);
        for (const auto &[dof, value] : term.left)
          {
            const int here = row_indices.local(dof);
            if (const TransformationRows::Row *row = test.row(here))
              for (const auto &[target, factor] : row->entries)
                accumulator.add(target, value * factor);
            else
              accumulator.add(here, value);
          }
        const int source = static_cast<int>(sources.size()) - 1;
        for (const auto &[target, value] : take_without_round_off())
          parts.push_back({target, source, value});
      }
  }



  SparseRow
  Condensation::take_without_round_off()
  {
    constexpr double round_off = 1e-14;
    SparseRow        row       = accumulator.take();
    double           largest   = 0.;
    for (const auto &entry : row)
      largest = std::max(largest, std::abs(entry.second));
    row.erase(std::remove_if(row.begin(),
                             row.end(),
                             [&](const auto &entry) {
                               return std::isfinite(entry.second) &&
                                      std::abs(entry.second) <= round_off * largest;
                             }),
              row.end());
    return row;
  }



  std::size_t
  Condensation::sum(const std::size_t begin, double &value)
  {
    std::size_t k = begin;
    for (; k < parts.size() && parts[k].target == parts[begin].target; ++k)
      {
        const double factor = parts[k].factor;
        for (const auto &[column, entry] : sources[parts[k].source])
          accumulator.add(column, factor * entry);
        value += factor * source_values[parts[k].source];
      }
    return k;
  }



  std::vector<unsigned int>
  Condensation::owners(const std::vector<Index> &of_dofs) const
  {
    struct First
    {
      Index displacement, extra;
    };
    const Index n     = system.rhs.size();
    const Index first = system.stiffness->n_nodes() > 0 ? static_cast<Index>(dofs.GID(0)) : n;
    const auto  all   = gather_records(std::vector<First>{{first, system.first_extra}},
                                    system.rhs.get_mpi_communicator());
    std::vector<unsigned int> result;
    for (const Index dof : of_dofs)
      {
        unsigned int owner = 0;
        for (unsigned int rank = 0; rank < all.size(); ++rank)
          if ((dof >= n ? all[rank][0].extra : all[rank][0].displacement) <= dof)
            owner = rank;
        result.push_back(owner);
      }
    return result;
  }



  void
  Condensation::exchange()
  {
    const MPI_Comm communicator = system.rhs.get_mpi_communicator();
    const int      n_owned      = dofs.NumMyElements();
    const auto foreign = std::stable_partition(parts.begin(), parts.end(), [&](const Part &part) {
      return part.target < n_owned;
    });
    std::vector<Part> away(foreign, parts.end());
    parts.erase(foreign, parts.end());
    std::stable_sort(away.begin(), away.end(), [](const Part &a, const Part &b) {
      return a.target < b.target;
    });
    parts.swap(away);

    std::vector<Index> targets;
    for (const Part &part : parts)
      targets.push_back(row_indices.global()[part.target]);
    const std::vector<unsigned int>                owner = owners(targets);
    std::map<unsigned int, std::vector<SentRow>>   sent_rows;
    std::map<unsigned int, std::vector<SentEntry>> sent_entries;
    for (std::size_t begin = 0; begin < parts.size();)
      {
        const Index        target = targets[begin];
        const unsigned int rank   = owner[begin];
        double             value  = 0.;
        begin                     = sum(begin, value);
        const SparseRow row       = accumulator.take();
        sent_rows[rank].push_back({target, value, row.size()});
        auto &entries = sent_entries[rank];
        for (const auto &[column, entry] : row)
          entries.push_back({static_cast<Index>(columns.global()[column]), entry});
      }
    parts.swap(away);
    auto received_entries = exchange_records(sent_entries, communicator);
    for (const auto &[rank, received_rows] : exchange_records(sent_rows, communicator))
      {
        auto entry = received_entries[rank].cbegin();
        for (const SentRow &received : received_rows)
          {
            for (const auto end = entry + received.n_entries; entry != end; ++entry)
              accumulator.add(columns.local(entry->column), entry->value);
            // Summed up for this row by the sender: not transformed again.
            parts.push_back(
              {row_indices.local(received.row), static_cast<int>(sources.size()), 1.});
            sources.push_back(accumulator.take());
            source_values.push_back(received.value);
          }
      }
  }



  void
  Condensation::gather()
  {
    Matrix::Rows matrix_rows(*system.stiffness);
    std::stable_sort(parts.begin(), parts.end(), [](const Part &a, const Part &b) {
      return a.target < b.target;
    });
    // Most rows of A T are needed once, and together they are large.
    std::vector<unsigned int> uses(sources.size(), 0);
    for (const Part &part : parts)
      ++uses[part.source];
    for (std::size_t begin = 0, end = 0; begin < parts.size(); begin = end)
      {
        const int row = parts[begin].target;
        if (!replaced[row])
          for_each_entry(matrix_rows.read(row / dim),
                         row,
                         [&](const int column, const double value) {
                           accumulator.add(column, value);
                         });
        end          = sum(begin, values[row]);
        new_row(row) = accumulator.take();
        for (std::size_t k = begin; k < end; ++k)
          if (--uses[parts[k].source] == 0)
            SparseRow().swap(sources[parts[k].source]);
      }
  }
} // namespace Touchstone
