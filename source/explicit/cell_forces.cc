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

  BlockNodes
  CellForces::block_nodes(const unsigned int first) const
  {
    BlockNodes result;
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        const auto &nodes = cell(std::min<std::size_t>(first + lane, cells.size() - 1)).nodes;
        std::copy(nodes.begin(), nodes.end(), result.of_cells[lane]);
      }
    return result;
  }



  void
  CellForces::set_volume_rates(const NodeField &u, const NodeField &v, std::vector<double> &result)
  {
    const double *const       present = body.material.finite_strain() ? numbers_of(u) : nullptr;
    BlockKernels::Derivatives unused;
    double                    rate[n_lanes];
    result.resize(cells.size());
    for (unsigned int first = 0; first < cells.size(); first += n_lanes)
      {
        BlockKernels::set_volume_rates(
          block_nodes(first), numbers_of(map.positions()), present, numbers_of(v), rate, unused);
        std::copy_n(rate, std::min<std::size_t>(n_lanes, cells.size() - first), &result[first]);
      }
  }



  void
  CellForces::set_edge_rates(const NodeField     &u,
                             const NodeField     &v,
                             std::vector<double> &result) const
  {
    double square[n_lanes];
    result.resize(cells.size());
    for (unsigned int first = 0; first < cells.size(); first += n_lanes)
      {
        BlockKernels::set_edge_rates(
          block_nodes(first), numbers_of(map.positions()), numbers_of(u), numbers_of(v), square);
        std::copy_n(square, std::min<std::size_t>(n_lanes, cells.size() - first), &result[first]);
      }
  }



  void
  CellForces::set_one_point_frequencies(const NodeField                &u,
                                        const std::vector<NodalMasses> &masses,
                                        std::vector<double>            &result) const
  {
    const double *const present = body.material.finite_strain() ? numbers_of(u) : nullptr;
    double of_nodes[NodeMap::nodes_per_cell][n_lanes], volume[n_lanes], mobility[2 * dim][n_lanes];
    result.resize(cells.size());
    for (unsigned int first = 0; first < cells.size(); first += n_lanes)
      {
        const unsigned int n_used = std::min<std::size_t>(n_lanes, cells.size() - first);
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
            of_nodes[a][lane] = masses[first + std::min(lane, n_used - 1)][a];
        BlockKernels::set_mobilities(
          block_nodes(first), numbers_of(map.positions()), present, of_nodes, volume, mobility);
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
    double rate[n_lanes], periods[n_lanes], forces[dim * NodeMap::nodes_per_cell][n_lanes];
    for (unsigned int first = 0; first < cells.size(); first += n_lanes)
      {
        const BlockNodes   nodes  = block_nodes(first);
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
