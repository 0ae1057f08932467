// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/multigrid/aggregation.h>
#include <touchstone/algebra/multigrid/fewer_ranks.h>
#include <touchstone/algebra/multigrid/prolongation.h>
#include <touchstone/algebra/multigrid/row_of_blocks.h>
#include <touchstone/base/free_memory.h>
#include <touchstone/base/vectorised.h>

#include <Epetra_Import.h>
#include <Epetra_IntVector.h>
#include <algorithm>
#include <cmath>

// The prolongation of smoothed aggregation, P = (1 - omega D^-1 A) P_0 (doc/theory.md, section
// 8). P_0 has the rigid motions of each aggregate as orthonormal columns and thus interpolates
// rigid motions of bodies exactly; one step of Jacobi's method lowers the energy of the columns
// at the edges of aggregates, where they jump to zero.
namespace Touchstone
{
  using namespace dealii;
  using Utilities::MPI::Partitioner;

  namespace
  {
    using Modes = std::array<double, Prolongation::n_modes>;
    /** Square, by rows. */
    using Factor = std::array<double, Prolongation::n_modes * Prolongation::n_modes>;

    /**
     * The groups of nodes of this rank to which each group is strongly coupled: |a_ij| >
     * weak_coupling sqrt(a_ii a_jj) for any pair of their dofs. Along weak couplings, such as
     * the long edges of flat cells, an error need not be smooth after smoothing, and an aggregate
     * could not represent it.
     */
    std::vector<std::vector<int>>
    couplings(BlockMatrix<float>::Rows &matrix,
              const std::vector<float> &diagonal,
              const unsigned int        group)
    {
      const unsigned int            n_nodes = diagonal.size() / dim;
      std::vector<std::vector<int>> graph(n_nodes / group);
      for (unsigned int node = 0; node < n_nodes; ++node)
        {
          const BlockMatrix<float>::Rows::Row &row = matrix.read(node);
          // What lists leave behind as they grow would take as much memory as they do.
          if (group == 1)
            graph[node].reserve(row.columns.size());
          for (unsigned int k = 0; k < row.columns.size(); ++k)
            {
              const unsigned int other = row.columns[k];
              if (other / group == node / group || other >= n_nodes)
                continue;
              bool strong = false;
              for (unsigned int r = 0; r < dim; ++r)
                for (unsigned int c = 0; c < dim; ++c)
                  {
                    // Stiffness squared leaves the range of single precision.
                    const double entry = row.blocks[k][dim * c + r];
                    strong             = strong || entry * entry > weak_coupling * weak_coupling *
                                                         double(diagonal[dim * node + r]) *
                                                         diagonal[dim * other + c];
                  }
              if (strong)
                graph[node / group].push_back(static_cast<int>(other / group));
            }
        }
      if (group > 1)
        for (auto &neighbours : graph)
          {
            std::sort(neighbours.begin(), neighbours.end());
            neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
          }
      return graph;
    }

    /**
     * QR factorisation of the motions of an aggregate by Gram-Schmidt: orthonormal columns in
     * place, and the factor R, which gives the rigid motions on the coarse level. Columns that
     * depend on those before them, as rotations of a single node do, become zero.
     */
    Factor
    orthonormalise(std::vector<Modes> &q)
    {
      constexpr unsigned int n = Prolongation::n_modes;
      Factor                 factor{};
      const auto             product = [&](const unsigned int a, const unsigned int b) {
        double sum = 0.;
        for (const Modes &row : q)
          sum += row[a] * row[b];
        return sum;
      };
      for (unsigned int b = 0; b < n; ++b)
        {
          const double length = std::sqrt(product(b, b));
          // Twice is enough: once leaves what round-off makes of nearly parallel columns.
          for (unsigned int sweep = 0; sweep < 2; ++sweep)
            for (unsigned int a = 0; a < b; ++a)
              {
                const double along = product(a, b);
                factor[n * a + b] += along;
                for (Modes &row : q)
                  row[b] -= along * row[a];
              }
          const double rest        = std::sqrt(product(b, b));
          const bool   independent = rest > 1e-10 * length;
          factor[n * b + b]        = independent ? rest : 0.;
          for (Modes &row : q)
            row[b] = independent ? row[b] / rest : 0.;
        }
      return factor;
    }

