// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/state_transfer.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/cell_data_transfer.templates.h>

#include <algorithm>

// History of material points when the mesh changes (doc/materials.md, "State"). Only p4est meshes
// can change; cells carry their states through refinement, coarsening and repartitioning as data
// of variable size.
namespace Touchstone
{
  using namespace dealii;

  StateTransfer::StateTransfer(parallel::TriangulationBase<dim> &triangulation, Solid &solid)
    : solid(solid)
  {
    const auto *forest = dynamic_cast<parallel::distributed::Triangulation<dim> *>(&triangulation);
    if (!solid.has_history() || !forest)
      return;
    const QGauss<dim> quadrature(solid.fe.degree + 1);
    // Which points correspond depends on the reference cell alone, so both tables are made once:
    // the parent's nearest point for each point of a child, and the children that contain each
    // point of the parent, which are several if it lies on a face between them (degree 2).
    const auto n_children = GeometryInfo<dim>::max_children_per_cell;
    weights               = quadrature.get_weights();
    nearest.assign(n_children, std::vector<unsigned int>(quadrature.size()));
    containing.resize(quadrature.size());
    for (unsigned int c = 0; c < n_children; ++c)
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const Point<dim> x = GeometryInfo<dim>::child_to_cell_coordinates(quadrature.point(q), c);
          double           smallest = 2. * dim;
          for (unsigned int p = 0; p < quadrature.size(); ++p)
            if (const double distance = x.distance(quadrature.point(p)); distance < smallest)
              {
                smallest      = distance;
                nearest[c][q] = p;
              }
          if (GeometryInfo<dim>::is_inside_unit_cell(
                GeometryInfo<dim>::cell_to_child_coordinates(quadrature.point(q), c), 1e-10))
            containing[q].push_back(c);
        }

    for (unsigned int b = 0; b < solid.n_bodies(); ++b)
      laws.push_back(solid.history_law(b));
    states.resize(triangulation.n_active_cells());
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        states[cell->active_cell_index()] = solid.cell_state(cell->active_cell_index());
    transfer = std::make_unique<parallel::distributed::CellDataTransfer<dim, dim, States>>(
      *forest,
      /*transfer_variable_size_data=*/true,
      [this](const Cell &, const State &state) { return refine(state); },
      [this](const Cell &cell, const States &children) { return coarsen(cell, children); });
    transfer->prepare_for_coarsening_and_refinement(states);
  }



  /** Children copy the state of the nearest point: interpolation would give states off the yield
   * surface, while a copy is one that the law has produced. */
  StateTransfer::States
  StateTransfer::refine(const State &parent) const
  {
    States             children(nearest.size(), State(parent.size()));
    const unsigned int n = parent.size() / weights.size();
    for (unsigned int c = 0; c < children.size(); ++c)
      for (unsigned int q = 0; q < weights.size(); ++q)
        std::copy_n(parent.begin() + nearest[c][q] * n, n, children[c].begin() + q * n);
    return children;
  }



  /** The volume average over the child that contains the point, so that means, e.g. of the plastic
   * work, are kept as far as possible. An average of F_p^-1 does not have determinant one, which
   * restore() repairs. */
  StateTransfer::State
  StateTransfer::coarsen(const Cell &parent, const States &children) const
  {
    const MaterialLaw *law = laws[parent->material_id()].get();
    if (!law)
      return {};
    const unsigned int n = law->n_state();
    State              result(n * weights.size());
    for (unsigned int p = 0; p < weights.size(); ++p)
      {
        double volume = 0.;
        for (const unsigned int c : containing[p])
          for (unsigned int q = 0; q < weights.size(); ++q)
            {
              const double part = parent->child(c)->measure() * weights[q];
              volume += part;
              for (unsigned int k = 0; k < n; ++k)
                result[p * n + k] += part * children[c][q * n + k];
            }
        for (unsigned int k = 0; k < n; ++k)
          result[p * n + k] /= volume;
        law->restore(&result[p * n]);
      }
    return result;
  }



  /** Take over the states on the new mesh, and send those of ghost cells. Collective. */
  void
  StateTransfer::finish()
  {
    if (!transfer)
      return;
    const auto &triangulation = solid.dof_handler.get_triangulation();
    states.assign(triangulation.n_active_cells(), State());
    transfer->unpack(states);
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        solid.set_cell_state(cell->active_cell_index(), states[cell->active_cell_index()]);
    solid.exchange_cell_states();
  }
} // namespace Touchstone
