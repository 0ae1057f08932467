// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/stress_recovery.h>

#include <deal.II/base/mpi.h>

#include <cmath>

/**
 * @file
 * Linear fits to the stresses of the cells around a vertex (doc/theory.md 11, "Recovered stress").
 * The means of the cells are of second order, and so are the fits where cells lie on both sides of
 * the vertex. A fit is made in those directions only in which they do; a vertex whose neighbours
 * have more of them, as at boundaries, takes the fits of these.
 */
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A number of values for each vertex, with ghosts. */
    class VertexValues
    {
    public:
      VertexValues(const DoFHandler<dim> &vertices, const IndexSet &relevant, const unsigned int n)
        : n(n)
        , all(several(vertices.locally_owned_dofs()),
              several(relevant),
              vertices.get_communicator())
      {
      }

      double &
      operator()(const Index vertex, const unsigned int k)
      {
        return all(vertex * n + k);
      }
      double
      operator()(const Index vertex, const unsigned int k) const
      {
        return all(vertex * n + k);
      }

      /** Sum what ranks have added. Collective. */
      void
      add_up()
      {
        all.compress(VectorOperation::add);
      }

      /** Collective. */
      void
      share()
      {
        all.update_ghost_values();
      }

    private:
      const unsigned int                         n;
      LinearAlgebra::distributed::Vector<double> all;

      IndexSet
      several(const IndexSet &set) const
      {
        IndexSet result(set.size() * n);
        for (auto interval = set.begin_intervals(); interval != set.end_intervals(); ++interval)
          result.add_range(*interval->begin() * n, (interval->last() + 1) * n);
        result.compress();
        return result;
      }
    };

    /** The sums over the cells around a vertex, by the place of the first of each: number; d, from
     * the vertex to the centre; d d^T; G, the second moment of a cell by its vertices; sigma;
     * sigma d. */
    enum Sums : unsigned int
    {
      number   = 0,
      distance = 1,
      squares  = distance + dim,
      extent   = squares + dim * dim,
      means    = extent + dim * dim,
      moments  = means + StressRecovery::n_components,
      n_sums   = moments + StressRecovery::n_components * dim,
      /** Of a linear field: its values at the vertex, its slopes, and the number of directions in
       * which it was fitted, less 4 as long as there is none. */
      slopes     = StressRecovery::n_components,
      directions = slopes + StressRecovery::n_components * dim,
      n_of_field = directions + 1
    };

    using Cell = DoFHandler<dim>::active_cell_iterator;

    void
    add_cell(const Cell                    &cell,
             const Point<dim>              &centre,
             const SymmetricTensor<2, dim> &stress,
             VertexValues                  &sums)
    {
      Tensor<2, dim> second;
      for (const unsigned int v : cell->vertex_indices())
        second += outer_product(cell->vertex(v) - centre, cell->vertex(v) - centre) / 8.;
      for (const unsigned int v : cell->vertex_indices())
        {
          const Index          node = cell->vertex_dof_index(v, 0);
          const Tensor<1, dim> d    = centre - cell->vertex(v);
          sums(node, number) += 1.;
          for (unsigned int i = 0; i < dim; ++i)
            {
              sums(node, distance + i) += d[i];
              for (unsigned int j = 0; j < dim; ++j)
                {
                  sums(node, squares + dim * i + j) += d[i] * d[j];
                  sums(node, extent + dim * i + j) += second[i][j];
                }
            }
          for (unsigned int c = 0; c < StressRecovery::n_components; ++c)
            {
              const double value = stress.access_raw_entry(c);
              sums(node, means + c) += value;
              for (unsigned int i = 0; i < dim; ++i)
                sums(node, moments + dim * c + i) += value * d[i];
            }
        }
    }

    /** L of G = L L^T. */
    Tensor<2, dim>
    lower_factor(const Tensor<2, dim> &G)
    {
      Tensor<2, dim> L;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          {
            double sum = G[i][j];
            for (unsigned int k = 0; k < j; ++k)
              sum -= L[i][k] * L[j][k];
            L[i][j] = i == j ? std::sqrt(sum) : sum / L[j][j];
          }
      return L;
    }

    /** The fit at one vertex. In coordinates in which a cell has the second moment I, the centres
     * of two cells side by side are 1 from each other's middle, and those of one layer 0. */
    void
    fit(const VertexValues &sums, const Index vertex, VertexValues &fields)
    {
      const double   n = sums(vertex, number);
      Tensor<1, dim> mean;
      Tensor<2, dim> spread, size;
      for (unsigned int i = 0; i < dim; ++i)
        mean[i] = sums(vertex, distance + i) / n;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            spread[i][j] = sums(vertex, squares + dim * i + j) / n - mean[i] * mean[j];
            size[i][j]   = sums(vertex, extent + dim * i + j) / n;
          }
      const Tensor<2, dim> to_unit = invert(lower_factor(size));
      const auto           axes = eigenvectors(symmetrize(to_unit * spread * transpose(to_unit)));
      Tensor<2, dim>       inverse;
      unsigned int         fitted = 0;
      for (const auto &[value, axis] : axes)
        if (value > 0.1)
          {
            inverse += outer_product(axis, axis) / value;
            ++fitted;
          }
      inverse                    = transpose(to_unit) * inverse * to_unit;
      fields(vertex, directions) = fitted;
      for (unsigned int c = 0; c < StressRecovery::n_components; ++c)
        {
          const double   stress = sums(vertex, means + c) / n;
          Tensor<1, dim> moment;
          for (unsigned int i = 0; i < dim; ++i)
            moment[i] = sums(vertex, moments + dim * c + i) / n - mean[i] * stress;
          const Tensor<1, dim> slope = inverse * moment;
          fields(vertex, c)          = stress - slope * mean;
          for (unsigned int i = 0; i < dim; ++i)
            fields(vertex, slopes + dim * c + i) = slope[i];
        }
    }

    /** Give vertices without a field the mean of those of the other vertices of their cells. */
    void
    extend(const DoFHandler<dim> &vertices, const IndexSet &relevant, VertexValues &fields)
    {
      VertexValues sums(vertices, relevant, n_of_field);
      for (const auto &cell : vertices.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            if (const Index to = cell->vertex_dof_index(v, 0); fields(to, directions) < 0.)
              for (const unsigned int w : cell->vertex_indices())
                if (const Index from = cell->vertex_dof_index(w, 0); fields(from, directions) >= 0.)
                  {
                    const Tensor<1, dim> d = cell->vertex(v) - cell->vertex(w);
                    sums(to, directions) += 1.;
                    for (unsigned int c = 0; c < StressRecovery::n_components; ++c)
                      {
                        sums(to, c) += fields(from, c);
                        for (unsigned int i = 0; i < dim; ++i)
                          {
                            const double slope = fields(from, slopes + dim * c + i);
                            sums(to, c) += slope * d[i];
                            sums(to, slopes + dim * c + i) += slope;
                          }
                      }
                  }
      sums.add_up();
      for (const Index vertex : vertices.locally_owned_dofs())
        if (const double n = sums(vertex, directions); n > 0.)
          {
            for (unsigned int k = 0; k < directions; ++k)
              fields(vertex, k) = sums(vertex, k) / n;
            fields(vertex, directions) = 0.;
          }
    }
  } // namespace



  StressField
  StressRecovery::patches(const PointStresses &points) const
  {
    Assert(fe.degree == 1, ExcNotImplemented());
    VertexValues       sums(numbers, relevant, n_sums), fields(numbers, relevant, n_of_field);
    std::size_t        at       = 0;
    const unsigned int n_points = values.n_quadrature_points;
    for (const auto &cell : numbers.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          double                  volume = 0.;
          Tensor<1, dim>          centre;
          SymmetricTensor<2, dim> stress;
          for (unsigned int q = 0; q < n_points; ++q, ++at)
            {
              volume += points.volume[at];
              centre += points.volume[at] * points.x[at];
              stress += points.volume[at] * points.stress[at];
            }
          add_cell(cell, Point<dim>(centre / volume), stress / volume, sums);
        }
    sums.add_up();

    const IndexSet  &owned = numbers.locally_owned_dofs();
    VertexValues     own(numbers, relevant, n_of_field);
    constexpr double none = -1.;
    for (const Index vertex : owned)
      {
        // A hanging node that no cell has as a vertex does not exist: at least one cell is there.
        fit(sums, vertex, own);
        fields(vertex, directions) = none;
      }
    // Fits in all directions first, then by their number: one layer of cells has two.
    for (int fitted = dim; fitted >= 0; --fitted)
      {
        unsigned int without = 0;
        for (const Index vertex : owned)
          if (fields(vertex, directions) < 0.)
            {
              if (own(vertex, directions) >= fitted)
                for (unsigned int k = 0; k < n_of_field; ++k)
                  fields(vertex, k) = own(vertex, k);
              else
                ++without;
            }
        fields.share();
        if (Utilities::MPI::sum(without, solid.communicator) == 0)
          break;
        extend(numbers, relevant, fields);
        fields.share();
      }

    StressField result;
    for (unsigned int c = 0; c < StressRecovery::n_components; ++c)
      {
        result[c].reinit(owned, relevant, numbers.get_communicator());
        for (const Index vertex : owned)
          result[c](vertex) = fields(vertex, c);
        hanging.distribute(result[c]);
        result[c].update_ghost_values();
      }
    return result;
  }
} // namespace Touchstone
