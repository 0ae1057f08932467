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
    /** Visit the entries of unknown @p i of a node's row: local numbers and values. */
    template <class Visit>
    void
    for_each_entry(const Matrix::Rows::Row &row, const int i, const Visit &visit)
    {
      for (std::size_t k = 0; k < row.columns.size(); ++k)
        for (unsigned int c = 0; c < dim; ++c)
          visit(static_cast<int>(dim * row.columns[k] + c), row.blocks[k][dim * c + i % dim]);
    }

    /** A row of S^T A T for the rank that owns it: its right-hand side, and how many of the
     * entries that are sent beside it belong to it. */
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



  void
  LinearSystem::expand(Vector &solution) const
  {
    if (basis_change.get_local_lines().size() > 0)
      {
        const Vector deviation(solution);
        basis_change.distribute(solution);
        const IndexSet owned = solution.locally_owned_elements();
        for (const auto &line : basis_change.get_lines())
          if (owned.is_element(line.index))
            solution(line.index) += deviation(line.index);
        solution.compress(VectorOperation::add);
      }
    constraints.distribute(solution);
  }



  void
  Expansion::append(const Index global, const double factor, Line &line)
  {
    if (basis_change.is_constrained(global))
      for (const auto &[other, coefficient] : *basis_change.get_constraint_entries(global))
        line.entries.emplace_back(numbers.local(other), factor * coefficient);
    line.entries.emplace_back(numbers.local(global), factor);
  }



  const Expansion::Line *
  Expansion::line(const int local)
  {
    if (static_cast<std::size_t>(local) >= which.size())
      which.resize(numbers.global().size(), -2);
    if (which[local] == -2)
      {
        const Index global   = numbers.global()[local];
        which[local]         = -1;
        const bool unknown   = global < n_displacements;
        const bool dependent = unknown && constraints.is_constrained(global);
        if (dependent || (unknown && basis_change.is_constrained(global)))
          {
            Line line;
            if (dependent)
              {
                for (const auto &[other, factor] : *constraints.get_constraint_entries(global))
                  append(other, factor, line);
                line.shift = constraints.get_inhomogeneity(global);
              }
            else
              append(global, 1., line);
            which[local] = static_cast<int>(lines.size());
            lines.push_back(std::move(line));
          }
      }
    return which[local] < 0 ? nullptr : &lines[which[local]];
  }



  SparseRow
  Accumulator::take()
  {
    for (const auto &entry : row)
      place[entry.first] = -1;
    SparseRow result(row);
    row.clear();
    std::sort(result.begin(), result.end());
    return result;
  }



  Condensation::Condensation(const LinearSystem &system,
                             const Epetra_Map   &rows,
                             LocalNumbers       &columns)
    : values(rows.NumMyElements())
    , system(system)
    , row_map(rows)
    , row_numbers(rows)
    , columns(columns)
    , motion(system.constraints, system.basis_change, system.rhs.size(), columns)
    , test(system.test_constraints ? *system.test_constraints : system.constraints,
           system.test_basis_change ? *system.test_basis_change : system.basis_change,
           system.rhs.size(),
           row_numbers)
    , places(rows.NumMyElements(), -1)
    , replaced(rows.NumMyElements())
  {
    add_stiffness();
    add_terms();
    if (Utilities::MPI::n_mpi_processes(system.rhs.get_mpi_communicator()) > 1)
      exchange();
    gather();
  }



  double
  Condensation::expand(const int column, const double value)
  {
    const Expansion::Line *line = motion.line(column);
    if (!line)
      {
        accumulator.add(column, value);
        return 0.;
      }
    for (const auto &[other, factor] : line->entries)
      accumulator.add(other, value * factor);
    return value * line->shift;
  }



  void
  Condensation::add_source(const int row, const double value)
  {
    const int source = static_cast<int>(sources.size());
    sources.push_back(accumulator.take());
    source_values.push_back(value);
    if (const Expansion::Line *line = test.line(row))
      for (const auto &[target, factor] : line->entries)
        parts.push_back({target, source, factor});
    else
      parts.push_back({row, source, 1.});
  }



  std::vector<char>
  Condensation::touched_nodes()
  {
    // Which columns are plain is asked 27 times for each: look it up once.
    const BlockPattern &pattern = system.stiffness->couplings();
    std::vector<char>   touched(pattern.n_nodes()), plain(pattern.n_local_nodes(), 1);
    for (unsigned int node = 0; node < plain.size(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        if (motion.line(static_cast<int>(dim * node + d)))
          plain[node] = 0;
    for (unsigned int node = 0; node < touched.size(); ++node)
      {
        for (std::size_t k = pattern.start[node]; k < pattern.start[node + 1]; ++k)
          touched[node] |= !plain[pattern.column[k]];
        if (!plain[node])
          for (std::size_t k = pattern.start[node]; k < pattern.mirrored[node]; ++k)
            touched[pattern.column[k]] = 1;
      }
    return touched;
  }



  void
  Condensation::add_stiffness()
  {
    const Matrix &stiffness = *system.stiffness;
    const double *shift =
      system.diagonal_shift.size() > 0 ? system.diagonal_shift.begin() : nullptr;
    const std::vector<char> touched  = touched_nodes();
    double                  diagonal = 0.;
    std::vector<int>        supported;
    Matrix::Rows            matrix_rows(stiffness);
    for (int i = 0; i < static_cast<int>(dim * stiffness.n_nodes()); ++i)
      {
        const bool constrained = system.constraints.is_constrained(row_map.GID(i));
        if (constrained)
          supported.push_back(i);
        if (!touched[i / dim] && !constrained && !(shift && shift[i] != 0.))
          {
            values[i] = system.rhs.begin()[i];
            continue;
          }
        values[i]   = 0.;
        replaced[i] = 1;
        diagonal    = std::max(diagonal, std::abs(stiffness.diagonal(i)));
        if (const Expansion::Line *line = test.line(i); line && line->entries.empty())
          continue; // a support: nothing stands for this row
        double product = 0.;
        for_each_entry(matrix_rows.read(i / dim), i, [&](const int column, const double value) {
          product += expand(column, value);
        });
        if (shift)
          product += expand(i, shift[i]);
        add_source(i, system.rhs.begin()[i] - product);
      }
    diagonal = Utilities::MPI::max(diagonal, system.rhs.get_mpi_communicator());
    if (diagonal == 0.)
      diagonal = 1.;
    for (const int i : supported)
      new_row(i) = {{i, diagonal}};
    const int n = static_cast<int>(dim * stiffness.n_nodes());
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
        double shift = 0.;
        for (const auto &[column, value] : term.right)
          shift += expand(columns.local(column), value);
        sources.push_back(take_what_is_left());
        source_values.push_back(-shift);
        for (const auto &[row, value] : term.left)
          {
            const int here = row_numbers.local(row);
            if (const Expansion::Line *line = test.line(here))
              for (const auto &[target, factor] : line->entries)
                accumulator.add(target, value * factor);
            else
              accumulator.add(here, value);
          }
        const int source = static_cast<int>(sources.size()) - 1;
        for (const auto &[target, value] : take_what_is_left())
          parts.push_back({target, source, value});
      }
  }



  SparseRow
  Condensation::take_what_is_left()
  {
    SparseRow row     = accumulator.take();
    double    largest = 0.;
    for (const auto &entry : row)
      largest = std::max(largest, std::abs(entry.second));
    row.erase(std::remove_if(row.begin(),
                             row.end(),
                             [&](const auto &entry) {
                               return std::isfinite(entry.second) &&
                                      std::abs(entry.second) <= 1e-14 * largest;
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



  void
  Condensation::exchange()
  {
    const MPI_Comm communicator = system.rhs.get_mpi_communicator();
    const int      n_owned      = row_map.NumMyElements();
    const auto foreign = std::stable_partition(parts.begin(), parts.end(), [&](const Part &part) {
      return part.target < n_owned;
    });
    std::vector<Part> away(foreign, parts.end());
    parts.erase(foreign, parts.end());
    std::stable_sort(away.begin(), away.end(), [](const Part &a, const Part &b) {
      return a.target < b.target;
    });
    parts.swap(away);

    // Ranks own displacements and extra unknowns in ascending order.
    const Index first_owned = system.stiffness->n_nodes() > 0
                                ? static_cast<Index>(row_map.GID(0))
                                : static_cast<Index>(system.rhs.size());
    const auto  first =
      Utilities::MPI::all_gather(communicator, std::make_pair(first_owned, system.first_extra));
    const auto owner = [&](const Index i) {
      const bool   extra = i >= system.rhs.size();
      unsigned int rank  = 0;
      for (unsigned int r = 0; r < first.size(); ++r)
        if ((extra ? first[r].second : first[r].first) <= i)
          rank = r;
      return rank;
    };
    std::map<unsigned int, std::vector<SentRow>>   sent_rows;
    std::map<unsigned int, std::vector<SentEntry>> sent_entries;
    for (std::size_t begin = 0; begin < parts.size();)
      {
        const Index        target = row_numbers.global()[parts[begin].target];
        const unsigned int rank   = owner(target);
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
            // Summed up for this row by the sender: not expanded again.
            parts.push_back(
              {row_numbers.local(received.row), static_cast<int>(sources.size()), 1.});
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
