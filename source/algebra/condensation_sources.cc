// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/condensation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

// The sources of the condensed system (doc/theory.md, section 7): rows of A T and of the contact
// terms, and which row of S^T takes them with which factor. Only nodes near constraints and contact
// are affected.
namespace Touchstone
{
  using namespace dealii;

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
} // namespace Touchstone
