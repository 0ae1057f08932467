// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/bodies.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <algorithm>
#include <limits>

namespace Touchstone
{
  using namespace dealii;

  /** The axis-parallel bounding box of each body in the reference state (length), from the
   * vertices of all cells. A rank may own no cell of a body, so it starts from an inverted box,
   * which the reduction over all ranks leaves without effect. Collective. */
  std::vector<BoundingBox<dim>>
  body_boxes(const Solid &solid)
  {
    const unsigned int  n_bodies = solid.n_bodies();
    constexpr double    far      = std::numeric_limits<double>::max();
    std::vector<double> lower(dim * n_bodies, far), upper(dim * n_bodies, -far);
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          for (unsigned int d = 0; d < dim; ++d)
            {
              double &l = lower[dim * cell->material_id() + d];
              double &u = upper[dim * cell->material_id() + d];
              l         = std::min(l, cell->vertex(v)[d]);
              u         = std::max(u, cell->vertex(v)[d]);
            }
    Utilities::MPI::min(lower, solid.communicator, lower);
    Utilities::MPI::max(upper, solid.communicator, upper);
    std::vector<BoundingBox<dim>> result;
    for (unsigned int b = 0; b < n_bodies; ++b)
      {
        Point<dim> low, high;
        for (unsigned int d = 0; d < dim; ++d)
          {
            low[d]  = lower[dim * b + d];
            high[d] = upper[dim * b + d];
          }
        result.emplace_back(std::make_pair(low, high));
      }
    return result;
  }



  std::vector<RigidFrame>
  rigid_frames(const Solid &solid)
  {
    std::vector<RigidFrame> result;
    for (const BoundingBox<dim> &box : body_boxes(solid))
      {
        const auto &[low, high] = box.get_boundary_points();
        result.push_back({Point<dim>(0.5 * (low + high)), 0.5 * low.distance(high)});
      }
    return result;
  }



  Tensor<1, dim>
  rigid_mode(const unsigned int k, const Tensor<1, dim> &x)
  {
    const Tensor<1, dim> axis = Point<dim>::unit_vector(k % dim);
    return k < dim ? axis : cross_product_3d(axis, x);
  }



  Vector
  present_positions(const Solid &solid, const Vector &u)
  {
    Vector result(u);
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, result);
    result += u;
    return result;
  }



  /** The body of each locally owned dof, in the order of the rows of the matrix. No node belongs to
   * two bodies, since bodies share no vertices. */
  std::vector<unsigned int>
  bodies_of_unknowns(const Solid &solid)
  {
    std::vector<unsigned int> result(solid.owned.n_elements());
    std::vector<Index>        dofs(solid.fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(dofs);
          for (const Index i : dofs)
            if (solid.owned.is_element(i))
              result[solid.owned.index_within_set(i)] = cell->material_id();
        }
    return result;
  }
} // namespace Touchstone
