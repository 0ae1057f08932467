// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/vectorised.h>
#include <touchstone/explicit/elastic_cells.h>

// Linear elastic cells of explicit dynamics, by the stiffness of the elements of implicit runs
// (doc/explicit.md, section 5).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_unknowns = CellStiffness::n;

    /** y = K x */
    TOUCHSTONE_VECTORISED
    void
    multiply(const double *K, const double *x, double *y)
    {
      for (unsigned int i = 0; i < n_unknowns; ++i)
        y[i] = 0.;
      // K is symmetric: by columns, which are vectors.
      for (unsigned int k = 0; k < n_unknowns; ++k)
        for (unsigned int i = 0; i < n_unknowns; ++i)
          y[i] += K[n_unknowns * k + i] * x[k];
    }
  } // namespace



  ElasticCells::ElasticCells(const NodeMap                   &map,
                             const std::vector<unsigned int> &cells,
                             const BodyParameters            &body)
    : CellForces(map, cells, body)
    , stiffness(cells.size() * n * n)
  {
    CellStiffness one(body.element(), body.material);
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        one.reinit(corners(map, nodes(c)));
        // The symmetric part: the condensation of modes leaves round-off.
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            stiffness[(c * n + i) * n + j] = 0.5 * (one(i, j) + one(j, i));
      }
  }



  unsigned int
  ElasticCells::subtract_forces(const NodeField &u,
                                const NodeField &v,
                                const double /*step*/,
                                const BulkViscosity *const bulk,
                                NodeField                 &force,
                                NodeField                 &viscous)
  {
    double x[n], y[n];
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        for (unsigned int i = 0; i < n; ++i)
          x[i] = u[nodes(c)[i / dim]][i % dim];
        multiply(&stiffness[c * n * n], x, y);
        subtract(nodes(c), y, force);
      }
    subtract_viscosity(u, v, bulk, viscous);
    return numbers::invalid_unsigned_int;
  }



  void
  ElasticCells::add_energies(const NodeField &u, CellEnergies &energies)
  {
    double x[n], y[n];
    for (unsigned int c = 0; c < cells.size(); ++c)
      if (cell(c).owned)
        {
          for (unsigned int i = 0; i < n; ++i)
            x[i] = u[nodes(c)[i / dim]][i % dim];
          multiply(&stiffness[c * n * n], x, y);
          double sum = 0.;
          for (unsigned int i = 0; i < n; ++i)
            sum += 0.5 * x[i] * y[i];
          energies.strain.add(sum);
        }
  }



  void
  ElasticCells::square_frequencies(const NodeField & /*u*/, std::vector<double> &result)
  {
    if (exact.size() != cells.size())
      for (unsigned int c = 0; c < cells.size(); ++c)
        exact.push_back(
          largest_eigenvalue([&](const unsigned int i,
                                 const unsigned int j) { return stiffness[(c * n + i) * n + j]; },
                             masses(c)));
    result = exact;
  }
} // namespace Touchstone
