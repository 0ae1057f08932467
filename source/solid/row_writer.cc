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
