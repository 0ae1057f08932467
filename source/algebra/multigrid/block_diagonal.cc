// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/multigrid/block_diagonal.h>
#include <touchstone/algebra/preconditioner.h>
#include <touchstone/base/non_convergence.h>

#include <deal.II/base/tensor.h>

#include <cmath>
#include <string>

// Block Jacobi scaling, the simplest preconditioner that knows nodes, as a yardstick for
// multigrid.
namespace Touchstone
{
  namespace
  {
    // Registered as 'diagonal'. It is not multilevel, so a large number of iterations is expected
    // and no reason to take factors instead (Preconditioner::multilevel()).
    class BlockDiagonalScaling : public Preconditioner
    {
    public:
      std::unique_ptr<Epetra_Operator>
      set_up(const CondensedSystem &system, const RigidMotions &) const override
      {
        return std::make_unique<BlockDiagonal>(system.rows(), *system.block_rows());
      }

      bool
      multilevel() const override
      {
        return false;
      }
    };

    const PreconditionerRegistry::Entry<BlockDiagonalScaling>
      block_diagonal_entry("diagonal",
                           "the inverse 3 x 3 diagonal blocks of the nodes, many times as slow, "
                           "to compare with published work.");
  } // namespace



  // Singular blocks are counted over all ranks before anything is thrown, so that all ranks
  // throw.
  BlockDiagonal::BlockDiagonal(const Epetra_Map &map, BlockRows &rows)
    : SquareOperator(map, "block diagonal")
    , inverse(rows.n_nodes())
  {
    int singular = 0, all = 0;
    for (unsigned int node = 0; node < rows.n_nodes(); ++node)
      {
        const auto                    &row = rows.read(node);
        dealii::Tensor<2, dim, double> block;
        for (std::size_t k = 0; k < row.columns.size(); ++k)
          if (row.columns[k] == static_cast<int>(node))
            for (unsigned int r = 0; r < dim; ++r)
              for (unsigned int c = 0; c < dim; ++c)
                block[r][c] += row.blocks[k][dim * r + c];
        // |det| is compared with the product of the lengths of the rows, its upper bound
        // (Hadamard), since stiffnesses have no natural scale; the comparison is negated so that
        // NaN counts as singular.
        double scale = 1.;
        for (unsigned int r = 0; r < dim; ++r)
          scale *= block[r].norm();
        const double determinant = dealii::determinant(block);
        if (!(std::abs(determinant) > 1e-14 * scale))
          {
            ++singular;
            continue;
          }
        block = dealii::invert(block);
        for (unsigned int r = 0; r < dim; ++r)
          for (unsigned int c = 0; c < dim; ++c)
            inverse[node][dim * r + c] = block[r][c];
      }
    map.Comm().SumAll(&singular, &all, 1);
    if (all > 0)
      throw LinearSolverFailure("the diagonal blocks of " + std::to_string(all) +
                                " node(s) are singular and cannot scale the system");
  }



  int
  BlockDiagonal::ApplyInverse(const Epetra_MultiVector &rhs, Epetra_MultiVector &result) const
  {
    // Krylov methods may pass the same vector for both.
    for (int v = 0; v < rhs.NumVectors(); ++v)
      for (std::size_t node = 0; node < inverse.size(); ++node)
        {
          const double           *in    = rhs[v] + dim * node;
          double                 *out   = result[v] + dim * node;
          const BlockRows::Block &block = inverse[node];
          const double            x = in[0], y = in[1], z = in[2];
          for (unsigned int r = 0; r < dim; ++r)
            out[r] = block[dim * r] * x + block[dim * r + 1] * y + block[dim * r + 2] * z;
        }
    return 0;
  }
} // namespace Touchstone
