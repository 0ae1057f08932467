#include <touchstone/algebra/applied_operator.h>
#include <touchstone/algebra/condensation.h>
#include <touchstone/algebra/condensed_system.h>

#include <algorithm>
#include <map>

namespace Touchstone
{
  namespace
  {
    /** Displacements, then extra unknowns, of this rank. */
    Epetra_Map
    unknowns(const LinearSystem &system)
    {
      const Epetra_Map &rows = system.stiffness->rows();
      std::vector<int>  numbers(rows.MyGlobalElements(),
                               rows.MyGlobalElements() + rows.NumMyElements());
      for (Index k = 0; k < system.n_extra; ++k)
        numbers.push_back(static_cast<int>(system.first_extra + k));
      return Epetra_Map(-1, static_cast<int>(numbers.size()), numbers.data(), 0, rows.Comm());
    }

    /** Rows of the stiffness, or what replaces them. */
    class CondensedRows : public BlockRows
    {
    public:
      struct Parts
      {
        Parts(const LinearSystem &system, const Epetra_Map &rows)
          : columns(system.stiffness->columns())
          , condensation(system, rows, columns)
        {
        }

        LocalNumbers columns;
        Condensation condensation;
      };

      /** @param scale May be null. */
      CondensedRows(const Matrix          &stiffness,
                    const Epetra_Map      &rows,
                    const Epetra_Vector   *scale,
                    std::unique_ptr<Parts> made)
        : BlockRows(number(rows, made->columns.global().data(), made->columns.global().size()))
        , stiffness(stiffness)
        , matrix_rows(stiffness)
        , parts(std::move(made))
        , factors(partitioner)
      {
        for (const int global : parts->columns.global())
          local_number.push_back(partitioner->global_to_local(global));
        factors = 1.;
        if (scale)
          std::copy(scale->Values(), scale->Values() + scale->MyLength(), factors.begin());
        factors.update_ghost_values();
      }

      std::size_t
      n_blocks() const override
      {
        const BlockPattern &pattern = stiffness.couplings();
        return (pattern.column.size() + pattern.mirrors().blocks.size()) * 11 / 10;
      }

      const RowOfBlocks<Block> &
      read(const unsigned int node) override
      {
        present.clear();
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
                Block &to = present.at(static_cast<int>(local_number[dim * row.columns[k]] / dim));
                for (unsigned int d = 0; d < dim; ++d)
                  for (unsigned int c = 0; c < dim && !replaced[d]; ++c)
                    to[dim * d + c] = row.blocks[k][dim * c + d];
              }
          }
        // What replaces others is for unknowns and equations that are scaled; the others have
        // none of these.
        for (unsigned int d = 0; d < dim && any; ++d)
          if (replaced[d])
            for (const auto &[column, value] : *replaced[d])
              {
                const unsigned int j = local_number[column];
                present.at(static_cast<int>(j / dim))[dim * d + j % dim] +=
                  value * factors.local_element(dim * node + d) * factors.local_element(j);
              }
        return present;
      }

