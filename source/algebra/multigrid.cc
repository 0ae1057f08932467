#include <touchstone/algebra/aggregation.h>
#include <touchstone/algebra/multigrid.h>

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <ml_agg_user.h>
#include <ml_utils.h>

namespace Touchstone
{
  namespace
  {
    /** Degree of the polynomials, and largest over smallest eigenvalue that they smooth. */
    constexpr int    degree = 3;
    constexpr double range  = 20.;

    /** Conjugate gradients that estimate the largest eigenvalue, and what deal.II adds to
     * the estimate. */
    constexpr unsigned int estimate_iterations = 10;
    constexpr double       margin              = 1.2;

    /** Unknowns of a system that is solved directly. */
    constexpr int few = 1000;

    /** What ML is to do with a matrix that has @p n_components unknowns a node. */
    Teuchos::ParameterList
    ml_parameters(const Epetra_MultiVector &near_kernel, const unsigned int n_components)
    {
      Teuchos::ParameterList list;
      ML_Epetra::SetDefaults("SA", list);
      list.set("ML output", 0);
      list.set("low memory usage", true);
      list.set("PDE equations", static_cast<int>(n_components));
      // Aggregates of the user need levels counted from the coarsest one.
      list.set("increasing or decreasing", "decreasing");
      list.set("aggregation: type", "user");
      list.set("aggregation: threshold", weak_coupling);
      list.set("smoother: type", "Chebyshev");
      list.set("smoother: sweeps", degree);
      list.set("smoother: Chebyshev alpha", range);
      list.set("coarse: type", "Amesos-KLU");
      list.set("coarse: max size", few);
      list.set("null space: type", "pre-computed");
      list.set("null space: dimension", near_kernel.NumVectors());
      list.set("null space: vectors", near_kernel.Values());
      list.set("null space: add default vectors", false);
      return list;
    }

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



  Multigrid::Multigrid(std::shared_ptr<Epetra_CrsMatrix> system,
                       const Epetra_MultiVector         &near_kernel,
                       const std::vector<unsigned int>  &body,
                       const bool                        coarse_levels)
    : SquareOperator(system->RowMap(), "smoothed aggregation")
    , matrix(std::move(system))
  {
    std::vector<unsigned int> body_of_nodes(map.NumMyElements() / dim);
    for (unsigned int node = 0; node < body_of_nodes.size(); ++node)
      body_of_nodes[node] = body[dim * node];
    if (coarse_levels && map.NumGlobalElements() > few)
      {
        make_finest_level(near_kernel, body_of_nodes);
        if (prolongation)
          make_hierarchy(ml_parameters(prolongation->coarse_near_kernel(), Prolongation::n_modes),
                         prolongation->coarse_body());
        return;
      }
    // Its rows may be those of the stiffness, which stay where they are.
    if (!matrix->Filled())
      matrix->FillComplete(false);
    Teuchos::ParameterList list = ml_parameters(near_kernel, dim);
    if (!coarse_levels)
      {
        list.set("max levels", 1);
        list.set("coarse: type", "symmetric Gauss-Seidel");
        list.set("coarse: sweeps", 1);
      }
    make_hierarchy(list, body_of_nodes);
  }



  void
  Multigrid::make_finest_level(const Epetra_MultiVector        &near_kernel,
                               const std::vector<unsigned int> &body_of_nodes)
  {
    fine_matrix = std::make_unique<BlockMatrix>(*matrix);
    Chebyshev::AdditionalData data(degree, range, estimate_iterations);
    data.preconditioner =
      std::make_shared<dealii::DiagonalMatrix<VectorType>>(fine_matrix->inverse_diagonal());
    smoother = std::make_unique<Chebyshev>();
    smoother->initialize(*fine_matrix, data);
    for (VectorType *vector : {&fine_rhs, &fine_solution, &fine_residual})
      fine_matrix->initialize_vector(*vector);
    const double largest = smoother->estimate_eigenvalues(fine_rhs).max_eigenvalue_estimate;

    prolongation =
      std::make_unique<Prolongation>(*fine_matrix, near_kernel, body_of_nodes, largest / margin);
    // Where nothing is coupled, smoothing is all.
    if (prolongation->coarse_near_kernel().GlobalLength() == 0)
      {
        prolongation.reset();
        return;
      }
    matrix = prolongation->galerkin(*matrix);
    prolongation->initialize_coarse_vector(coarse_values);
    coarse_rhs      = std::make_unique<Epetra_Vector>(matrix->RowMap());
    coarse_solution = std::make_unique<Epetra_Vector>(matrix->RowMap());
  }



  void
  Multigrid::make_hierarchy(const Teuchos::ParameterList    &list,
                            const std::vector<unsigned int> &body)
  {
    body_of_node = body;
    ML_SetUserLabel(aggregation_label);
    ML_SetUserPartitions(aggregation);
    // Largest eigenvalues are estimated from a random vector: the same one each time, or
    // a run would depend on how many set-ups were before.
    ML_random_init();
    hierarchy = std::make_unique<ML_Epetra::MultiLevelPreconditioner>(*matrix, list, true);
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
    const int n = map.NumMyElements();
    std::copy(rhs, rhs + n, fine_rhs.begin());
    smoother->vmult(fine_solution, fine_rhs);
    if (prolongation)
      {
        fine_matrix->vmult(fine_residual, fine_solution);
        fine_residual.sadd(-1.f, 1.f, fine_rhs);
        prolongation->restrict_to(coarse_values, fine_residual);
        const int m = coarse_rhs->MyLength();
        std::copy(coarse_values.begin(), coarse_values.begin() + m, coarse_rhs->Values());
        hierarchy->ApplyInverse(*coarse_rhs, *coarse_solution);
        std::copy(coarse_solution->Values(), coarse_solution->Values() + m, coarse_values.begin());
        prolongation->prolongate_and_add(fine_solution, coarse_values);
      }
    smoother->step(fine_solution, fine_rhs);
    std::copy(fine_solution.begin(), fine_solution.begin() + n, result);
  }
} // namespace Touchstone
