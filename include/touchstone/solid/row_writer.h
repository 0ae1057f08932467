#ifndef touchstone_solid_row_writer_h
#define touchstone_solid_row_writer_h

#include <touchstone/algebra/vector.h>
#include <touchstone/types.h>

#include <Epetra_CrsMatrix.h>

namespace Touchstone
{
  /** @brief The stiffness rows of this rank as plain arrays, written to node by
   * node: the three rows of a node have the same columns. */
  class RowWriter
  {
  public:
    explicit RowWriter(Matrix &matrix);

    /** @brief Local row of a global unknown, or -1 if another rank owns it. */
    int
    row(Index global) const;

    /** @brief Local column of a global unknown. */
    int
    column(Index global) const;

    /** @brief Set the three rows of the node whose first row is @p row to zero. */
    void
    clear_node(int row);

    /**
     * @brief Add a stiffness of @p n_nodes nodes to the rows that this rank owns.
     * @param rows    First row of each node, or -1.
     * @param columns The three columns of each node.
     * @param value   Value(i, j) of 3 n_nodes times 3 n_nodes, force per length.
     */
    template <class Value>
    void
    add(unsigned int n_nodes, const int *rows, const int *columns, const Value &value);

    /** @brief Sum of the absolute values of a row. */
    double
    absolute_sum(int row) const;

  private:
    Epetra_CrsMatrix &matrix;
    int              *begin = nullptr, *columns = nullptr;
    double           *values = nullptr;

    /** Position, within each of the rows of a node, of a column. */
    int
    position(int row, int column) const;
  };

  template <class Value>
  void
  RowWriter::add(const unsigned int n_nodes,
                 const int         *node_rows,
                 const int         *node_columns,
                 const Value       &value)
  {
    int places[dim];
    for (unsigned int a = 0; a < n_nodes; ++a)
      if (const int row = node_rows[a]; row >= 0)
        for (unsigned int b = 0; b < n_nodes; ++b)
          {
            // The columns of a node mostly follow each other, but the order in
            // which Epetra numbers those that belong to several other ranks is its own.
            const int *columns_b = node_columns + dim * b;
            places[0]            = position(row, columns_b[0]);
            for (unsigned int j = 1; j < dim; ++j)
              places[j] = columns_b[j] == columns_b[j - 1] + 1 ? places[j - 1] + 1
                                                               : position(row, columns_b[j]);
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                values[begin[row + i] + places[j]] += value(dim * a + i, dim * b + j);
          }
  }



  /** @brief Add the rows of @p added, each multiplied by one of the @p factors, to those of
   * @p sum, which has the same pattern. */
  void
  add_rows(Matrix &sum, const Vector &factors, const Matrix &added);
} // namespace Touchstone

#endif
