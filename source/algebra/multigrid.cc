#include <touchstone/algebra/multigrid.h>

#include <algorithm>
#include <ml_utils.h>

namespace Touchstone
{
  namespace
  {
    /** Degree of the polynomials, largest over smallest eigenvalue that they smooth, and
     * what an estimate of the largest may be short of. */
    constexpr int    degree = 3;
    constexpr double range = 20., margin = 1.1;
  } // namespace



  Multigrid::Multigrid(const Epetra_CrsMatrix &matrix,
                       std::vector<double>     vectors,
                       const bool              coarse_spaces)
    : matrix(matrix)
    , near_kernel(std::move(vectors))
  {
    const int n = matrix.NumMyRows();
    int       n_vectors = n > 0 ? static_cast<int>(near_kernel.size() / n) : 0, most = 0;
    matrix.Comm().MaxAll(&n_vectors, &most, 1);

    Teuchos::ParameterList list;
    ML_Epetra::SetDefaults("SA", list);
    list.set("ML output", 0);
    list.set("low memory usage", true);
    list.set("PDE equations", static_cast<int>(dim));
    list.set("aggregation: type", "Uncoupled");
    list.set("aggregation: threshold", 0.01);
    list.set("smoother: type", "Chebyshev");
    list.set("smoother: sweeps", degree);
    list.set("smoother: Chebyshev alpha", range);
    list.set("coarse: type", "Amesos-KLU");
    list.set("coarse: max size", 1000);
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", most);
    list.set("null space: vectors", near_kernel.data());
    list.set("null space: add default vectors", false);
    if (coarse_spaces)
      list.set("smoother: type (level 0)", "do-nothing");
    else
      {
        list.set("max levels", 1);
        list.set("coarse: type", "symmetric Gauss-Seidel");
        list.set("coarse: sweeps", 1);
      }
    // Largest eigenvalues are estimated from a random vector: the same one each time, or
    // a run would depend on how many set-ups were before.
    ML_random_init();
    hierarchy = std::make_unique<ML_Epetra::MultiLevelPreconditioner>(matrix, list, true);

    const ML_1Level &fine = hierarchy->GetML()->SingleLevel[0];
    if (!coarse_spaces || fine.Rmat->to == nullptr)
      return;
    fine_matrix = std::make_unique<BlockMatrix>(matrix);
    Chebyshev::AdditionalData data(degree, range, 0, 0., margin * fine.Amat->lambda_max);
    data.preconditioner =
      std::make_shared<dealii::DiagonalMatrix<VectorType>>(fine_matrix->inverse_diagonal());
    smoother = std::make_unique<Chebyshev>();
    smoother->initialize(*fine_matrix, data);
    for (VectorType *vector : {&fine_rhs, &fine_solution, &fine_residual})
      fine_matrix->initialize_vector(*vector);
    residual.resize(n);
    correction.resize(n);
    coarse_rhs.resize(fine.Rmat->outvec_leng);
    coarse_solution.resize(fine.Rmat->outvec_leng);
  }



  int
  Multigrid::ApplyInverse(const Epetra_MultiVector &rhs, Epetra_MultiVector &result) const
  {
    if (!smoother)
      return hierarchy->ApplyInverse(rhs, result);
    // Krylov methods may pass the same vector for both.
    for (int v = 0; v < rhs.NumVectors(); ++v)
      cycle(rhs[v], result[v]);
    return 0;
  }



  void
  Multigrid::cycle(const double *rhs, double *result) const
  {
    ML             *ml   = const_cast<ML *>(hierarchy->GetML());
    ML_1Level      &fine = ml->SingleLevel[0];
    const int       n    = static_cast<int>(residual.size());
    const int       m    = static_cast<int>(coarse_rhs.size());

    std::copy(rhs, rhs + n, fine_rhs.begin());
    smoother->vmult(fine_solution, fine_rhs);
    fine_matrix->vmult(fine_residual, fine_solution);
    fine_residual.sadd(-1.f, 1.f, fine_rhs);

    std::copy(fine_residual.begin(), fine_residual.begin() + n, residual.begin());
    ML_Operator_Apply(fine.Rmat, n, residual.data(), m, coarse_rhs.data());
    std::fill(coarse_solution.begin(), coarse_solution.end(), 0.);
    ML_1Level *coarse = fine.Rmat->to;
    ML_Cycle_MG(coarse, coarse_solution.data(), coarse_rhs.data(), ML_ZERO, ml->comm, ML_NO_RES_NORM, ml);
    ML_Operator_Apply(coarse->Pmat, m, coarse_solution.data(), n, correction.data());
    for (int i = 0; i < n; ++i)
      fine_solution.local_element(i) += static_cast<float>(correction[i]);

    smoother->step(fine_solution, fine_rhs);
    std::copy(fine_solution.begin(), fine_solution.begin() + n, result);
  }
} // namespace Touchstone
