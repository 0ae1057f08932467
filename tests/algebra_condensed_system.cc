// SPDX-License-Identifier: LGPL-2.1-or-later
// The condensed system against dense matrices: constraints with chains and
// inhomogeneities, contact terms in rows of other ranks, a diagonal shift, and
// extra unknowns.

#include <touchstone/algebra/condensed_system.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>

#include "mesh_common.h"
#include <numeric>
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



  /** What a condensed system is made of. */
  struct Case
  {
    AffineConstraints<double> constraints;
    std::vector<RankOneTerm>  terms;
    /** A shift of the diagonal. */
    bool shifted = false;
    /** Extra unknowns of each rank. */
    std::vector<unsigned int> extra_of_rank;
    /** The matrices must differ. */
    bool break_it = false;
    /** Elongations of springs are dofs, in place of a displacement each. */
    bool springs = false;
    /** Of two transposed blocks one is stored. */
    bool half = true;

    Case(const AffineConstraints<double> &constraints,
         const std::vector<RankOneTerm>  &terms,
         const bool                       shifted,
         const std::vector<unsigned int> &extra_of_rank,
         const bool                       break_it = false,
         const bool                       springs  = false,
         const bool                       half     = true)
      : terms(terms)
      , shifted(shifted)
      , extra_of_rank(extra_of_rank)
      , break_it(break_it)
      , springs(springs)
      , half(half)
    {
      this->constraints.copy_from(constraints);
    }

    unsigned int
    n_extra() const
    {
      return std::accumulate(extra_of_rank.begin(), extra_of_rank.end(), 0u);
    }

    bool
    constrained(const unsigned int i) const
    {
      return i < n && constraints.is_constrained(i);
    }

    AffineConstraints<double>
    change() const
    {
      AffineConstraints<double> result(complete_index_set(n));
      if (springs)
        {
          result.add_line(12);
          result.add_entries(12, {{13, 0.5}, {22, 0.5}});
          result.add_line(21);
          result.add_entries(21, {{1, -2.}});
        }
      result.close();
      return result;
    }
  };



  /** The rows of this rank. */
  IndexSet
  owned_rows()
  {
    const unsigned int rank    = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    IndexSet           owned(n);
    owned.add_range(n * rank / n_ranks, n * (rank + 1) / n_ranks);
    return owned;
  }



  /** The stiffness, in which nodes are coupled that are up to two apart. */
  void
  fill(Matrix &stiffness, const IndexSet &owned, const bool half)
  {
    const unsigned int begin = owned.nth_index_in_set(0), end = begin + owned.n_elements();
    IndexSet           nodes(n / dim);
    nodes.add_range(begin / dim, end / dim);
    DynamicSparsityPattern pattern(n / dim, n / dim, nodes);
    const auto             for_neighbours = [](const unsigned int node, const auto &visit) {
      for (unsigned int other = node < 2 ? 0 : node - 2; other < std::min(node + 3, n / dim);
           ++other)
        visit(other);
    };
    for (unsigned int node = begin / dim; node < end / dim; ++node)
      for_neighbours(node, [&](const unsigned int other) { pattern.add(node, other); });
    stiffness.reinit(owned, pattern, MPI_COMM_WORLD, half);
    for (unsigned int node = begin / dim; node < end / dim; ++node)
      for_neighbours(node, [&](const unsigned int other) {
        const int          rows[]  = {stiffness.row(dim * node), -1};
        const unsigned int nodes[] = {stiffness.node(dim * node), stiffness.node(dim * other)};
        // A pair of nodes, of which only the rows of the first count.
        stiffness.add(2, rows, nodes, [&](const unsigned int i, const unsigned int j) {
          return (j < dim) == (other == node) ? entry(dim * node + i, dim * other + j % dim) : 0.;
        });
      });
  }



  /** The system of this rank, with the stiffness @p stiffness. */
  void
  make_system(const Case &c, const IndexSet &owned, const Matrix &stiffness, LinearSystem &system)
  {
    const unsigned int rank    = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    system.stiffness           = &stiffness;
    system.rhs.reinit(owned, MPI_COMM_WORLD);
    for (const auto i : owned)
      system.rhs[i] = number(i, 77);
    system.rhs.compress(VectorOperation::insert);
    if (c.shifted)
      {
        system.diagonal_shift.reinit(owned, MPI_COMM_WORLD);
        for (const auto i : owned)
          system.diagonal_shift[i] = 1. + i;
        system.diagonal_shift.compress(VectorOperation::insert);
      }
    system.constraints.copy_from(c.constraints);
    system.basis_change.copy_from(c.change());
    // Extra unknowns: on one rank there are those of all.
    for (unsigned int r = 0; r < c.extra_of_rank.size(); ++r)
      {
        const unsigned int owner = std::min<unsigned int>(r, n_ranks - 1);
        if (owner < rank)
          system.first_extra += c.extra_of_rank[r];
        if (owner == rank)
          system.n_extra += c.extra_of_rank[r];
      }
    system.first_extra += n;
    for (unsigned int k = 0; k < system.n_extra; ++k)
      system.extra_rhs.push_back(number(system.first_extra + k, 78));
    // Each term comes from some rank, not always from that of its row.
    for (unsigned int k = 0; k < c.terms.size(); ++k)
      if (k % n_ranks == rank)
        system.terms.push_back(c.terms[k]);
    system.definite = (c.n_extra() == 0);
  }



  /** The same with dense matrices: T^T A T and T^T (b - A g). */
  struct Dense
  {
    FullMatrix<double>     matrix;
    dealii::Vector<double> rhs;
  };



  /** Matrix and right-hand side before condensation. */
  Dense
  dense_system(const Case &c)
  {
    const unsigned int m = n + c.n_extra();
    Dense              result{FullMatrix<double>(m, m), dealii::Vector<double>(m)};
    for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int j = 0; j < n; ++j)
          result.matrix(i, j) = entry(i, j);
        if (c.shifted)
          result.matrix(i, i) += 1. + i;
        result.rhs[i] = number(i, 77);
      }
    for (unsigned int k = n; k < m; ++k)
      result.rhs[k] = number(k, 78);
    for (const RankOneTerm &term : c.terms)
      for (const auto &[i, left] : term.left)
        for (const auto &[j, right] : term.right)
          result.matrix(i, j) += left * right;
    if (c.break_it)
      result.matrix(3, 4) += 1e-3;
    return result;
  }



  /** Scale the elongations of springs as the condensed system does. */
  void
  scale_springs(const Case &c, Dense &dense)
  {
    const AffineConstraints<double> change = c.change();
    for (unsigned int i = 0; i < n; ++i)
      if (change.is_constrained(i))
        {
          double spring = c.shifted ? 1. + i : 0.;
          for (const RankOneTerm &term : c.terms)
            for (const auto &[k, left] : term.left)
              for (const auto &[l, right] : term.right)
                if (k == i && l == i)
                  spring += left * right;
          const double scale = spring > 0. ? entry(i, i) / (entry(i, i) + spring) : 1.;
          dense.rhs[i] *= scale;
          for (unsigned int j = 0; j < dense.rhs.size(); ++j)
            {
              dense.matrix(i, j) *= scale;
              dense.matrix(j, i) *= scale;
            }
        }
  }



  Dense
  dense_condensation(const Case &c)
  {
    const Dense                     plain  = dense_system(c);
    const AffineConstraints<double> change = c.change();
    const unsigned int              m      = plain.rhs.size();
    FullMatrix<double>              t(m, m), at(m, m), tc(m, m), tb(m, m);
    dealii::Vector<double>          g(m), tmp(m);
    for (unsigned int i = 0; i < m; ++i)
      if (c.constrained(i))
        {
          for (const auto &pair : *c.constraints.get_constraint_entries(i))
            tc(i, pair.first) = pair.second;
          g[i] = c.constraints.get_inhomogeneity(i);
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
    Dense result{FullMatrix<double>(m, m), dealii::Vector<double>(m)};
    tc.mmult(t, tb);
    plain.matrix.mmult(at, t);
    t.Tmmult(result.matrix, at);
    plain.matrix.vmult(tmp, g);
    tmp.sadd(-1., plain.rhs);
    t.Tvmult(result.rhs, tmp);
    scale_springs(c, result);
    return result;
  }



  /** The largest errors on this rank. */
  struct Errors
  {
    double matrix = 0., rhs = 0., constrained = 0., applied = 0.;
    /** The diagonal of constrained rows is positive, and they are marked. */
    bool good = true;
  };



  /** A row of the matrix, with entries for all unknowns. */
  std::vector<double>
  row_of(const Epetra_CrsMatrix &matrix, const int row)
  {
    std::vector<double> values(matrix.NumGlobalCols(), 0.);
    int                 length;
    double             *value;
    int                *column;
    matrix.ExtractMyRowView(row, length, value, column);
    for (int k = 0; k < length; ++k)
      values[matrix.GCID(column[k])] += value[k];
    return values;
  }



  /** The rows of the condensed system are those of the dense one. */
  void
  check_rows(const Case             &c,
             const CondensedSystem  &condensed,
             const Epetra_CrsMatrix &matrix,
             const Dense            &dense,
             Errors                 &errors)
  {
    for (int row = 0; row < matrix.NumMyRows(); ++row)
      {
        const unsigned int        i           = matrix.GRID(row);
        const std::vector<double> values      = row_of(matrix, row);
        const bool                constrained = c.constrained(i);
        const bool                marked =
          row < static_cast<int>(condensed.constrained.size()) && condensed.constrained[row];
        errors.good = errors.good && marked == constrained;
        for (unsigned int j = 0; j < values.size(); ++j)
          if (constrained || c.constrained(j))
            {
              if (i == j)
                errors.good = errors.good && values[j] > 0.;
              else
                errors.constrained = std::max(errors.constrained, std::abs(values[j]));
            }
          else
            errors.matrix = std::max(errors.matrix, std::abs(values[j] - dense.matrix(i, j)));
        errors.rhs =
          std::max(errors.rhs, std::abs((*condensed.rhs)[row] - (constrained ? 0. : dense.rhs[i])));
      }
  }



  /** The same system read node by node, of a symmetric one the blocks that stand for others. */
  void
  check_blocks(const CondensedSystem &applied, const Epetra_CrsMatrix &matrix, Errors &errors)
  {
    const auto         rows = applied.block_rows();
    const unsigned int m    = matrix.NumGlobalCols();
    for (unsigned int node = 0; node < rows->n_nodes(); ++node)
      {
        const auto        &row = rows->read(node);
        FullMatrix<double> of_node(dim, m);
        for (std::size_t k = 0; k < row.columns.size(); ++k)
          for (unsigned int r = 0; r < dim; ++r)
            for (unsigned int c = 0; c < dim; ++c)
              of_node(r, rows->numbers()->local_to_global(dim * row.columns[k] + c)) +=
                row.blocks[k][dim * r + c];
        for (unsigned int r = 0; r < dim; ++r)
          {
            const std::vector<double> of_matrix = row_of(matrix, dim * node + r);
            for (unsigned int j = 0; j < m; ++j)
              if (applied.symmetric && rows->numbers()->in_local_range(j) &&
                  rows->numbers()->global_to_local(j) / dim < node)
                of_node(r, j) = 0.;
              else
                of_node(r, j) -= of_matrix[j];
          }
        errors.applied = std::max(errors.applied, of_node.linfty_norm());
      }
    // Rows that condensation has made are large, and freed once they have been read.
    for (unsigned int node = 0; node < rows->n_nodes(); ++node)
      {
        rows->forget(node);
        if (applied.constrained[dim * node])
          AssertThrow(rows->read(node).columns.empty(), ExcMessage("a row that was read is kept"));
      }
  }



  /** The same system applied factor by factor, to each unit vector. */
  void
  check_products(const Case            &c,
                 const CondensedSystem &applied,
                 const CondensedSystem &condensed,
                 const Dense           &dense,
                 Errors                &errors)
  {
    Epetra_Vector unit(applied.rows()), column(applied.rows());
    for (unsigned int j = 0; j < dense.rhs.size(); ++j)
      {
        unit.PutScalar(0.);
        if (const int local = applied.rows().LID(static_cast<int>(j)); local >= 0)
          unit[local] = 1.;
        applied.product().Apply(unit, column);
        for (int row = 0; row < column.MyLength(); ++row)
          {
            const unsigned int i    = applied.rows().GID(row);
            const bool         held = c.constrained(i) || c.constrained(j);
            if (held && i == j)
              errors.good = errors.good && column[row] > 0.;
            else
              errors.applied =
                std::max(errors.applied, std::abs(column[row] - (held ? 0. : dense.matrix(i, j))));
          }
      }
    for (int row = 0; row < column.MyLength(); ++row)
      errors.applied =
        std::max(errors.applied, std::abs((*applied.rhs)[row] - (*condensed.rhs)[row]));
  }



  /** What both make of a solution, of the unknowns that are not determined by others. */
  void
  check_solution(const Case            &c,
                 const CondensedSystem &applied,
                 const CondensedSystem &condensed,
                 const IndexSet        &owned,
                 Errors                &errors)
  {
    Epetra_Vector solution(applied.rows());
    for (int row = 0; row < solution.MyLength(); ++row)
      {
        const unsigned int i = applied.rows().GID(row);
        solution[row]        = c.constrained(i) ? 0. : number(i, 79);
      }
    Touchstone::Vector x(owned, MPI_COMM_WORLD), y(owned, MPI_COMM_WORLD);
    condensed.expand(solution, x);
    applied.expand(solution, y);
    x -= y;
    errors.applied = std::max(errors.applied, x.linfty_norm());
  }



  void
  check(const std::string &what, const Case &c)
  {
    const IndexSet owned = owned_rows();
    Matrix         stiffness;
    fill(stiffness, owned, c.half);
    LinearSystem system;
    make_system(c, owned, stiffness, system);
    const CondensedSystem condensed(system), applied(system, true);
    const auto            matrix = condensed.matrix();
    const Dense           dense  = dense_condensation(c);

    Errors errors;
    check_rows(c, condensed, *matrix, dense, errors);
    if (c.n_extra() == 0)
      check_blocks(applied, *matrix, errors);
    check_products(c, applied, condensed, dense, errors);
    check_solution(c, applied, condensed, owned, errors);

    const auto   all   = [](const double x) { return Utilities::MPI::max(x, MPI_COMM_WORLD); };
    const double worst = all(errors.matrix), constrained = all(errors.constrained),
                 rhs = all(errors.rhs), product = all(errors.applied);
    const bool good = all(errors.good ? 0. : 1.) == 0.;
    const int  rows = Utilities::MPI::sum(matrix->NumMyRows(), MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout << what << ": " << rows << " rows, matrix ";
        if (c.break_it)
          std::cout << (worst > 1e-4 ? "differs, as it must" : "does not notice FAILED")
                    << std::endl;
        else
          std::cout << small(worst) << ", constrained " << small(constrained) << ", rhs "
                    << small(rhs) << ", applied " << small(product)
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
      check(name, Case(constraints, {}, false, {}));
      check(name + ", shift", Case(constraints, {}, true, {}));
      check(name + ", contact terms", Case(constraints, contact, false, {}));
      check(name + ", multipliers", Case(constraints, multipliers, true, {2, 1}));
      check(name + ", another matrix", Case(constraints, contact, false, {}, true));
      // Stiff springs: their elongation is the only dof that they act on.
      const LinearForm               elongation = {{12, 1.}, {13, -0.5}, {22, -0.5}};
      const std::vector<RankOneTerm> stiff = {{{{12, 4e4}, {13, -2e4}, {22, -2e4}}, elongation}};
      check(name + ", stiff spring", Case(constraints, stiff, false, {}, false, true));
      check(name + ", all blocks stored", Case(constraints, stiff, false, {}, false, true, false));
    }
  return 0;
}
