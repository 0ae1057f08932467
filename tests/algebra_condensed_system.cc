// SPDX-License-Identifier: LGPL-2.1-or-later
// The condensed system against dense matrices: constraints with chains and
// inhomogeneities, contact terms in rows of other ranks, a diagonal shift, and
// extra unknowns.

#include <touchstone/algebra/condensed_system.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>

#include "mesh_common.h"
#include <random>

using namespace Touchstone;
using namespace dealii;

namespace
{
  constexpr unsigned int n = 24;

  double
  number(const unsigned int i, const unsigned int j)
  {
    std::mt19937 generator(1000 * i + j);
    return generator() / 2147483648. - 1.;
  }

  /** A banded symmetric matrix. */
  double
  entry(const unsigned int i, const unsigned int j)
  {
    const unsigned int distance = i > j ? i - j : j - i;
    if (i == j)
      return 10. + number(i, i);
    return distance <= 4 ? number(std::min(i, j), std::max(i, j)) : 0.;
  }



  void
  check(const std::string               &what,
        const AffineConstraints<double> &constraints,
        const std::vector<RankOneTerm>  &terms,
        const bool                       shifted,
        const std::vector<unsigned int> &extra_of_rank,
        const bool                       break_it = false,
        const bool                       springs  = false,
        const bool                       half     = true)
  {
    const MPI_Comm     communicator = MPI_COMM_WORLD;
    const unsigned int rank         = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int n_ranks      = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int begin = n * rank / n_ranks, end = n * (rank + 1) / n_ranks;
    IndexSet           owned(n);
    owned.add_range(begin, end);

    // Nodes are coupled that are up to two apart.
    IndexSet nodes(n / dim);
    nodes.add_range(begin / dim, end / dim);
    DynamicSparsityPattern pattern(n / dim, n / dim, nodes);
    const auto             for_neighbours = [](const unsigned int node, const auto &visit) {
      for (unsigned int other = node < 2 ? 0 : node - 2; other < std::min(node + 3, n / dim);
           ++other)
        visit(other);
    };
    for (unsigned int node = begin / dim; node < end / dim; ++node)
      for_neighbours(node, [&](const unsigned int other) { pattern.add(node, other); });
    Matrix stiffness;
    stiffness.reinit(owned, pattern, communicator, half);
    for (unsigned int node = begin / dim; node < end / dim; ++node)
      for_neighbours(node, [&](const unsigned int other) {
        const int          rows[]  = {stiffness.row(dim * node), -1};
        const unsigned int nodes[] = {stiffness.node(dim * node), stiffness.node(dim * other)};
        // A pair of nodes, of which only the rows of the first count.
        stiffness.add(2, rows, nodes, [&](const unsigned int i, const unsigned int j) {
          return (j < dim) == (other == node) ? entry(dim * node + i, dim * other + j % dim) : 0.;
        });
      });

    LinearSystem system;
    system.stiffness = &stiffness;
    system.rhs.reinit(owned, communicator);
    for (unsigned int i = begin; i < end; ++i)
      system.rhs[i] = number(i, 77);
    system.rhs.compress(VectorOperation::insert);
    if (shifted)
      {
        system.diagonal_shift.reinit(owned, communicator);
        for (unsigned int i = begin; i < end; ++i)
          system.diagonal_shift[i] = 1. + i;
        system.diagonal_shift.compress(VectorOperation::insert);
      }
    system.constraints.copy_from(constraints);
    // The stretch of springs for unknowns.
    AffineConstraints<double> change(complete_index_set(n));
    if (springs)
      {
        change.add_line(12);
        change.add_entries(12, {{13, 0.5}, {22, 0.5}});
        change.add_line(21);
        change.add_entries(21, {{1, -2.}});
      }
    change.close();
    system.basis_change.copy_from(change);

    // Extra unknowns: on one rank there are those of all.
    unsigned int n_extra = 0;
    for (unsigned int r = 0; r < extra_of_rank.size(); ++r)
      {
        const unsigned int owner = std::min<unsigned int>(r, n_ranks - 1);
        if (owner < rank)
          system.first_extra += extra_of_rank[r];
        if (owner == rank)
          system.n_extra += extra_of_rank[r];
        n_extra += extra_of_rank[r];
      }
    system.first_extra += n;
    for (unsigned int k = 0; k < system.n_extra; ++k)
      system.extra_rhs.push_back(number(system.first_extra + k, 78));
    // Each term comes from some rank, not always from that of its row.
    for (unsigned int k = 0; k < terms.size(); ++k)
      if (k % n_ranks == rank)
        system.terms.push_back(terms[k]);
    system.definite = (n_extra == 0);

    const CondensedSystem condensed(system);

    // The same with dense matrices.
    const unsigned int     m = n + n_extra;
    FullMatrix<double>     a(m, m), t(m, m), at(m, m), reference(m, m), tc(m, m), tb(m, m);
    dealii::Vector<double> b(m), g(m), tmp(m), rhs(m);
    for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int j = 0; j < n; ++j)
          a(i, j) = entry(i, j);
        if (shifted)
          a(i, i) += 1. + i;
        b[i] = number(i, 77);
      }
    for (unsigned int k = n; k < m; ++k)
      b[k] = number(k, 78);
    for (const RankOneTerm &term : terms)
      for (const auto &[i, left] : term.left)
        for (const auto &[j, right] : term.right)
          a(i, j) += left * right;
    if (break_it)
      a(3, 4) += 1e-3;
    for (unsigned int i = 0; i < m; ++i)
      if (i < n && constraints.is_constrained(i))
        {
          for (const auto &pair : *constraints.get_constraint_entries(i))
            tc(i, pair.first) = pair.second;
          g[i] = constraints.get_inhomogeneity(i);
        }
      else
        tc(i, i) = 1.;
    for (unsigned int i = 0; i < m; ++i)
      {
        tb(i, i) = 1.;
        if (i < n && change.is_constrained(i))
          for (const auto &pair : *change.get_constraint_entries(i))
            tb(i, pair.first) = pair.second;
      }
    tc.mmult(t, tb);
    a.mmult(at, t);
    t.Tmmult(reference, at);
    a.vmult(tmp, g);
    tmp.sadd(-1., b);
    t.Tvmult(rhs, tmp);
    for (unsigned int i = 0; i < n; ++i)
      if (change.is_constrained(i))
        {
          double spring = shifted ? 1. + i : 0.;
          for (const RankOneTerm &term : terms)
            for (const auto &[k, left] : term.left)
              for (const auto &[l, right] : term.right)
                if (k == i && l == i)
                  spring += left * right;
          const double scale = spring > 0. ? entry(i, i) / (entry(i, i) + spring) : 1.;
          rhs[i] *= scale;
          for (unsigned int j = 0; j < m; ++j)
            {
              reference(i, j) *= scale;
              reference(j, i) *= scale;
            }
        }

    double                  worst = 0., worst_rhs = 0., worst_constrained = 0.;
    bool                    diagonal = true, marks = true;
    const auto              assembled = condensed.matrix();
    const Epetra_CrsMatrix &matrix    = *assembled;
    for (int row = 0; row < matrix.NumMyRows(); ++row)
      {
        const unsigned int  i = matrix.GRID(row);
        std::vector<double> values(m, 0.);
        int                 length;
        double             *value;
        int                *column;
        matrix.ExtractMyRowView(row, length, value, column);
        for (int k = 0; k < length; ++k)
          values[matrix.GCID(column[k])] += value[k];
        const bool constrained = i < n && constraints.is_constrained(i);
        marks                  = marks && (row >= static_cast<int>(condensed.constrained.size())
                                             ? !constrained
                                             : static_cast<bool>(condensed.constrained[row]) == constrained);
        for (unsigned int j = 0; j < m; ++j)
          if (constrained || (j < n && constraints.is_constrained(j)))
            {
              if (i == j)
                diagonal = diagonal && values[j] > 0.;
              else
                worst_constrained = std::max(worst_constrained, std::abs(values[j]));
            }
          else
            worst = std::max(worst, std::abs(values[j] - reference(i, j)));
        worst_rhs =
          std::max(worst_rhs, std::abs((*condensed.rhs)[row] - (constrained ? 0. : rhs[i])));
      }
    // The same system applied factor by factor, to each unit vector, and read node by node.
    const CondensedSystem applied(system, true);
    double                worst_block = 0.;
    if (n_extra == 0)
      {
        const auto rows = applied.block_rows();
        for (unsigned int node = 0; node < rows->n_nodes(); ++node)
          {
            const auto        &row = rows->read(node);
            FullMatrix<double> of_node(dim, m), of_matrix(dim, m);
            for (std::size_t k = 0; k < row.columns.size(); ++k)
              for (unsigned int r = 0; r < dim; ++r)
                for (unsigned int c = 0; c < dim; ++c)
                  of_node(r, rows->numbers()->local_to_global(dim * row.columns[k] + c)) +=
                    row.blocks[k][dim * r + c];
            for (unsigned int r = 0; r < dim; ++r)
              {
                int     length;
                double *value;
                int    *column;
                matrix.ExtractMyRowView(dim * node + r, length, value, column);
                for (int k = 0; k < length; ++k)
                  of_matrix(r, matrix.GCID(column[k])) += value[k];
              }
            of_node.add(-1., of_matrix);
            worst_block = std::max(worst_block, of_node.linfty_norm());
          }
      }
    Epetra_Vector unit(applied.rows()), column(applied.rows());
    double        worst_product = 0.;
    for (unsigned int j = 0; j < m; ++j)
      {
        unit.PutScalar(0.);
        if (const int local = applied.rows().LID(static_cast<int>(j)); local >= 0)
          unit[local] = 1.;
        applied.product().Apply(unit, column);
        for (int row = 0; row < column.MyLength(); ++row)
          {
            const unsigned int i = applied.rows().GID(row);
            const bool         held =
              (i < n && constraints.is_constrained(i)) || (j < n && constraints.is_constrained(j));
            if (held && i == j)
              diagonal = diagonal && column[row] > 0.;
            else
              worst_product =
                std::max(worst_product, std::abs(column[row] - (held ? 0. : reference(i, j))));
          }
      }
    for (int row = 0; row < column.MyLength(); ++row)
      worst_product =
        std::max(worst_product, std::abs((*applied.rhs)[row] - (*condensed.rhs)[row]));
    // And what both make of a solution, of the unknowns that are not determined by others.
    for (int row = 0; row < unit.MyLength(); ++row)
      {
        const unsigned int i = applied.rows().GID(row);
        unit[row]            = i < n && constraints.is_constrained(i) ? 0. : number(i, 79);
      }
    Touchstone::Vector x(owned, communicator), y(owned, communicator);
    condensed.expand(unit, x);
    applied.expand(unit, y);
    x -= y;
    worst_product     = std::max({worst_product, x.linfty_norm(), worst_block});
    const auto all    = [&](const double x) { return Utilities::MPI::max(x, communicator); };
    worst             = all(worst);
    worst_rhs         = all(worst_rhs);
    worst_constrained = all(worst_constrained);
    worst_product     = all(worst_product);
    const bool good   = all(diagonal && marks ? 0. : 1.) == 0.;
    const int  rows   = Utilities::MPI::sum(matrix.NumMyRows(), communicator);
    if (rank == 0)
      {
        std::cout << what << ": " << rows << " rows, matrix ";
        if (break_it)
          std::cout << (worst > 1e-4 ? "differs, as it must" : "does not notice FAILED")
                    << std::endl;
        else
          std::cout << small(worst) << ", constrained " << small(worst_constrained) << ", rhs "
                    << small(worst_rhs) << ", applied " << small(worst_product)
                    << (good ? "" : ", diagonal or marks FAILED") << std::endl;
      }
  }



  AffineConstraints<double>
  make_constraints(const unsigned int kind)
  {
    AffineConstraints<double> constraints(complete_index_set(n));
    const auto                line =
      [&](const Index i, const std::vector<std::pair<Index, double>> &entries, const double value) {
        constraints.add_line(i);
        constraints.add_entries(i, entries);
        constraints.set_inhomogeneity(i, value);
      };
    if (kind >= 1)
      {
        line(0, {}, 0.);
        line(n - 1, {}, 0.3);
      }
    if (kind >= 2)
      {
        // A slave on masters far away; one on a slave; one on a prescribed value.
        line(5, {{4, -0.5}, {20, 0.75}, {21, 0.25}}, 0.1);
        line(18, {{2, 0.5}, {5, 0.5}}, -0.2);
        line(8, {{9, -1.}, {n - 1, 0.4}}, 0.);
      }
    constraints.close();
    return constraints;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::vector<RankOneTerm>   contact = {{{{1, 0.5}}, {{22, 1.}}},
                                              {{{22, 0.5}}, {{1, 1.}}},
                                              {{{5, 1.}, {20, -1.}}, {{5, 1.}, {20, -1.}}},
                                              {{{5, 1.}}, {{5, 1.}}},
                                              {{{18, 1.}, {18, 2.}}, {{18, 1.}, {6, 1e-3}}},
                                              {{{3, 1.}}, {{3, 1.}}}};
  std::vector<RankOneTerm>         multipliers;
  const std::vector<LinearForm>    forms = {{{2, 1.}, {21, -1.}}, {{5, 1.}, {0, 0.5}}, {{12, -1.}}};
  for (unsigned int k = 0; k < forms.size(); ++k)
    {
      multipliers.push_back({{{n + k, 1.}}, forms[k]});
      multipliers.push_back({forms[k], {{n + k, 1.}}});
    }
  for (const unsigned int kind : {0, 1, 2})
    {
      const auto        constraints = make_constraints(kind);
      const std::string name        = "constraints " + std::to_string(kind);
      check(name, constraints, {}, false, {});
      check(name + ", shift", constraints, {}, true, {});
      check(name + ", contact terms", constraints, contact, false, {});
      check(name + ", multipliers", constraints, multipliers, true, {2, 1});
      check(name + ", another matrix", constraints, contact, false, {}, true);
      // Stiff springs: their stretch is the only unknown that they act on.
      const LinearForm               stretch = {{12, 1.}, {13, -0.5}, {22, -0.5}};
      const std::vector<RankOneTerm> stiff   = {{{{12, 4e4}, {13, -2e4}, {22, -2e4}}, stretch}};
      check(name + ", stiff spring", constraints, stiff, false, {}, false, true);
      check(name + ", all blocks stored", constraints, stiff, false, {}, false, true, false);
    }
  return 0;
}
