#include <touchstone/algebra/aggregation.h>
#include <touchstone/algebra/multigrid.h>

#include <algorithm>
#include <ml_agg_user.h>
#include <ml_utils.h>

namespace Touchstone
{
  namespace
  {
    /** Degree of the polynomials, largest over smallest eigenvalue that they smooth, and
     * what an estimate of the largest may be short of. */
    constexpr int    degree = 3;
    constexpr double range = 20., margin = 1.1;

    /** Of the nodes of the level that ML coarsens next: it asks for aggregates by a
     * function without context. */
    std::vector<unsigned int> body_of_node;

    char *
    aggregation_label()
    {
      static char label[] = "aggregates within bodies";
      return label;
    }

    /** The signature is that of ML. @return the number of aggregates */
    int
    aggregation(ML_Operator *matrix,
                char        *constrained,
                double,
                double *,
                double *,
                double *,
                int *place,
                int *n_entries)
    {
      const int                     n_nodes = static_cast<int>(body_of_node.size());
      std::vector<std::vector<int>> graph(n_nodes);
      int                           space = 128, n = 0;
      int                          *column = static_cast<int *>(ML_allocate(space * sizeof(int)));
      double *value = static_cast<double *>(ML_allocate(space * sizeof(double)));
      *n_entries    = 0;
      for (int i = 0; i < n_nodes; ++i)
        {
          ML_get_matrix_row(matrix, 1, &i, &space, &column, &value, &n, 0);
          *n_entries += n;
          // Nodes of other ranks have numbers beyond those of this one.
          for (int k = 0; k < n; ++k)
            if (column[k] != i && column[k] < n_nodes)
              graph[i].push_back(column[k]);
        }
      ML_free(column);
      ML_free(value);

      const Aggregates          aggregates = aggregate(std::move(graph), body_of_node);
      std::vector<unsigned int> body(aggregates.n);
      for (int i = 0; i < n_nodes; ++i)
        {
          place[i]       = aggregates.of_node[i];
          constrained[i] = 'F';
          if (place[i] >= 0)
            body[place[i]] = body_of_node[i];
        }
      body_of_node = body;
      return aggregates.n;
    }
  } // namespace



  Multigrid::Multigrid(const Epetra_CrsMatrix          &matrix,
                       const Epetra_MultiVector        &near_kernel,
                       const std::vector<unsigned int> &body,
                       const bool                       coarse_levels)
    : matrix(matrix)
    , near_kernel(near_kernel)
  {
    const int              n = matrix.NumMyRows();
    Teuchos::ParameterList list;
    ML_Epetra::SetDefaults("SA", list);
    list.set("ML output", 0);
    list.set("low memory usage", true);
    list.set("PDE equations", static_cast<int>(dim));
    // Aggregates of the user need levels counted from the coarsest one.
    list.set("increasing or decreasing", "decreasing");
    list.set("aggregation: type", "user");
    list.set("aggregation: threshold", 0.003);
    list.set("smoother: type", "Chebyshev");
    list.set("smoother: sweeps", degree);
    list.set("smoother: Chebyshev alpha", range);
    list.set("coarse: type", "Amesos-KLU");
    list.set("coarse: max size", 1000);
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", near_kernel.NumVectors());
    list.set("null space: vectors", this->near_kernel.Values());
    list.set("null space: add default vectors", false);
    if (coarse_levels)
      list.set("smoother: type (level 0)", "do-nothing");
    else
      {
        list.set("max levels", 1);
        list.set("coarse: type", "symmetric Gauss-Seidel");
        list.set("coarse: sweeps", 1);
      }
    body_of_node.resize(n / dim);
    for (unsigned int node = 0; node < body_of_node.size(); ++node)
      body_of_node[node] = body[dim * node];
    ML_SetUserLabel(aggregation_label);
    ML_SetUserPartitions(aggregation);
    // Largest eigenvalues are estimated from a random vector: the same one each time, or
    // a run would depend on how many set-ups were before.
    ML_random_init();
    hierarchy = std::make_unique<ML_Epetra::MultiLevelPreconditioner>(matrix, list, true);
    if (!coarse_levels)
      return;

    const ML_1Level &fine = finest();
    if (fine.Rmat->to == nullptr)
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



  ML_1Level &
  Multigrid::finest() const
  {
    const ML *ml = hierarchy->GetML();
    return ml->SingleLevel[ml->ML_finest_level];
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
    ML        *ml   = const_cast<ML *>(hierarchy->GetML());
    ML_1Level &fine = finest();
    const int  n    = static_cast<int>(residual.size());
    const int  m    = static_cast<int>(coarse_rhs.size());

    std::copy(rhs, rhs + n, fine_rhs.begin());
    smoother->vmult(fine_solution, fine_rhs);
    fine_matrix->vmult(fine_residual, fine_solution);
    fine_residual.sadd(-1.f, 1.f, fine_rhs);

    std::copy(fine_residual.begin(), fine_residual.begin() + n, residual.begin());
    ML_Operator_Apply(fine.Rmat, n, residual.data(), m, coarse_rhs.data());
    std::fill(coarse_solution.begin(), coarse_solution.end(), 0.);
    ML_1Level *coarse = fine.Rmat->to;
    ML_Cycle_MG(
      coarse, coarse_solution.data(), coarse_rhs.data(), ML_ZERO, ml->comm, ML_NO_RES_NORM, ml);
    ML_Operator_Apply(coarse->Pmat, m, coarse_solution.data(), n, correction.data());
    for (int i = 0; i < n; ++i)
      fine_solution.local_element(i) += static_cast<float>(correction[i]);

    smoother->step(fine_solution, fine_rhs);
    std::copy(fine_solution.begin(), fine_solution.begin() + n, result);
  }
} // namespace Touchstone