    private:
      const Matrix                                      &stiffness;
      Matrix::Rows                                       matrix_rows;
      std::unique_ptr<Parts>                             parts;
      dealii::LinearAlgebra::distributed::Vector<double> factors;
      /** Of each column of the parts. */
      std::vector<unsigned int> local_number;
    };
  } // namespace



  CondensedSystem::CondensedSystem(const LinearSystem &system, const bool applied)
    : symmetric(system.symmetric)
    , definite(system.definite)
    , tolerance(system.tolerance)
    , system(system)
    , row_map(unknowns(system))
  {
    constrained.resize(row_map.NumMyElements());
    changed.resize(row_map.NumMyElements());
    for (unsigned int i = 0; i < dim * system.stiffness->n_nodes(); ++i)
      {
        constrained[i] = system.constraints.is_constrained(row_map.GID(i));
        changed[i]     = !constrained[i] && system.basis_change.is_constrained(row_map.GID(i));
      }
    make_scale();
    if (applied)
      {
        factors = std::make_shared<AppliedOperator>(system, row_map, constrained, scale.get());
        rhs     = factors->right_hand_side();
        return;
      }
    std::vector<double> values;
    assembled = assemble(&values);
    rhs       = std::make_unique<Epetra_Vector>(Copy, row_map, values.data());
    if (scale)
      rhs->Multiply(1., *scale, *rhs, 0.);
  }



  Epetra_Operator &
  CondensedSystem::product() const
  {
    return factors ? static_cast<Epetra_Operator &>(*factors) : *assembled;
  }



  void
  CondensedSystem::expand(const Epetra_Vector &solution, Vector &displacement) const
  {
    Epetra_Vector all(solution);
    if (factors)
      {
        Epetra_Vector scaled(solution);
        if (scale)
          scaled.ReciprocalMultiply(1., *scale, solution, 0.);
        factors->expand(scaled, all);
      }
    std::copy(all.Values(), all.Values() + displacement.locally_owned_size(), displacement.begin());
    if (!factors)
      system.expand(displacement);
  }



  std::shared_ptr<Epetra_CrsMatrix>
  CondensedSystem::matrix() const
  {
    return assembled ? assembled : assemble(nullptr);
  }



  std::unique_ptr<BlockRows>
  CondensedSystem::block_rows() const
  {
    if (assembled)
      return std::make_unique<MatrixRows>(*assembled);
    return std::make_unique<CondensedRows>(*system.stiffness,
                                           row_map,
                                           scale.get(),
                                           std::make_unique<CondensedRows::Parts>(system, row_map));
  }



  std::shared_ptr<Epetra_CrsMatrix>
  CondensedSystem::assemble(std::vector<double> *values) const
  {
    const Matrix &stiffness = *system.stiffness;
    LocalNumbers  columns(stiffness.columns());
    Condensation  condensation(system, row_map, columns);
    if (values)
      values->swap(condensation.values);

    Matrix::Rows        matrix_rows(stiffness);
    std::vector<int>    lengths(row_map.NumMyElements());
    const BlockPattern &pattern = stiffness.couplings();
    for (unsigned int i = 0; i < lengths.size(); ++i)
      if (const SparseRow *row = condensation.row(i))
        lengths[i] = static_cast<int>(row->size());
      else
        lengths[i] = static_cast<int>(dim * pattern.row_length(i / dim));

    const Epetra_Map column_map(
      -1, static_cast<int>(columns.global().size()), columns.global().data(), 0, row_map.Comm());
    auto matrix =
      std::make_shared<Epetra_CrsMatrix>(Copy, row_map, column_map, lengths.data(), true);
    std::vector<int>    places;
    std::vector<double> entries;
    for (unsigned int i = 0; i < lengths.size(); ++i)
      {
        places.clear();
        entries.clear();
        if (const SparseRow *row = condensation.row(i))
          for (const auto &[place, value] : *row)
            {
              places.push_back(place);
              entries.push_back(value);
            }
        else
          {
            const Matrix::Rows::Row &of_node = matrix_rows.read(i / dim);
            for (std::size_t k = 0; k < of_node.columns.size(); ++k)
              for (unsigned int c = 0; c < dim; ++c)
                {
                  places.push_back(static_cast<int>(dim * of_node.columns[k] + c));
                  entries.push_back(of_node.blocks[k][dim * c + i % dim]);
                }
          }
        const int error = matrix->InsertMyValues(i, lengths[i], entries.data(), places.data());
        AssertThrow(error == 0, dealii::ExcMessage("A row does not fit into the matrix."));
      }
    matrix->FillComplete(row_map, row_map);
    if (scale)
      {
        matrix->LeftScale(*scale);
        matrix->RightScale(*scale);
      }
    return matrix;
  }



  void
  CondensedSystem::make_scale()
  {
    int any = 0, here = std::count(changed.begin(), changed.end(), 1) > 0;
    row_map.Comm().MaxAll(&here, &any, 1);
    if (any == 0)
      return;
    // Any number would do: what constraints add to the entry of the diagonal is left out.
    Vector springs(system.rhs.locally_owned_elements(), system.rhs.get_mpi_communicator());
    std::map<Index, double> sums;
    std::map<Index, double> left, right;
    for (const RankOneTerm &term : system.terms)
      {
        left.clear();
        right.clear();
        for (const auto &[row, value] : term.left)
          if (system.basis_change.is_constrained(row))
            left[row] += value;
        if (left.empty())
          continue;
        for (const auto &[column, value] : term.right)
          if (left.count(column) > 0)
            right[column] += value;
        for (const auto &[i, value] : right)
          sums[i] += left[i] * value;
      }
    for (const auto &[i, value] : sums)
      springs(i) += value;
    springs.compress(dealii::VectorOperation::add);
    if (system.diagonal_shift.size() > 0)
      springs += system.diagonal_shift;

    scale = std::make_unique<Epetra_Vector>(row_map);
    scale->PutScalar(1.);
    for (unsigned int i = 0; i < dim * system.stiffness->n_nodes(); ++i)
      if (const double spring = springs.begin()[i]; changed[i] && spring > 0.)
        {
          const double own = system.stiffness->diagonal(i);
          (*scale)[i]      = own / (own + spring);
        }
  }
} // namespace Touchstone
