// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/gauss_cells.h>

#include <algorithm>

// Hexahedra with 2x2x2 points, eight at a time (doc/explicit.md, section 5).
namespace Touchstone
{
  using namespace dealii;


  bool
  GaussCells::suits(const BodyParameters &body)
  {
    return body.material.finite_strain() &&
           (body.element() == ElementType::full || body.element() == ElementType::f_bar) &&
           BlockLaw(body).has_formulas();
  }



  GaussCells::GaussCells(const NodeMap                   &map,
                         const std::vector<unsigned int> &cells,
                         const BodyParameters            &body)
    : KernelCells(map, cells, body)
    , law(body)
    , f_bar(body.element() == ElementType::f_bar)
    , blocks((cells.size() + GaussBlock::n_cells - 1) / GaussBlock::n_cells)
  {
    Hexahedron shapes;
    for (unsigned int b = 0; b < blocks.size(); ++b)
      for (unsigned int lane = 0; lane < GaussBlock::n_cells; ++lane)
        {
          // The last block is filled with copies, whose results are dropped.
          const NodeMap::CellNodes &of_cell =
            nodes(std::min<unsigned int>(b * GaussBlock::n_cells + lane, cells.size() - 1));
          shapes.reinit(corners(map, of_cell));
          for (unsigned int a = 0; a < GaussBlock::n_nodes; ++a)
            blocks[b].nodes[lane][a] = of_cell[a];
          for (unsigned int q = 0; q < GaussBlock::n_points; ++q)
            {
              const Tensor<2, dim> inverse = shapes.inverse_jacobian(q);
              blocks[b].weight[q][lane]    = shapes.weight(q);
              for (unsigned int d = 0; d < dim; ++d)
                for (unsigned int j = 0; j < dim; ++j)
                  blocks[b].inverse[q][dim * d + j][lane] = inverse[d][j];
            }
        }
  }



  unsigned int
  GaussCells::subtract_forces(const NodeField           &u,
                              const NodeField           &v,
                              const double               step,
                              const BulkViscosity *const bulk,
                              NodeField                 &force,
                              NodeField                 &viscous)
  {
    unsigned int         failed  = numbers::invalid_unsigned_int;
    const unsigned int   n_state = states.size() / GaussBlock::n_points;
    GaussKernels::Points points;
    double               forces[dim * GaussBlock::n_nodes][GaussBlock::n_cells];
    for (unsigned int b = 0; b < blocks.size(); ++b)
      {
        const unsigned int first = b * GaussBlock::n_cells;
        const unsigned int n_used =
          std::min<unsigned int>(GaussBlock::n_cells, cells.size() - first);
        GaussKernels::deform(blocks[b], numbers_of(u), f_bar, points);
        bool inverted = false;
        for (unsigned int lane = 0; lane < n_used; ++lane)
          {
            smallest_ratio[first + lane] = points.smallest[lane];
            if (!(points.smallest[lane] > 0.))
              {
                failed   = std::min(failed, first + lane);
                inverted = true;
              }
          }
        if (inverted) // the run ends
          continue;
        for (unsigned int q = 0; q < GaussBlock::n_points; ++q)
          {
            const unsigned int lane = law.respond(
              points.gradient[q], step, n_used, states.block(b) + q * n_state, points.stress[q]);
            if (lane < n_used)
              failed = std::min(failed, first + lane);
          }
        GaussKernels::set_forces(blocks[b], points, f_bar, forces);
        scatter(blocks[b].nodes, n_used, forces, force);
      }
    subtract_viscosity(u, v, bulk, viscous);
    return failed;
  }
} // namespace Touchstone
