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
     * @param values  Row by row, 3 n_nodes times 3 n_nodes, force per length.
     */
    void
    add(unsigned int n_nodes, const int *rows, const int *columns, const double *values);

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

  /** @brief Add the rows of @p added, each multiplied by one of the @p factors, to those of
   * @p sum, which has the same pattern. */
  void
  add_rows(Matrix &sum, const Vector &factors, const Matrix &added);
} // namespace Touchstone

#endif
