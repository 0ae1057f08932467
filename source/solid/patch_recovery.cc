// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/patch_polynomials.h>
#include <touchstone/solid/stress_recovery.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>

#include <cmath>

/**
 * @file
 * Polynomials fitted to the stresses of the cells around a vertex (doc/theory.md 11, "Recovered
 * stress"). Stresses of degree p are most accurate, of order p + 1, at the p Gauss points a
 * direction, and so are polynomials of degree p that fit them. The power p of a direction is fitted
 * where cells lie on both sides of the vertex; a vertex whose neighbours have more of such
 * directions, as at boundaries, takes the fits of these.
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
     * the vertex to the centre; d d^T; G, the second moment of a cell by its vertices. Then, with
     * the monomials m of the distance of its points: m m^T and sigma m. */
    enum Sums : unsigned int
    {
      number   = 0,
      distance = 1,
      squares  = distance + dim,
      extent   = squares + dim * dim,
      fitting  = extent + dim * dim
    };

    using Cell = DoFHandler<dim>::active_cell_iterator;

    constexpr unsigned int n_components = StressRecovery::n_components;

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

    /** What the cells around the vertices add up to, and the polynomials fitted to it: n
     * coefficients for each component, then the number of directions with cells on both sides, -1
     * while there is none. */
    class Patches
    {
    public:
      Patches(const unsigned int degree, const DoFHandler<dim> &vertices, const IndexSet &relevant)
        : polynomials(degree)
        , n(polynomials.n)
        , n_of_field(n_components * n + 1)
        , fields(vertices, relevant, n_of_field)
        , vertices(vertices)
        , relevant(relevant)
        , sums(vertices, relevant, fitting + n * n + n_components * n)
        , directions(n_of_field - 1)
      {
      }

      void
      add_cell(const Cell                                 &cell,
               const std::vector<Point<dim>>              &x,
               const std::vector<SymmetricTensor<2, dim>> &stress)
      {
        Point<dim> centre;
        for (const Point<dim> &at : x)
          centre += at / double(x.size());
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
            for (std::size_t q = 0; q < x.size(); ++q)
              {
                const std::vector<double> m    = polynomials.monomials(x[q] - cell->vertex(v));
                unsigned int              next = fitting;
                for (unsigned int i = 0; i < n; ++i)
                  for (unsigned int j = 0; j < n; ++j)
                    sums(node, next++) += m[i] * m[j];
                for (unsigned int c = 0; c < n_components; ++c)
                  for (unsigned int i = 0; i < n; ++i)
                    sums(node, next++) += stress[q].access_raw_entry(c) * m[i];
              }
          }
      }

      /** Fit at all vertices. Collective. */
      void
      fit()
      {
        sums.add_up();
        const IndexSet &owned = vertices.locally_owned_dofs();
        VertexValues    own(vertices, relevant, n_of_field);
        for (const Index vertex : owned)
          {
            // A hanging node that no cell has as a vertex does not exist: one cell is there.
            fit(vertex, own);
            fields(vertex, directions) = -1.;
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
            if (Utilities::MPI::sum(without, vertices.get_communicator()) == 0)
              break;
            extend();
            fields.share();
          }
      }

      /** Component @p c of the polynomial of a vertex, at @p d from it. */
      double
      value(const Index vertex, const unsigned int c, const Tensor<1, dim> &d) const
      {
        const std::vector<double> m      = polynomials.monomials(d);
        double                    result = 0.;
        for (unsigned int i = 0; i < n; ++i)
          result += fields(vertex, n * c + i) * m[i];
        return result;
      }

    private:
      const PatchPolynomials polynomials;
      const unsigned int     n, n_of_field;
      VertexValues           fields;
      const DoFHandler<dim> &vertices;
      const IndexSet        &relevant;
      VertexValues           sums;
      const unsigned int     directions;

      /** The fit at one vertex. In coordinates in which a cell has the second moment I, the centres
       * of two cells side by side are 1 from each other's middle, and those of one layer 0. */
      void
      fit(const Index vertex, VertexValues &to) const
      {
        const double   n_cells = sums(vertex, number);
        Tensor<1, dim> mean;
        Tensor<2, dim> spread, size, frame;
        for (unsigned int i = 0; i < dim; ++i)
          mean[i] = sums(vertex, distance + i) / n_cells;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              spread[i][j] = sums(vertex, squares + dim * i + j) / n_cells - mean[i] * mean[j];
              size[i][j]   = sums(vertex, extent + dim * i + j) / n_cells;
            }
        const Tensor<2, dim> to_unit = invert(lower_factor(size));
        const auto           axes = eigenvectors(symmetrize(to_unit * spread * transpose(to_unit)));
        std::array<bool, dim> fitted;
        to(vertex, directions) = 0.;
        for (unsigned int k = 0; k < dim; ++k)
          {
            fitted[k]                   = axes[k].first > 0.1;
            const Tensor<1, dim> scaled = axes[k].second * to_unit;
            for (unsigned int i = 0; i < dim; ++i)
              frame[k][i] = scaled[i];
            if (fitted[k])
              to(vertex, directions) += 1.;
          }
        FullMatrix<double> M(n, n);
        unsigned int       next = fitting;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            M(i, j) = sums(vertex, next++);
        const FullMatrix<double> inverse = polynomials.least_squares(M, frame, fitted);
        for (unsigned int c = 0; c < n_components; ++c, next += n)
          for (unsigned int i = 0; i < n; ++i)
            {
              double coefficient = 0.;
              for (unsigned int j = 0; j < n; ++j)
                coefficient += inverse(i, j) * sums(vertex, next + j);
              to(vertex, n * c + i) = coefficient;
            }
      }

      /** Give vertices without a polynomial the mean of those of the others of their cells. */
      void
      extend()
      {
        VertexValues   found(vertices, relevant, n_of_field);
        Tensor<2, dim> unit;
        for (unsigned int d = 0; d < dim; ++d)
          unit[d][d] = 1.;
        for (const auto &cell : vertices.active_cell_iterators())
          if (cell->is_locally_owned())
            for (const unsigned int v : cell->vertex_indices())
              if (const Index to = cell->vertex_dof_index(v, 0); fields(to, directions) < 0.)
                for (const unsigned int w : cell->vertex_indices())
                  if (const Index from = cell->vertex_dof_index(w, 0);
                      fields(from, directions) >= 0.)
                    {
                      const FullMatrix<double> moved =
                        polynomials.affine_map(unit, cell->vertex(v) - cell->vertex(w));
                      found(to, directions) += 1.;
                      for (unsigned int c = 0; c < n_components; ++c)
                        for (unsigned int i = 0; i < n; ++i)
                          for (unsigned int j = 0; j < n; ++j)
                            found(to, n * c + j) += fields(from, n * c + i) * moved(i, j);
                    }
        found.add_up();
        for (const Index vertex : vertices.locally_owned_dofs())
          if (const double number = found(vertex, directions); number > 0.)
            {
              for (unsigned int k = 0; k < directions; ++k)
                fields(vertex, k) = found(vertex, k) / number;
              fields(vertex, directions) = 0.;
            }
      }
    };
  } // namespace



  StressField
  StressRecovery::patches(const PointStresses &points) const
  {
    Patches patches(fe.degree, vertices, relevant_vertices);
    // From the points of the stresses to those where they are most accurate.
    const FE_DGQArbitraryNodes<dim>      interpolation(QGauss<1>(fe.degree + 1));
    const QGauss<dim>                    best(fe.degree);
    std::vector<Point<dim>>              x(best.size());
    std::vector<SymmetricTensor<2, dim>> stress(best.size());
    std::size_t                          at = 0;
    for (const auto &cell : vertices.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          for (unsigned int b = 0; b < best.size(); ++b)
            {
              x[b]      = Point<dim>();
              stress[b] = 0.;
              for (unsigned int q = 0; q < interpolation.n_dofs_per_cell(); ++q)
                {
                  const double share = interpolation.shape_value(q, best.point(b));
                  x[b] += share * points.x[at + q];
                  stress[b] += share * points.stress[at + q];
                }
            }
          at += interpolation.n_dofs_per_cell();
          patches.add_cell(cell, x, stress);
        }
    patches.fit();

    // A node takes the polynomials of the vertices of its edge, face or cell in equal parts.
    const Quadrature<dim> places(fe.get_unit_support_points());
    FEValues<dim>         at_nodes(values.get_mapping(), fe, places, update_quadrature_points);
    const IndexSet       &owned = numbers.locally_owned_dofs();
    StressField           result;
    for (auto &component : result)
      component.reinit(owned, relevant, numbers.get_communicator());
    std::vector<Index> dofs(fe.n_dofs_per_cell());
    auto               vertex = vertices.begin_active();
    for (const auto &cell : numbers.active_cell_iterators())
      {
        if (cell->is_locally_owned())
          {
            at_nodes.reinit(cell);
            cell->get_dof_indices(dofs);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              if (owned.is_element(dofs[i]))
                for (unsigned int c = 0; c < n_components; ++c)
                  {
                    double value = 0.;
                    for (const unsigned int v : cell->vertex_indices())
                      if (const double part =
                            GeometryInfo<dim>::d_linear_shape_function(places.point(i), v);
                          part > 1e-9)
                        value +=
                          part * patches.value(vertex->vertex_dof_index(v, 0),
                                               c,
                                               at_nodes.quadrature_point(i) - cell->vertex(v));
                    result[c](dofs[i]) = value;
                  }
          }
        ++vertex;
      }
    for (auto &component : result)
      {
        hanging.distribute(component);
        component.update_ghost_values();
      }
    return result;
  }
} // namespace Touchstone