    using GhostedVector = LinearAlgebra::distributed::Vector<double>;

    /**
     * Give @p vector the @p value(i) of each dof i of this rank, and those of ghosts.
     */
    template <class Value>
    void
    fill_with_ghosts(GhostedVector &vector, const Value &value)
    {
      vector.zero_out_ghost_values();
      for (unsigned int i = 0; i < vector.locally_owned_size(); ++i)
        vector.local_element(i) = value(i);
      vector.update_ghost_values();
    }

    /**
     * row += (1 - damping A) P_0 for one node, with damping = omega D^-1: the motion of its own
     * aggregate, if it is in one, less the forces that the motions of its own and neighbouring
     * nodes cause.
     */
    TOUCHSTONE_VECTORISED void
    add_smoothed(const BlockMatrix<float>::Rows::Row &of_matrix,
                 const unsigned int                   node,
                 const std::array<double, dim>       &damping,
                 const std::vector<int>              &column_of,
                 const std::vector<float>            &tentative,
                 RowOfBlocks<NodeRows>               &row)
    {
      constexpr unsigned int block = dim * Prolongation::n_modes;
      if (column_of[node] >= 0)
        {
          const BlockRows::Block one = {{1., 0., 0., 0., 1., 0., 0., 0., 1.}};
          add_product(one, tentative.data() + block * node, row.at(column_of[node]));
        }
      for (std::size_t k = 0; k < of_matrix.columns.size(); ++k)
        if (const unsigned int other = of_matrix.columns[k]; column_of[other] >= 0)
          {
            BlockRows::Block a;
            for (unsigned int r = 0; r < dim; ++r)
              for (unsigned int c = 0; c < dim; ++c)
                a[dim * r + c] = -damping[r] * of_matrix.blocks[k][dim * c + r];
            add_product(a, tentative.data() + block * other, row.at(column_of[other]));
          }
    }

    /**
     * Marks nodes that belong to no aggregate: those without strong couplings, such as
     * constrained ones. Their rows of P have entries of neighbouring aggregates only.
     */
    constexpr double no_aggregate = -1.;
  } // namespace



  // What is not needed any more is freed before the entries of P are made, for then most is stored.
  Prolongation::Prolongation(const BlockMatrix<float>        &matrix,
                             const NearKernel                &near_kernel,
                             const std::vector<unsigned int> &body,
                             const unsigned int               group,
                             const double                     largest)
    : fine(matrix.vector_partitioner())
  {
    std::vector<float> diagonal(dim * matrix.n_nodes());
    {
      const VectorType inverse = matrix.inverse_diagonal();
      for (unsigned int i = 0; i < diagonal.size(); ++i)
        diagonal[i] = 1.f / inverse.local_element(i);
    }
    BlockMatrix<float>::Rows rows(matrix);
    Tentative                tentative;
    {
      const Aggregates aggregates = aggregate(couplings(rows, diagonal, group), body);
      std::vector<std::vector<unsigned int>> nodes(aggregates.n);
      for (unsigned int node = 0; node < matrix.n_nodes(); ++node)
        if (aggregates.of_node[node / group] >= 0)
          nodes[aggregates.of_node[node / group]].push_back(node);
      body_of_aggregate.resize(aggregates.n);
      for (int a = 0; a < aggregates.n; ++a)
        body_of_aggregate[a] = body[nodes[a].front() / group];
      give_back_free_memory();
      tentative = restrict_to_aggregates(*near_kernel(), nodes);
    }
    give_back_free_memory();
    // Nothing is coupled, on any rank.
    if (coarse_kernel->GlobalLength() == 0)
      return;
    move_to_fewer_ranks();
    exchange(tentative);
    smooth(rows, diagonal, tentative, 4. / 3. / largest);
  }



