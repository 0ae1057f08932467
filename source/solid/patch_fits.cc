// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/patch_fits.h>

#include <deal.II/base/mpi.h>

#include <cmath>

// Least squares around the vertices for recovered stresses (doc/theory.md 11).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
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

    constexpr unsigned int n_components = SymmetricTensor<2, dim>::n_independent_components;

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
  } // namespace



  PatchFits::PatchFits(const unsigned int     degree,
                       const DoFHandler<dim> &vertices,
                       const IndexSet        &relevant)
    : polynomials(degree)
    , vertices(vertices)
    , relevant(relevant)
    , n(polynomials.n)
    , directions(n_components * n)
    , sums(vertices, relevant, fitting + n * n + n_components * n)
    , fields(vertices, relevant, directions + 1)
  {
  }



  void
  PatchFits::add_cell(const Cell                                 &cell,
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



  // In coordinates in which a cell has the second moment I, the centres of two cells side by side
  // are 1 from each other's middle, and those of one layer 0.
  void
  PatchFits::fit(const Index vertex, VertexValues &to) const
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
    const Tensor<2, dim>  to_unit = invert(lower_factor(size));
    const auto            axes    = eigenvectors(symmetrize(to_unit * spread * transpose(to_unit)));
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



  void
  PatchFits::extend()
  {
    VertexValues   found(vertices, relevant, directions + 1);
    Tensor<2, dim> unit;
    for (unsigned int d = 0; d < dim; ++d)
      unit[d][d] = 1.;
    for (const auto &cell : vertices.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          if (const Index to = cell->vertex_dof_index(v, 0); fields(to, directions) < 0.)
            for (const unsigned int w : cell->vertex_indices())
              if (const Index from = cell->vertex_dof_index(w, 0); fields(from, directions) >= 0.)
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



  void
  PatchFits::fit()
  {
    sums.add_up();
    const IndexSet &owned = vertices.locally_owned_dofs();
    VertexValues    own(vertices, relevant, directions + 1);
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
                for (unsigned int k = 0; k < directions + 1; ++k)
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



  double
  PatchFits::value(const Index vertex, const unsigned int c, const Tensor<1, dim> &d) const
  {
    const std::vector<double> m      = polynomials.monomials(d);
    double                    result = 0.;
    for (unsigned int i = 0; i < n; ++i)
      result += fields(vertex, n * c + i) * m[i];
    return result;
  }
} // namespace Touchstone
