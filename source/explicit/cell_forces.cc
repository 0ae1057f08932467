// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/block_kernels.h>
#include <touchstone/explicit/elastic_cells.h>
#include <touchstone/explicit/gauss_cells.h>
#include <touchstone/explicit/one_point_cells.h>
#include <touchstone/explicit/stable_step.h>

#include <algorithm>

// What all cells of explicit dynamics share: bulk viscosity, and the choice of the cells for a body
// (doc/explicit.md, sections 4 and 5).
namespace Touchstone
{
  using namespace dealii;

  const BlockNodes &
  CellForces::block_nodes(const unsigned int first, BlockNodes &space) const
  {
    constexpr unsigned int last = n_lanes - 1;
    static_assert(sizeof(BlockNodes) == n_lanes * sizeof(NodeMap::CellNodes));
    // Numbers of cells ascend.
    if (first + last < cells.size() && cells[first + last] == cells[first] + last)
      return *reinterpret_cast<const BlockNodes *>(&nodes(first));
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        const auto &of_cell = nodes(std::min<std::size_t>(first + lane, cells.size() - 1));
        std::copy(of_cell.begin(), of_cell.end(), space.of_cells[lane]);
      }
    return space;
  }



  void
  CellForces::set_masses(const BlockNodes &nodes, double (*const masses)[n_lanes]) const
  {
    BlockKernels::set_nodal_volumes(nodes, numbers_of(map.positions()), masses);
    for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        masses[a][lane] *= body.material.density;
  }



  void
  CellForces::add_masses(const std::vector<double> &factors, std::vector<double> &nodal_mass) const
  {
    BlockNodes space;
    double     masses[NodeMap::nodes_per_cell][n_lanes];
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        if (c % n_lanes == 0)
          set_masses(block_nodes(c, space), masses);
        for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
          nodal_mass[nodes(c)[a]] += (factors.empty() ? 1. : factors[c]) * masses[a][c % n_lanes];
      }
  }



  CellForces::NodalMasses
  CellForces::masses(const unsigned int c) const
  {
    // The arithmetic of a lane does not depend on the others.
    const unsigned int first = c / n_lanes * n_lanes;
    BlockNodes         space;
    double             of_block[NodeMap::nodes_per_cell][n_lanes];
    set_masses(block_nodes(first, space), of_block);
    NodalMasses result;
    for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
      result[a] = of_block[a][c - first];
    return result;
  }



  void
  CellForces::set_volume_rates(const NodeField &u, const NodeField &v, std::vector<double> &result)
  {
    const double *const       present = body.material.finite_strain() ? numbers_of(u) : nullptr;
    BlockKernels::Derivatives unused;
    BlockNodes                space;
    double                    rate[n_lanes];
    result.resize(cells.size());
    for (unsigned int first = 0; first < cells.size(); first += n_lanes)
      {
        BlockKernels::set_volume_rates(block_nodes(first, space),
                                       numbers_of(map.positions()),
                                       present,
                                       numbers_of(v),
                                       rate,
                                       unused);
        std::copy_n(rate, std::min<std::size_t>(n_lanes, cells.size() - first), &result[first]);
      }
  }



  void
  CellForces::set_edge_rates(const NodeField     &u,
                             const NodeField     &v,
                             std::vector<double> &result) const
  {
    double     square[n_lanes];
    BlockNodes space;
    result.resize(cells.size());
    for (unsigned int first = 0; first < cells.size(); first += n_lanes)
      {
        BlockKernels::set_edge_rates(block_nodes(first, space),
                                     numbers_of(map.positions()),
                                     numbers_of(u),
                                     numbers_of(v),
                                     square);
        std::copy_n(square, std::min<std::size_t>(n_lanes, cells.size() - first), &result[first]);
      }
  }



  void
  CellForces::set_one_point_frequencies(const NodeField &u, std::vector<double> &result) const
  {
    const double *const present = body.material.finite_strain() ? numbers_of(u) : nullptr;
    double masses[NodeMap::nodes_per_cell][n_lanes], volume[n_lanes], mobility[2 * dim][n_lanes];
    BlockNodes space;
    result.resize(cells.size());
    for (unsigned int first = 0; first < cells.size(); first += n_lanes)
      {
        const unsigned int n_used = std::min<std::size_t>(n_lanes, cells.size() - first);
        const BlockNodes  &nodes  = block_nodes(first, space);
        set_masses(nodes, masses);
        BlockKernels::set_mobilities(
          nodes, numbers_of(map.positions()), present, masses, volume, mobility);
        for (unsigned int lane = 0; lane < n_used; ++lane)
          {
            SymmetricTensor<2, dim> G;
            for (unsigned int i = 0; i < dim; ++i)
              {
                G[i][i]                         = mobility[i][lane];
                G[(i + 1) % dim][(i + 2) % dim] = mobility[dim + i][lane];
              }
            result[first + lane] = one_point_frequency(G, volume[lane], body.material);
          }
      }
  }



  void
  CellForces::subtract_viscosity(const NodeField           &u,
                                 const NodeField           &v,
                                 const BulkViscosity *const bulk,
                                 NodeField                 &viscous) const
  {
    if (bulk == nullptr)
      return;
    const double *const       present = body.material.finite_strain() ? numbers_of(u) : nullptr;
    BlockKernels::Derivatives derivatives;
    BlockNodes                space;
    double rate[n_lanes], periods[n_lanes], forces[dim * NodeMap::nodes_per_cell][n_lanes];
    for (unsigned int first = 0; first < cells.size(); first += n_lanes)
      {
        const BlockNodes  &nodes  = block_nodes(first, space);
        const unsigned int n_used = std::min<std::size_t>(n_lanes, cells.size() - first);
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          periods[lane] = bulk->periods[first + std::min(lane, n_used - 1)];
        BlockKernels::set_volume_rates(
          nodes, numbers_of(map.positions()), present, numbers_of(v), rate, derivatives);
        BlockKernels::set_viscous_forces(bulk->viscosity, periods, rate, derivatives, forces);
        scatter(nodes.of_cells, n_used, forces, viscous);
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