  // P_0: the near-kernel restricted to the nodes of each aggregate, orthonormal by QR. Q are the
  // blocks of P_0; R are the values of the
  // near-kernel on the coarse level, so that P_0 R reproduces it exactly there.
  Prolongation::Tentative
  Prolongation::restrict_to_aggregates(const Epetra_MultiVector                     &near_kernel,
                                       const std::vector<std::vector<unsigned int>> &nodes)
  {
    const unsigned int n_nodes = fine->locally_owned_size() / dim,
                       n_given = near_kernel.NumVectors();
    const Epetra_Map coarse_map(-1,
                                static_cast<int>(nodes.size() * n_modes),
                                0,
                                near_kernel.Comm());
    const auto       kernel = std::make_shared<Epetra_MultiVector>(coarse_map, n_modes);
    coarse_kernel           = kernel;
    Tentative result{coarse_map.NumMyElements() > 0
                       ? static_cast<Index>(coarse_map.MinMyGID()) / n_modes
                       : 0,
                     std::vector<int>(n_nodes, -1),
                     std::vector<float>(block * n_nodes)};
    std::vector<Modes> q;
    for (std::size_t a = 0; a < nodes.size(); ++a)
      {
        q.assign(dim * nodes[a].size(), Modes());
        for (unsigned int k = 0; k < q.size(); ++k)
          for (unsigned int m = 0; m < n_given; ++m)
            q[k][m] = near_kernel[m][dim * nodes[a][k / dim] + k % dim];
        const Factor factor = orthonormalise(q);
        for (unsigned int k = 0; k < q.size(); ++k)
          {
            const unsigned int node = nodes[a][k / dim];
            result.aggregate[node]  = static_cast<int>(a);
            for (unsigned int m = 0; m < n_modes; ++m)
              result.blocks[block * node + n_modes * (k % dim) + m] = static_cast<float>(q[k][m]);
          }
        for (unsigned int m = 0; m < n_modes; ++m)
          for (unsigned int i = 0; i < n_modes; ++i)
            (*kernel)[m][n_modes * a + i] = factor[n_modes * i + m];
      }
    return result;
  }



  // Numbers stay as they are, and so do the aggregates, whose nodes may then belong to other ranks
  // than they do.
  void
  Prolongation::move_to_fewer_ranks()
  {
    const Epetra_BlockMap before = coarse_kernel->Map(), after = on_fewer_ranks(before);
    if (after.SameAs(before))
      return;
    const Epetra_Import import(after, before);
    const auto          kernel = std::make_shared<Epetra_MultiVector>(after, n_modes);
    kernel->Import(*coarse_kernel, import, Insert);
    Epetra_IntVector bodies_before(before), bodies(after);
    for (int i = 0; i < before.NumMyElements(); ++i)
      bodies_before[i] = static_cast<int>(body_of_aggregate[i / n_modes]);
    bodies.Import(bodies_before, import, Insert);
    coarse_kernel = kernel;
    body_of_aggregate.resize(after.NumMyElements() / n_modes);
    for (unsigned int a = 0; a < body_of_aggregate.size(); ++a)
      body_of_aggregate[a] = bodies[static_cast<int>(n_modes * a)];
  }



  // Aggregates and motions of ghost nodes, exchanged as vectors over the dofs, one after the other:
  // the number of an aggregate travels as a double, which is exact. Aggregates met there, and those
  // of this rank's nodes that have moved to others, are the ghosts of the coarse level.
  void
  Prolongation::exchange(Tentative &tentative)
  {
    const Epetra_BlockMap &map    = coarse_kernel->Map();
    const unsigned int     n_dofs = fine->locally_owned_size(),
                       n_local    = n_dofs + fine->n_ghost_indices();
    GhostedVector values(fine);
    fill_with_ghosts(values, [&](const unsigned int i) {
      const int aggregate = tentative.aggregate[i / dim];
      return aggregate < 0 ? no_aggregate : static_cast<double>(tentative.first + aggregate);
    });
    IndexSet owned(map.NumGlobalElements()), ghosts(map.NumGlobalElements());
    if (map.NumMyElements() > 0)
      owned.add_range(map.MinMyGID(), map.MinMyGID() + map.NumMyElements());
    std::vector<Index> far;
    for (unsigned int i = 0; i < n_local; i += dim)
      if (const double aggregate = values.local_element(i); aggregate != no_aggregate)
        if (const Index a = static_cast<Index>(aggregate); !owned.is_element(n_modes * a))
          far.push_back(a);
    std::sort(far.begin(), far.end());
    far.erase(std::unique(far.begin(), far.end()), far.end());
    for (const Index a : far)
      ghosts.add_range(n_modes * a, n_modes * (a + 1));
    coarse = std::make_shared<Partitioner>(owned, ghosts, fine->get_mpi_communicator());
    tentative.aggregate.resize(n_local / dim);
    for (unsigned int i = 0; i < n_local; i += dim)
      {
        const double aggregate = values.local_element(i);
        tentative.aggregate[i / dim] =
          aggregate == no_aggregate
            ? -1
            : static_cast<int>(coarse->global_to_local(n_modes * static_cast<Index>(aggregate)) /
                               n_modes);
      }

    const bool          several = map.Comm().NumProc() > 1;
    std::vector<float> &blocks  = tentative.blocks;
    blocks.resize(block * tentative.aggregate.size() + 2);
    for (unsigned int m = 0; m < n_modes && several; ++m)
      {
        fill_with_ghosts(values,
                         [&](const unsigned int i) { return double(blocks[n_modes * i + m]); });
        for (unsigned int i = n_dofs; i < n_local; ++i)
          if (tentative.aggregate[i / dim] >= 0)
            blocks[n_modes * i + m] = static_cast<float>(values.local_element(i));
      }
  }



