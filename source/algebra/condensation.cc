// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/condensation.h>
#include <touchstone/base/exchange.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>

// The rows of S^T (A + C) T that differ from those of the stiffness A, and the right-hand side
// S^T (b - A g) (doc/theory.md, section 7). Only nodes near constraints and contact are affected,
// so the cost is that of the contact surface and not of the volume. The steps are: rows of A T
// and of the contact terms (sources), which row of S^T takes them with which factor (parts), sums
// for rows of other ranks and their exchange, sums for the own rows.
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



  // Rows of T are looked up through deal.II's constraints by global index, which is slow; contact
  // couples a dof to dozens of others, so each answer is kept. A deque does not move its rows
  // when it grows: references that were returned stay valid.
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



  // In this order, for exchange() sends the parts of all sources, of the stiffness and of contact
  // terms, and gather() also sums up those that were received.
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



  // Column by T: an entry a_ij of a constrained dof j becomes entries a_ij T_jk of those that j
  // depends on, and a_ij g_j is known and goes to the right-hand side.
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



  // Row by S^T: row i of A T, with the right-hand side of the row, goes to all dofs k that test
  // function i depends on, with the factor S_ik. Rows are kept once and referred to by parts,
  // since a contact row distributes its slave row to the dofs of the master faces.
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
    // A node has about 27 neighbours in a mesh of hexahedra, so each column would be looked up 27
    // times: mark the nodes that T leaves alone once.
    const BlockPattern &pattern = system.stiffness->couplings();
    std::vector<char>   affected(pattern.n_nodes()), plain(pattern.n_local_nodes(), 1);
    for (unsigned int node = 0; node < plain.size(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        if (trial.row(static_cast<int>(dim * node + d)))
          plain[node] = 0;
    for (unsigned int node = 0; node < affected.size(); ++node)
      {
        // Of two blocks that are each other's transposes one is stored: a changed node affects
        // the nodes above it through its own upper blocks, and those below through theirs.
        for (std::size_t k = pattern.start[node]; k < pattern.start[node + 1]; ++k)
          affected[node] |= !plain[pattern.column[k]];
        if (!plain[node])
          for (std::size_t k = pattern.start[node]; k < pattern.upper_end[node]; ++k)
            affected[pattern.column[k]] = 1;
      }
    return affected;
  }



  // Rows of the stiffness that meet a constrained column, belong to a constrained dof, or get a
  // shift of the diagonal (a force per length, where contact alone holds a body, doc/theory.md,
  // section 9) become sources; all others stay in the stiffness and only give their right-hand
  // side.
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
    // Last, because the entries of constrained dofs are to be of the size of the largest diagonal
    // entry that the loop has met.
    add_own_rows(constrained_rows, diagonal);
  }



  // Rows that no stiffness gives: a diagonal for constrained dofs, so that the matrix stays
  // regular, and rows of multipliers, which may stay empty if a multiplier has no term.
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



  // A term l r^T becomes S^T l (T^T r)^T - one source r^T T, shared by all rows of S^T l. Forms
  // may name the same dof several times, and contributions may cancel; see
  // take_without_round_off().
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
    // Entries that are not finite are kept, so that check_finite() (linear_solver.cc) finds them:
    // an infinite entry would make the threshold infinite and be dropped itself.
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



  // The sum of all parts of one target, factor times source, in the accumulator, and of their
  // right-hand sides in value. Returns where the next target begins; parts have to be sorted by
  // target.
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



  // Displacements and multipliers are two ranges of numbers, each distributed over the ranks in
  // ascending order: the owner of a dof is the last rank whose first number is not greater. A rank
  // without nodes gets a first number behind all others, and one without multipliers that of the
  // next rank, so that neither is taken for the owner.
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



  // Rows of S^T A T for dofs of other ranks, as at a contact surface between two ranks. Each rank
  // sums up its parts of a row before it sends them, which keeps messages small: hundreds of
  // parts may share their columns. The stable sort keeps the order of summation, and with it the
  // round-off, from run to run.
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
    // sum() works on the member: give it the parts for other ranks for a while.
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
    // From here on the own parts again, to which those received are appended.
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



  // The final rows of this rank: the row of the stiffness itself where it stayed as it was but
  // other rows or contact terms are added to it, and all parts. A source is freed with its last
  // use, for together the rows of A T of a large contact surface take more memory than the rows
  // that result.
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
