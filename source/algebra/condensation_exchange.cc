// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/condensation.h>
#include <touchstone/base/exchange.h>

#include <deal.II/base/index_set.h>

#include <algorithm>
#include <map>

// Rows of the condensed system that belong to other ranks: summed up, sent to their owners, and
// received from others (doc/theory.md, section 7).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
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



  // Displacements and multipliers are two ranges of numbers, of each of which a rank has a piece.
  std::vector<unsigned int>
  Condensation::owners(const std::vector<Index> &of_dofs) const
  {
    IndexSet owned(dofs.NumGlobalElements()), asked(owned.size());
    owned.add_indices(system.rhs.locally_owned_elements());
    owned.add_range(system.first_extra, system.first_extra + system.n_extra);
    std::vector<Index> sorted = of_dofs;
    std::sort(sorted.begin(), sorted.end());
    asked.add_indices(sorted.begin(), std::unique(sorted.begin(), sorted.end()));
    const std::vector<unsigned int> owner =
      Utilities::MPI::compute_index_owner(owned, asked, system.rhs.get_mpi_communicator());
    std::vector<unsigned int> result;
    for (const Index dof : of_dofs)
      result.push_back(owner[asked.index_within_set(dof)]);
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
} // namespace Touchstone
