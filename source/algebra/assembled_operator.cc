// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/condensed_operator.h>

#include <algorithm>

// The condensed matrix S^T A T as explicit rows, in two forms: an Epetra_CrsMatrix for
// factorisations, ML and PETSc, and 3 x 3 blocks read node by node for multigrid, which copies
// them to single precision and so needs no whole matrix in double precision. In both forms a row
// is that of the stiffness unless Condensation replaces it, as it does near constraints and
// contact only (doc/theory.md, section 7).
namespace Touchstone
{
  namespace
  {
    /**
     * Rows of the condensed matrix as 3 x 3 blocks, made when they are read: those of the
     * stiffness, or those of Condensation where constraints or contact terms change them. The
     * scaling by units is applied on the fly.
     */
    class CondensedRows : public BlockRows
    {
    public:
      // The base class needs the columns of the condensation to number the dofs, before members
      // of this class exist; so these two are made first and handed over as one object.
      struct Parts
      {
        explicit Parts(const CondensationInput &input)
          : columns(input.system.stiffness->columns())
          , condensation(input, columns)
        {
        }

        LocalIndices columns;
        Condensation condensation;
      };

      CondensedRows(const CondensationInput &input, std::unique_ptr<Parts> made)
        : BlockRows(
            number(input.dofs, made->columns.global().data(), made->columns.global().size()))
        , stiffness(*input.system.stiffness)
        , matrix_rows(stiffness)
        , parts(std::move(made))
        , units(partitioner)
      {
        // Condensation numbers its columns in the order in which they turn up, the base class
        // those of a partitioner: the table translates the first to the second.
        for (const int global : parts->columns.global())
          local_index.push_back(partitioner->global_to_local(global));
        units = 1.;
        if (input.units)
          std::copy(input.units->Values(),
                    input.units->Values() + input.units->MyLength(),
                    units.begin());
        // Columns are scaled, too, and may belong to other ranks.
        units.update_ghost_values();
      }

      std::size_t
      n_blocks() const override
      {
        const BlockPattern &pattern = stiffness.couplings();
        // An estimate for memory that is reserved: the stiffness, and 10 % for what condensation
        // adds.
        return (pattern.column.size() + pattern.transposed_blocks().blocks.size()) * 11 / 10;
      }

      const RowOfBlocks<Block> &
      read(const unsigned int node) override
      {
        present.clear();
        // A node can have both kinds of rows: with a support in one direction its other rows may
        // be replaced or not, so each of the three is decided by itself.
        const SparseRow *replaced[dim];
        bool             any = false, all = true;
        for (unsigned int d = 0; d < dim; ++d)
          {
            replaced[d] = parts->condensation.row(static_cast<int>(dim * node + d));
            any         = any || replaced[d];
            all         = all && replaced[d];
          }
        if (!all)
          {
            const Matrix::Rows::Row &row = matrix_rows.read(node);
            for (std::size_t k = 0; k < row.columns.size(); ++k)
              {
                Block &to = present.at(static_cast<int>(local_index[dim * row.columns[k]] / dim));
                for (unsigned int d = 0; d < dim; ++d)
                  for (unsigned int c = 0; c < dim && !replaced[d]; ++c)
                    // Blocks of the stiffness are stored column by column, those of BlockRows row
                    // by row.
                    to[dim * d + c] = row.blocks[k][dim * c + d];
              }
          }
        // Units other than one stand in rows that replace others only.
        for (unsigned int d = 0; d < dim && any; ++d)
          if (replaced[d])
            for (const auto &[column, value] : *replaced[d])
              {
                const unsigned int j = local_index[column];
                present.at(static_cast<int>(j / dim))[dim * d + j % dim] +=
                  value * units.local_element(dim * node + d) * units.local_element(j);
              }
        return present;
      }

    private:
      const Matrix                                      &stiffness;
      Matrix::Rows                                       matrix_rows;
      std::unique_ptr<Parts>                             parts;
      dealii::LinearAlgebra::distributed::Vector<double> units;
      /** Of each column of the parts. */
      std::vector<unsigned int> local_index;
    };
  } // namespace



  std::unique_ptr<BlockRows>
  condensed_block_rows(const CondensationInput &input)
  {
    return std::make_unique<CondensedRows>(input, std::make_unique<CondensedRows::Parts>(input));
  }



  // The lengths of all rows are known before the matrix is made, so Epetra can allocate it once
  // (static profile) and filling it takes no search: entries go in by local indices of columns.
  std::shared_ptr<Epetra_CrsMatrix>
  assemble_condensed_matrix(const CondensationInput &input, std::vector<double> *values)
  {
    const Matrix &stiffness = *input.system.stiffness;
    LocalIndices  columns(stiffness.columns());
    Condensation  condensation(input, columns);
    // The right-hand side is a by-product of the same pass; who wants the matrix alone passes
    // null.
    if (values)
      values->swap(condensation.values);

    Matrix::Rows        matrix_rows(stiffness);
    std::vector<int>    lengths(input.dofs.NumMyElements());
    const BlockPattern &pattern = stiffness.couplings();
    for (unsigned int i = 0; i < lengths.size(); ++i)
      if (const SparseRow *row = condensation.row(i))
        lengths[i] = static_cast<int>(row->size());
      else
        lengths[i] = static_cast<int>(dim * pattern.row_length(i / dim));

    const Epetra_Map column_map(
      -1, static_cast<int>(columns.global().size()), columns.global().data(), 0, input.dofs.Comm());
    auto matrix =
      std::make_shared<Epetra_CrsMatrix>(Copy, input.dofs, column_map, lengths.data(), true);
    std::vector<int>    indices;
    std::vector<double> entries;
    for (unsigned int i = 0; i < lengths.size(); ++i)
      {
        indices.clear();
        entries.clear();
        if (const SparseRow *row = condensation.row(i))
          for (const auto &[index, value] : *row)
            {
              indices.push_back(index);
              entries.push_back(value);
            }
        else
          {
            const Matrix::Rows::Row &of_node = matrix_rows.read(i / dim);
            for (std::size_t k = 0; k < of_node.columns.size(); ++k)
              for (unsigned int c = 0; c < dim; ++c)
                {
                  indices.push_back(static_cast<int>(dim * of_node.columns[k] + c));
                  entries.push_back(of_node.blocks[k][dim * c + i % dim]);
                }
          }
        const int error = matrix->InsertMyValues(i, lengths[i], entries.data(), indices.data());
        AssertThrow(error == 0, dealii::ExcMessage("A row does not fit into the matrix."));
      }
    matrix->FillComplete(input.dofs, input.dofs);
    // S and T end with the same diagonal matrix D of units: D (..) D keeps the matrix symmetric.
    if (input.units)
      {
        matrix->LeftScale(*input.units);
        matrix->RightScale(*input.units);
      }
    return matrix;
  }



  AssembledOperator::AssembledOperator(const CondensationInput &input)
  {
    std::vector<double> values;
    entries = assemble_condensed_matrix(input, &values);
    rhs     = std::make_unique<Epetra_Vector>(Copy, input.dofs, values.data());
    if (input.units)
      rhs->Multiply(1., *input.units, *rhs, 0.);
  }
} // namespace Touchstone
