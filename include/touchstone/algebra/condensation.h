// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_condensation_h
#define touchstone_algebra_condensation_h

#include <touchstone/algebra/matrix.h>
#include <touchstone/algebra/transformation.h>

#include <Epetra_Map.h>
#include <deque>
#include <vector>

namespace Touchstone
{
  /** @brief Visit the entries of dof @p i of a node's row: local indices and values. */
  template <class Visit>
  void
  for_each_entry(const Matrix::Rows::Row &row, const int i, const Visit &visit)
  {
    for (std::size_t k = 0; k < row.columns.size(); ++k)
      for (unsigned int c = 0; c < dim; ++c)
        visit(static_cast<int>(dim * row.columns[k] + c), row.blocks[k][dim * c + i % dim]);
  }

  /** @brief Cache of the rows of a Transformation, without units, by local index. */
  class TransformationRows
  {
  public:
    struct Row
    {
      SparseRow entries;
      double    inhomogeneity = 0.;
    };

    /** @param indices Extended by those that the rows refer to. */
    TransformationRows(const Transformation &transformation, LocalIndices &indices)
      : transformation(transformation)
      , indices(indices)
    {
    }

    /** @brief Null if it is that of the identity. */
    const Row *
    row(int local);

  private:
    const Transformation &transformation;
    LocalIndices         &indices;
    /** Index in rows of the row of each dof; or its row is that of the identity, or has not been
     * asked of the transformation yet. */
    static constexpr int identity = -1, not_looked_up = -2;
    std::vector<int>     number;
    std::deque<Row>      rows;
  };

  /** @brief A sparse row under construction: entries of equal index are summed
   * up. */
  class SparseRowAccumulator
  {
  public:
    void
    add(const int index, const double value)
    {
      if (static_cast<std::size_t>(index) >= position.size())
        position.resize(2 * static_cast<std::size_t>(index) + 64, -1);
      if (position[index] < 0)
        {
          position[index] = static_cast<int>(row.size());
          row.emplace_back(index, value);
        }
      else
        row[position[index]].second += value;
    }

    /** @brief The row so far, in ascending order of the indices; the next one is
     * empty. */
    SparseRow
    take();

  private:
    /** Position of an index in the row; -1: not in it. */
    std::vector<int> position;
    SparseRow        row;
  };

  /** @brief The input from which a condensed system is made, S^T A T and S^T (b - A g) of a
   * linear system A x = b with x = T y + g. All objects must outlive the operators that are
   * made from it. */
  struct CondensationInput
  {
    const LinearSystem &system;
    /** Dofs of this rank, multipliers last. */
    const Epetra_Map &dofs;
    /** T with g, and S, which may be the same object. */
    const Transformation &trial, &test;
    /** The units of T and S (Transformation); null: one. */
    const Epetra_Vector *units;
    /** Marks constrained dofs, by local index. */
    const std::vector<bool> &constrained;
  };

  /**
   * @brief The rows of S^T A T that differ from the stiffness's own, and the
   * right-hand side S^T (b - A g), without units (doc/theory.md, section 7).
   *
   * A T is formed row by row, where a row of the stiffness meets a constrained
   * column and for contact terms; then each row of S^T (A T) gathers the rows
   * of the test functions that depend on its dof. Rows for other ranks are summed up
   * before they are sent.
   */
  class Condensation
  {
  public:
    /** @param columns Indices of the columns; those of the stiffness come first.
     * @param half Columns of earlier nodes of this rank are left out of rows.
     */
    Condensation(const CondensationInput &input, LocalIndices &columns, bool half = false);

    /** @brief The row that replaces that of the stiffness, by local index; null:
     * it is as it was. */
    const SparseRow *
    row(const int i) const
    {
      return number[i] < 0 ? nullptr : &rows[number[i]];
    }

    /** @brief Give away a row for which row() is not null. */
    SparseRow
    take(const int i)
    {
      SparseRow result;
      result.swap(rows[number[i]]);
      return result;
    }

    /** @brief Right-hand side of this rank's rows. */
    std::vector<double> values;

  private:
    /** Part of the product: row @p source times @p factor goes to row @p target.
     */
    struct Part
    {
      int    target, source;
      double factor;
    };

    const LinearSystem  &system;
    const Epetra_Map    &dofs;
    LocalIndices         row_indices;
    LocalIndices        &columns;
    TransformationRows   trial, test;
    SparseRowAccumulator accumulator;

    /** Index in rows of the row that replaces that of the stiffness, by local index; -1: none. */
    std::vector<int>       number;
    std::vector<SparseRow> rows;

    /** The rows of A T and their values of b - A g. */
    std::vector<SparseRow> sources;
    std::vector<double>    source_values;
    std::vector<Part>      parts;
    /** Marks rows of the stiffness that are replaced. */
    std::vector<char> replaced;
    const bool        half;

    SparseRow &
    new_row(int i);

    /** Which nodes' rows meet a dof whose row of T is not that of the identity.
     */
    std::vector<char>
    affected_nodes();

    void
    add_stiffness();

    /** Rows of constrained dofs and of multipliers, which may be empty otherwise.
     */
    void
    add_own_rows(const std::vector<int> &constrained, double diagonal);

    void
    add_terms();

    /** Take the present row of the accumulator, for one side of a term, without
     * entries of the size of round-off: where the elongation of a spring is a dof
     * nothing else is left. */
    SparseRow
    take_without_round_off();

    /** Take the present row of the accumulator for row @p row of A T. */
    void
    add_source(int row, double value);

    /** Multiply an entry by T from the right; returns its part of A g. */
    double
    add_transformed(int column, double value);

    /** Send the rows of other ranks to these, and receive those of this one. */
    void
    exchange();

    /** The rank that owns a dof. Ranks own displacements and multipliers in
     * ascending order. Collective. */
    std::vector<unsigned int>
    owners(const std::vector<Index> &of_dofs) const;

    /** Sum up the final rows of this rank from parts and sources. */
    void
    gather();

    /** Sum up the parts from @p begin to those of the next target. */
    std::size_t
    sum(std::size_t begin, double &value);
  };
} // namespace Touchstone

#endif