  // P = (1 - omega D^-1 A) P_0. omega = 4/3 over the largest eigenvalue of D^-1 A minimises the
  // bound of the energy of the smoothed motions (Vanek, Mandel and Brezina 1996).
  void
  Prolongation::smooth(BlockMatrix<float>::Rows &rows,
                       const std::vector<float> &diagonal,
                       const Tentative          &tentative,
                       const double              omega)
  {
    const unsigned int    n_nodes = diagonal.size() / dim;
    RowOfBlocks<NodeRows> row;
    start.push_back(0);
    // More than eight aggregates in a row of P are rare; memory that is reserved and not touched
    // costs address space only.
    constexpr std::size_t enough = 8;
    column.reserve(enough * n_nodes);
    entries.reserve(block * enough * n_nodes + 2);
    for (unsigned int node = 0; node < n_nodes; ++node)
      {
        std::array<double, dim> damping;
        for (unsigned int r = 0; r < dim; ++r)
          damping[r] = omega / diagonal[dim * node + r];
        row.clear();
        add_smoothed(rows.read(node), node, damping, tentative.aggregate, tentative.blocks, row);
        for (unsigned int k = 0; k < row.columns.size(); ++k)
          {
            column.push_back(row.columns[k]);
            for (unsigned int r = 0; r < dim; ++r)
              for (unsigned int m = 0; m < n_modes; ++m)
                entries.push_back(static_cast<float>(row.blocks[k][r][m]));
          }
        start.push_back(column.size());
      }
    entries.resize(entries.size() + 2);
  }



  // Rows of own nodes only, so values of ghosts are needed at the coarse level and none are
  // written.
  void
  Prolongation::prolongate_and_add(VectorType &to, const VectorType &from) const
  {
    from.update_ghost_values();
    const float       *in      = from.begin();
    float             *out     = to.begin();
    const unsigned int n_nodes = start.size() - 1;
    for (unsigned int node = 0; node < n_nodes; ++node)
      for (std::size_t b = start[node]; b < start[node + 1]; ++b)
        {
          const float *p = entries.data() + block * b;
          const float *x = in + n_modes * column[b];
          for (unsigned int r = 0; r < dim; ++r, p += n_modes)
            out[dim * node + r] +=
              (p[0] * x[0] + p[1] * x[1] + p[2] * x[2]) + (p[3] * x[3] + p[4] * x[4] + p[5] * x[5]);
        }
    from.zero_out_ghost_values();
  }



  // The exact transpose, or the cycle would not be symmetric: sums for aggregates of other ranks
  // are collected in the ghosts, and compress() adds them where they belong.
  void
  Prolongation::restrict_to(VectorType &to, const VectorType &from) const
  {
    to                         = 0.f;
    const float       *in      = from.begin();
    float             *out     = to.begin();
    const unsigned int n_nodes = start.size() - 1;
    for (unsigned int node = 0; node < n_nodes; ++node)
      for (std::size_t b = start[node]; b < start[node + 1]; ++b)
        for (unsigned int r = 0; r < dim; ++r)
          for (unsigned int m = 0; m < n_modes; ++m)
            out[n_modes * column[b] + m] +=
              entries[block * b + n_modes * r + m] * in[dim * node + r];
    to.compress(VectorOperation::add);
  }
} // namespace Touchstone
