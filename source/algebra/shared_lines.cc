// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/shared_lines.h>
#include <touchstone/base/exchange.h>

#include <deal.II/base/partitioner.h>

#include <algorithm>
#include <map>

// Exchange of the constraint lines of dofs that several ranks know (doc/theory.md, section 7).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A line x_index = inhomogeneity + sum of the next n_entries of those that are sent
     * beside it. */
    struct SentLine
    {
      Index       index;
      double      inhomogeneity;
      std::size_t n_entries;
    };

    struct SentCoefficient
    {
      Index  index;
      double coefficient;
    };
  } // namespace



  IndexSet
  add_indices(const IndexSet &known, std::vector<Index> more)
  {
    const auto end =
      std::remove_if(more.begin(), more.end(), [&](const Index i) { return known.is_element(i); });
    std::sort(more.begin(), end);
    IndexSet result(known);
    result.add_indices(more.begin(), std::unique(more.begin(), end));
    result.compress();
    return result;
  }



  void
  add_lines_of_others(AffineConstraints<double> &constraints,
                      const IndexSet            &owned,
                      const IndexSet            &needed,
                      const MPI_Comm             communicator)
  {
    // The partitioner knows both directions: import_indices() are the own dofs that other ranks
    // have among their ghosts, in the order of import_targets(). So owners send without being
    // asked.
    const Utilities::MPI::Partitioner partitioner(owned, needed, communicator);
    std::vector<Index>                asked;
    for (const auto &[begin, end] : partitioner.import_indices())
      for (unsigned int i = begin; i < end; ++i)
        asked.push_back(partitioner.local_to_global(i));
    std::map<unsigned int, std::vector<SentLine>>        sent_lines;
    std::map<unsigned int, std::vector<SentCoefficient>> sent_coefficients;
    auto                                                 next = asked.begin();
    for (const auto &[rank, n] : partitioner.import_targets())
      for (const auto end = next + n; next != end; ++next)
        if (constraints.is_constrained(*next))
          {
            const auto &entries = *constraints.get_constraint_entries(*next);
            sent_lines[rank].push_back(
              {*next, constraints.get_inhomogeneity(*next), entries.size()});
            for (const auto &[index, coefficient] : entries)
              sent_coefficients[rank].push_back({index, coefficient});
          }
    auto coefficients = exchange_records(sent_coefficients, communicator);
    for (const auto &[rank, lines] : exchange_records(sent_lines, communicator))
      {
        auto entry = coefficients[rank].cbegin();
        for (const SentLine &line : lines)
          {
            constraints.add_line(line.index);
            constraints.set_inhomogeneity(line.index, line.inhomogeneity);
            for (const auto end = entry + line.n_entries; entry != end; ++entry)
              constraints.add_entry(line.index, entry->index, entry->coefficient);
          }
      }
  }
} // namespace Touchstone
