// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/shared_lines.h>
#include <touchstone/base/exchange.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>

#include <algorithm>
#include <map>

// Exchange of the constraint lines of dofs that several ranks know (doc/theory.md, section 7).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Line = AffineConstraints<double>::ConstraintLine;

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



    /** Lines of @p asked dofs that other ranks own; @p own_lines are sorted by dof. Collective. */
    std::vector<Line>
    lines_of_others(const std::vector<Line> &own_lines,
                    const IndexSet          &owned,
                    const IndexSet          &asked,
                    const MPI_Comm           communicator)
    {
      // The partitioner knows both directions: import_indices() are the own dofs that other ranks
      // have among their ghosts, in the order of import_targets(). So owners send without being
      // asked.
      const Utilities::MPI::Partitioner partitioner(owned, asked, communicator);
      std::vector<Index>                wanted;
      for (const auto &[begin, end] : partitioner.import_indices())
        for (unsigned int i = begin; i < end; ++i)
          wanted.push_back(partitioner.local_to_global(i));
      std::map<unsigned int, std::vector<SentLine>>        sent_lines;
      std::map<unsigned int, std::vector<SentCoefficient>> sent_coefficients;
      auto                                                 next = wanted.begin();
      for (const auto &[rank, n] : partitioner.import_targets())
        for (const auto end = next + n; next != end; ++next)
          {
            const auto line =
              std::lower_bound(own_lines.begin(),
                               own_lines.end(),
                               *next,
                               [](const Line &a, const Index i) { return a.index < i; });
            if (line == own_lines.end() || line->index != *next)
              continue;
            sent_lines[rank].push_back({*next, line->inhomogeneity, line->entries.size()});
            for (const auto &[index, coefficient] : line->entries)
              sent_coefficients[rank].push_back({index, coefficient});
          }
      auto              coefficients = exchange_records(sent_coefficients, communicator);
      std::vector<Line> result;
      for (const auto &[rank, lines] : exchange_records(sent_lines, communicator))
        {
          auto entry = coefficients[rank].cbegin();
          for (const SentLine &line : lines)
            {
              result.emplace_back(line.index);
              result.back().inhomogeneity = line.inhomogeneity;
              for (const auto end = entry + line.n_entries; entry != end; ++entry)
                result.back().entries.emplace_back(entry->index, entry->coefficient);
            }
        }
      return result;
    }
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



  AffineConstraints<double>
  gather_lines(std::vector<Line> own_lines,
               const IndexSet   &owned,
               const IndexSet   &needed,
               const MPI_Comm    communicator)
  {
    std::sort(own_lines.begin(), own_lines.end(), [](const Line &a, const Line &b) {
      return a.index < b.index;
    });
    std::vector<Line> lines = own_lines;
    IndexSet          known = needed, asked = needed;
    // Each round asks for what the lines of the last one refer to, until no rank meets a dof that
    // it has not asked for.
    std::size_t new_lines = 0;
    while (Utilities::MPI::n_mpi_processes(communicator) > 1)
      {
        for (Line &line : lines_of_others(own_lines, owned, asked, communicator))
          lines.push_back(std::move(line));
        std::vector<Index> far;
        for (; new_lines < lines.size(); ++new_lines)
          for (const auto &entry : lines[new_lines].entries)
            if (!known.is_element(entry.first))
              far.push_back(entry.first);
        if (Utilities::MPI::max(static_cast<int>(!far.empty()), communicator) == 0)
          break;
        asked = add_indices(IndexSet(known.size()), far);
        known = add_indices(known, far);
      }
    AffineConstraints<double> result(known);
    for (const Line &line : lines)
      {
        result.add_line(line.index);
        result.add_entries(line.index, line.entries);
        result.set_inhomogeneity(line.index, line.inhomogeneity);
      }
    return result;
  }
} // namespace Touchstone
