// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/condensed_operator.h>
#include <touchstone/base/free_memory.h>

#include <algorithm>
#include <array>
#include <utility>

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
     * Rows of the condensed matrix as 3 x 3 blocks: those of the stiffness, made when they are
     * read, or those of Condensation where constraints or contact terms change them, with units.
     * Of a symmetric matrix half is kept and read.
     */
    class CondensedRows : public BlockRows
    {
    public:
      /** Whether blocks of earlier nodes of this rank are left out. */
      static bool
      only_half(const CondensationInput &input)
      {
        return input.system.symmetric && input.system.stiffness->couplings().symmetric;
      }

      // The base class needs the columns of the condensation to number the dofs, before members
      // of this class exist; so these two are made first and handed over as one object.
      struct Parts
      {
        explicit Parts(const CondensationInput &input)
          : columns(input.system.stiffness->columns())
          , condensation(input, columns, only_half(input))
        {
        }

        LocalIndices columns;
        Condensation condensation;
      };

      CondensedRows(const CondensationInput &input, std::unique_ptr<Parts> parts)
        : BlockRows(
            number(input.dofs, parts->columns.global().data(), parts->columns.global().size()))
        , stiffness(*input.system.stiffness)
        , half(only_half(input))
        , matrix_rows(stiffness)
        , local_node(stiffness.couplings().n_local_nodes())
        , changed(n_nodes(), none)
      {
        // Condensation numbers its columns in the order in which they turn up, the base class
        // those of a partitioner: the table translates the first to the second.
        std::vector<unsigned int> local_index;
        for (const int global : parts->columns.global())
          local_index.push_back(partitioner->global_to_local(global));
        for (unsigned int node = 0; node < local_node.size(); ++node)
          local_node[node] = local_index[dim * node] / dim;
        dealii::LinearAlgebra::distributed::Vector<double> units(partitioner);
        units = 1.;
        if (input.units)
          std::copy(input.units->Values(),
                    input.units->Values() + input.units->MyLength(),
                    units.begin());
        // Columns are scaled, too, and may belong to other ranks.
        units.update_ghost_values();
        for (unsigned int node = 0; node < n_nodes(); ++node)
          keep(node, parts->condensation, local_index, units);
      }

      std::size_t
      n_blocks() const override
      {
        // An estimate for memory that is reserved: the stiffness, and 10 % for what condensation
        // adds.
        const BlockPattern &pattern = stiffness.couplings();
        std::size_t         n       = pattern.column.size();
        for (unsigned int node = 0; node < pattern.n_nodes(); ++node)
          n += pattern.upper_end[node] - pattern.start[node];
        return n * 11 / 10;
      }

      const RowOfBlocks<Block> &
      read(const unsigned int node) override
      {
        present.clear();
        if (changed[node] == none)
          add_stiffness(node, {{false, false, false}});
        else
          for (const auto &[column, block] : rows[changed[node]])
            present.at(column) = block;
        return present;
      }

      void
      forget(const unsigned int node) override
      {
        if (changed[node] != none)
          std::vector<std::pair<int, Block>>().swap(rows[changed[node]]);
      }

    private:
      const Matrix &stiffness;
      const bool    half;
      Matrix::Rows  matrix_rows;
      /** Of each node to which rows of the stiffness refer. */
      std::vector<unsigned int> local_node;
      /** Number of the row that replaces that of the stiffness, by node, and those rows. As
       * blocks they take half the memory of scalar entries with their indices. */
      static constexpr int                            none = -1;
      std::vector<int>                                changed;
      std::vector<std::vector<std::pair<int, Block>>> rows;

      /** The rows of the stiffness that are not @p replaced, to the present one. */
      void
      add_stiffness(const unsigned int node, const std::array<bool, dim> &replaced)
      {
        const Matrix::Rows::Row &row =
          half ? matrix_rows.read_stored(node) : matrix_rows.read(node);
        for (std::size_t k = 0; k < row.columns.size(); ++k)
          {
            Block &to = present.at(static_cast<int>(local_node[row.columns[k]]));
            for (unsigned int d = 0; d < dim; ++d)
              for (unsigned int c = 0; c < dim && !replaced[d]; ++c)
                // Blocks of the stiffness are stored column by column, those of BlockRows row
                // by row.
                to[dim * d + c] = row.blocks[k][dim * c + d];
          }
      }

      /** Take the rows of a node that Condensation replaces as blocks, and free them there. A node
       * can have both kinds of rows: with a support in one direction its other rows may be
       * replaced or not, so each of the three is decided by itself. */
      void
      keep(const unsigned int                                        node,
           Condensation                                             &condensation,
           const std::vector<unsigned int>                          &local_index,
           const dealii::LinearAlgebra::distributed::Vector<double> &units)
      {
        std::array<bool, dim> replaced;
        for (unsigned int d = 0; d < dim; ++d)
          replaced[d] = condensation.row(static_cast<int>(dim * node + d)) != nullptr;
        const auto n_replaced = std::count(replaced.begin(), replaced.end(), true);
        if (n_replaced == 0)
          return;
        present.clear();
        if (n_replaced < dim)
          add_stiffness(node, replaced);
        // Units other than one stand in rows that replace others only.
        for (unsigned int d = 0; d < dim; ++d)
          if (replaced[d])
            for (const auto &[column, value] : condensation.take(static_cast<int>(dim * node + d)))
              {
                const unsigned int j = local_index[column];
                present.at(static_cast<int>(j / dim))[dim * d + j % dim] +=
                  value * units.local_element(dim * node + d) * units.local_element(j);
              }
        changed[node] = static_cast<int>(rows.size());
        rows.emplace_back();
        rows.back().reserve(present.columns.size());
        for (unsigned int k = 0; k < present.columns.size(); ++k)
          rows.back().emplace_back(present.columns[k], present.blocks[k]);
      }
    };
  } // namespace



  std::unique_ptr<BlockRows>
  condensed_block_rows(const CondensationInput &input)
  {
    // What the assembly of the stiffness left, and its last product.
    input.system.stiffness->free_work_space();
    give_back_free_memory();
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

    Matrix::Rows     matrix_rows(stiffness);
    std::vector<int> lengths(input.dofs.NumMyElements());
    for (unsigned int i = 0; i < lengths.size(); ++i)
      if (const SparseRow *row = condensation.row(i))
        lengths[i] = static_cast<int>(row->size());
      else
        lengths[i] = static_cast<int>(dim * matrix_rows.length(i / dim));

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
