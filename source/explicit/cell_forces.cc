// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/elastic_cells.h>
#include <touchstone/explicit/gauss_cells.h>
#include <touchstone/explicit/one_point_cells.h>
#include <touchstone/explicit/stable_step.h>

// What all cells of explicit dynamics share: bulk viscosity, and the choice of the cells for a body
// (doc/explicit.md, sections 4 and 5).
namespace Touchstone
{
  using namespace dealii;

  double
  CellForces::volume_rate(const unsigned int             c,
                          const NodeField               &u,
                          const NodeField               &v,
                          std::array<Tensor<1, dim>, 8> &derivative) const
  {
    const auto x  = corners(map, cell(c), body.material.finite_strain() ? &u : nullptr);
    derivative    = volume_derivative(x);
    double volume = 0., rate = 0.;
    for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
      {
        volume += derivative[a] * x[a] / dim;
        rate += derivative[a] * v[cell(c).nodes[a]];
      }
    return volume > 0. ? rate / volume : 0.;
  }



  void
  CellForces::subtract_viscosity(const NodeField           &u,
                                 const NodeField           &v,
                                 const BulkViscosity *const bulk,
                                 NodeField                 &viscous) const
  {
    std::array<Tensor<1, dim>, 8> derivative;
    for (unsigned int c = 0; bulk != nullptr && c < cells.size(); ++c)
      {
        const double rate     = volume_rate(c, u, v, derivative);
        const double pressure = bulk->viscosity(rate, bulk->periods[c]) * rate;
        for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
          viscous[cell(c).nodes[a]] -= pressure * derivative[a];
      }
  }



  std::unique_ptr<CellForces>
  CellForces::make(const NodeMap                   &map,
                   const std::vector<unsigned int> &cells,
                   const BodyParameters            &body)
  {
    if (body.element() == ElementType::one_point)
      return std::make_unique<OnePointCells>(map, cells, body);
    if (body.material.linear())
      return std::make_unique<ElasticCells>(map, cells, body);
    if (GaussCells::suits(body))
      return std::make_unique<GaussCells>(map, cells, body);
    return std::make_unique<KernelCells>(map, cells, body);
  }
} // namespace Touchstone
