// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/condensation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// The rows of S^T (A + C) T that differ from those of the stiffness A, and the right-hand side
// S^T (b - A g) (doc/theory.md, section 7). Only nodes near constraints and contact are affected,
// so the cost is that of the contact surface and not of the volume. The steps are: rows of A T
// and of the contact terms (condensation_sources.cc), sums for rows of other ranks and their
// exchange (condensation_exchange.cc), sums for the own rows.
namespace Touchstone
{
  using namespace dealii;

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
  Condensation::Condensation(const CondensationInput &input, LocalIndices &columns, const bool half)
    : values(input.dofs.NumMyElements())
    , system(input.system)
    , dofs(input.dofs)
    , row_indices(input.dofs)
    , columns(columns)
    , trial(input.trial, columns)
    , test(input.test, row_indices)
    , number(input.dofs.NumMyElements(), -1)
    , replaced(input.dofs.NumMyElements())
    , half(half)
  {
    // Whole rows of the stiffness are read twice; what that takes is made once.
    const auto transposed = system.stiffness->couplings().transposed_blocks();
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
        end             = sum(begin, values[row]);
        SparseRow whole = accumulator.take();
        if (half)
          whole.erase(std::remove_if(whole.begin(),
                                     whole.end(),
                                     [&](const auto &entry) {
                                       return entry.first / int(dim) < row / int(dim);
                                     }),
                      whole.end());
        // As long as it is, for these rows are many.
        new_row(row) = SparseRow(whole);
        for (std::size_t k = begin; k < end; ++k)
          if (--uses[parts[k].source] == 0)
            SparseRow().swap(sources[parts[k].source]);
      }
  }
} // namespace Touchstone
