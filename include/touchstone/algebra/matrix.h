// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_matrix_h
#define touchstone_algebra_matrix_h

#include <touchstone/algebra/block_matrix.h>
#include <touchstone/algebra/vector.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Epetra_Map.h>
#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief A matrix over the displacement dofs, as stiffness and mass, which is filled
   * cell by cell; each rank holds the rows of the dofs it owns and adds to no others.
   *
   * Rows go by local indices of dofs, three times those of nodes.
   */
  class Matrix : public BlockMatrix<double>
  {
  public:
    /**
     * @brief Zero, where each component of a node is coupled to all components of others.
     * Collective.
     *
     * @param owned     Dofs of this rank, whole nodes, without gaps.
     * @param couplings Rows of this rank's nodes, with the nodes themselves.
     * @param symmetric Of each two entries (i, j) and (j, i) one counts.
     */
    void
    reinit(const dealii::IndexSet               &owned,
           const dealii::DynamicSparsityPattern &couplings,
           MPI_Comm                              communicator,
           bool                                  symmetric);

    /** @brief Zero, with the couplings of @p other. */
    void
    reinit(const Matrix &other);

    Matrix() = default;

    /** @brief Set all entries. */
    Matrix &
    operator=(double value);

    Matrix &
    operator*=(double factor);

    /** @brief Take the entries, and couplings, of @p other. */
    void
    copy_from(const Matrix &other);

    /** @brief Add the rows of @p added, each multiplied by one of the @p factors, which has
     * the same couplings. Factors of coupled nodes are equal. */
    void
    add(const Vector &factors, const Matrix &added);

    /** @brief Add to the diagonal. */
    void
    add_to_diagonal(const Vector &values);

    /** @brief Which nodes are coupled. */
    const BlockPattern &
    couplings() const
    {
      return *pattern;
    }

    using BlockMatrix<double>::vmult;

    /** @brief result = A x. Collective. */
    void
    vmult(Vector &result, const Vector &x) const
    {
      multiply(result.begin(), x.begin());
    }

    /** @brief Dofs of this rank, and with them those that its rows refer to, in the order
     * of their local indices. */
    const Epetra_Map &
    rows() const
    {
      return *row_map;
    }
    const Epetra_Map &
    columns() const
    {
      return *column_map;
    }

    /** @brief Local index of a global dof, or -1 if another rank owns it. */
    int
    row(const Index global) const
    {
      const auto &partitioner = *pattern->partitioner;
      return partitioner.in_local_range(global)
               ? static_cast<int>(partitioner.global_to_local(global))
               : -1;
    }

    /** @brief Local index of the node of a global dof that this rank refers to. */
    unsigned int
    node(const Index global) const
    {
      return pattern->partitioner->global_to_local(global) / dim;
    }

    /** @brief Set the blocks of the node whose first row is @p row to zero. */
    void
    clear_node(int row);

    /**
     * @brief Add a matrix of @p n_nodes nodes to the rows that this rank owns.
     * @param rows  First row() of each node, or -1.
     * @param nodes Each node().
     * @param value Value(i, j) of 3 n_nodes times 3 n_nodes.
     */
    template <class Value>
    void
    add(unsigned int n_nodes, const int *rows, const unsigned int *nodes, const Value &value);

    /** @brief Sums of absolute values, of the rows of this rank. */
    std::vector<double>
    absolute_row_sums() const;

    /** @brief Collective. */
    double
    frobenius_norm() const;

  private:
    std::shared_ptr<const Epetra_Map> row_map, column_map;
  };



  template <class Value>
  void
  Matrix::add(const unsigned int  n_nodes,
              const int          *rows,
              const unsigned int *nodes,
              const Value        &value)
  {
    for (unsigned int a = 0; a < n_nodes; ++a)
      if (rows[a] >= 0)
        for (unsigned int b = 0; b < n_nodes; ++b)
          if (const unsigned int row = rows[a] / dim; pattern->has(row, nodes[b]))
            {
              double *to = &entries[dim * dim * pattern->block(row, nodes[b])];
              for (unsigned int j = 0; j < dim; ++j)
                for (unsigned int i = 0; i < dim; ++i)
                  *to++ += value(dim * a + i, dim * b + j);
            }
  }
} // namespace Touchstone

#endif
