#include <touchstone/solid/finite_strain_cells.h>

#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <limits>

namespace Touchstone
{
  using namespace dealii;

  FiniteStrainCells::FiniteStrainCells(const Scene           &scene,
                                       const FESystem<dim>   &fe,
                                       const MappingQ<dim>   &mapping,
                                       const DoFHandler<dim> &dof_handler,
                                       const Matrix          &stiffness)
    : n_nodes(fe.n_dofs_per_cell() / dim)
    , kernels(scene.bodies.size())
    , displacement(fe.n_dofs_per_cell())
  {
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      if (scene.bodies[b].material.finite_strain())
        {
          any_body   = true;
          kernels[b] = std::make_unique<FiniteStrainKernel>(fe.degree,
                                                            scene.bodies[b].element(),
                                                            scene.bodies[b].material);
        }
    if (!any_body)
      return;

    const Epetra_Map             &row_map = stiffness.trilinos_matrix().RowMap();
    const Epetra_Map             &col_map = stiffness.trilinos_matrix().ColMap();
    std::vector<Index>            cell_dofs(fe.n_dofs_per_cell());
    const std::vector<Point<dim>> unit_points = FE_Q<dim>(fe.degree).get_unit_support_points();
    size.assign(row_map.NumMyElements(), 0.);
    number.assign(dof_handler.get_triangulation().n_active_cells(), -1);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial() && kernels[cell->material_id()])
        {
          cell->get_dof_indices(cell_dofs);
          bool any = false;
          for (const Index dof : cell_dofs)
            any = any || row_map.LID(static_cast<int>(dof)) >= 0;
          if (!any && !cell->is_locally_owned())
            continue;
          number[cell->active_cell_index()] = cells.size();
          cells.push_back({cell->material_id(), cell->is_locally_owned()});
          for (unsigned int a = 0; a < n_nodes; ++a)
            {
              const Index first = cell_dofs[fe.component_to_system_index(0, a)];
              const int   row   = row_map.LID(static_cast<int>(first));
              dofs.push_back(first);
              rows.push_back(row);
              for (unsigned int d = 0; d < dim; ++d)
                columns.push_back(col_map.LID(static_cast<int>(first + d)));
              const Point<dim> x = mapping.transform_unit_to_real_cell(cell, unit_points[a]);
              positions.insert(positions.end(), {x[0], x[1], x[2]});
              if (row < 0)
                continue;
              if (size[row] == 0.)
                node_rows.push_back(row);
              for (unsigned int d = 0; d < dim; ++d)
                size[row + d] = std::max(size[row + d], cell->diameter() / fe.degree);
            }
        }
  }



  FiniteStrainKernel &
  FiniteStrainCells::go_to(const std::size_t c, const Vector &u, double &determinant)
  {
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int d = 0; d < dim; ++d)
        displacement[dim * a + d] = u(dofs[c * n_nodes + a] + d);
    FiniteStrainKernel &kernel = *kernels[cells[c].body];
    determinant                = kernel.reinit(&positions[c * dim * n_nodes], displacement.data());
    return kernel;
  }



  void
  FiniteStrainCells::assemble(const Vector &u, RowWriter &writer)
  {
    for (const int row : node_rows)
      writer.clear_node(row);
    double determinant;
    for (std::size_t c = 0; c < cells.size(); ++c)
      writer.add(n_nodes,
                 &rows[c * n_nodes],
                 &columns[c * dim * n_nodes],
                 go_to(c, u, determinant).stiffness().data());
  }



  void
  FiniteStrainCells::internal_force(const Vector &u, Vector &force)
  {
    double *values = force.begin();
    for (const int row : node_rows)
      std::fill(values + row, values + row + dim, 0.);
    double determinant;
    for (std::size_t c = 0; c < cells.size(); ++c)
      {
        const std::vector<double> &forces = go_to(c, u, determinant).force();
        for (unsigned int a = 0; a < n_nodes; ++a)
          if (const int row = rows[c * n_nodes + a]; row >= 0)
            for (unsigned int d = 0; d < dim; ++d)
              values[row + d] += forces[dim * a + d];
      }
  }



  double
  FiniteStrainCells::energy(const Vector &u)
  {
    double sum = 0., determinant;
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (cells[c].owned)
        sum += go_to(c, u, determinant).energy();
    return sum;
  }



  double
  FiniteStrainCells::smallest_determinant(const Vector &u)
  {
    double smallest = std::numeric_limits<double>::max(), determinant;
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (cells[c].owned)
        {
          go_to(c, u, determinant);
          smallest = std::min(smallest, determinant);
        }
    return smallest;
  }



  const FiniteStrainKernel *
  FiniteStrainCells::at(const unsigned int cell, const Vector &u)
  {
    if (empty() || number[cell] < 0)
      return nullptr;
    double determinant;
    return &go_to(number[cell], u, determinant);
  }
} // namespace Touchstone
