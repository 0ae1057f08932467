#include <touchstone/solid/row_writer.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  RowWriter::RowWriter(Matrix &matrix)
    : matrix(const_cast<Epetra_CrsMatrix &>(matrix.trilinos_matrix()))
  {
    this->matrix.OptimizeStorage();
    const int error = this->matrix.ExtractCrsDataPointers(begin, columns, values);
    AssertThrow(error == 0,
                dealii::ExcMessage("The stiffness matrix is not in compressed storage."));
  }



  int
  RowWriter::row(const Index global) const
  {
    return matrix.RowMap().LID(static_cast<int>(global));
  }



  int
  RowWriter::column(const Index global) const
  {
    return matrix.ColMap().LID(static_cast<int>(global));
  }



  int
  RowWriter::position(const int row, const int column) const
  {
    const int *first = columns + begin[row];
    const int *last  = columns + begin[row + 1];
    return std::lower_bound(first, last, column) - first;
  }



  void
  RowWriter::clear_node(const int row)
  {
    std::fill(values + begin[row], values + begin[row + dim], 0.);
  }



  void
  RowWriter::add(const unsigned int n_nodes,
                 const int         *node_rows,
                 const int         *node_columns,
                 const double      *stiffness)
  {
    const unsigned int n = dim * n_nodes;
    int                places[dim];
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
              {
                double       *entries = values + begin[row + i];
                const double *k       = stiffness + (dim * a + i) * n + dim * b;
                for (unsigned int j = 0; j < dim; ++j)
                  entries[places[j]] += k[j];
              }
          }
  }



  double
  RowWriter::absolute_sum(const int row) const
  {
    double sum = 0.;
    for (int k = begin[row]; k < begin[row + 1]; ++k)
      sum += std::abs(values[k]);
    return sum;
  }



  void
  add_rows(Matrix &sum, const Vector &factors, const Matrix &added)
  {
    for (int i = 0; i < sum.trilinos_matrix().NumMyRows(); ++i)
      {
        int     n, m, *columns;
        double *values, *others;
        sum.trilinos_matrix().ExtractMyRowView(i, n, values, columns);
        added.trilinos_matrix().ExtractMyRowView(i, m, others, columns);
        AssertThrow(n == m, dealii::ExcMessage("The matrices have different patterns."));
        for (int j = 0; j < n; ++j)
          values[j] += factors.begin()[i] * others[j];
      }
  }
} // namespace Touchstone
