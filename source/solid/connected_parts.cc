// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/connected_parts.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <limits>
#include <locale>
#include <numeric>
#include <sstream>
#include <tuple>
#include <utility>

// The parts of bodies that are not connected with each other. Each has rigid motions of its own,
// which supports of the others do not prevent.
namespace Touchstone
{
  using namespace dealii;

  ConnectedParts::ConnectedParts(const Solid &solid)
    : solid(solid)
    , part_of_node(solid.owned.n_elements() / dim)
  {
    const std::vector<double> label = labels();
    // Numbers of the parts: the labels of all ranks in their order.
    std::vector<double> all;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        all.push_back(label[cell->active_cell_index()]);
    const auto make_unique = [](std::vector<double> &values) {
      std::sort(values.begin(), values.end());
      values.erase(std::unique(values.begin(), values.end()), values.end());
    };
    make_unique(all);
    const auto of_ranks = Utilities::MPI::all_gather(solid.communicator, all);
    all.clear();
    for (const std::vector<double> &of_rank : of_ranks)
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    make_unique(all);

    std::vector<unsigned int> part_of_cell(label.size());
    std::vector<Index>        dofs(solid.fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          unsigned int &part = part_of_cell[cell->active_cell_index()];
          part = std::lower_bound(all.begin(), all.end(), label[cell->active_cell_index()]) -
                 all.begin();
          cell->get_dof_indices(dofs);
          for (const Index i : dofs)
            if (solid.owned.is_element(i))
              part_of_node[solid.owned.index_within_set(i) / dim] = part;
        }
    set_boxes(part_of_cell, all.size());
  }



  // Of cells with a common vertex all get the smallest number of their nodes, on this rank and
  // then, as long as anything changes, on ghost cells from their owners.
  std::vector<double>
  ConnectedParts::labels() const
  {
    using Cell               = Triangulation<dim>::active_cell_iterator;
    const auto         &mesh = solid.dof_handler.get_triangulation();
    std::vector<double> label(mesh.n_active_cells(), std::numeric_limits<double>::max());
    std::vector<Index>  dofs(solid.fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(dofs);
          label[cell->active_cell_index()] = *std::min_element(dofs.begin(), dofs.end());
        }

    boost::disjoint_sets_with_storage<> sets(mesh.n_vertices());
    for (const auto &cell : mesh.active_cell_iterators())
      if (!cell->is_artificial())
        for (const unsigned int v : cell->vertex_indices())
          sets.union_set(cell->vertex_index(0), cell->vertex_index(v));

    for (int changed = 1; changed == 1;)
      {
        changed = 0;
        std::vector<double> least(mesh.n_vertices(), std::numeric_limits<double>::max());
        for (const auto &cell : mesh.active_cell_iterators())
          if (!cell->is_artificial())
            {
              double &of_set = least[sets.find_set(cell->vertex_index(0))];
              of_set         = std::min(of_set, label[cell->active_cell_index()]);
            }
        for (const auto &cell : mesh.active_cell_iterators())
          if (!cell->is_artificial())
            label[cell->active_cell_index()] = least[sets.find_set(cell->vertex_index(0))];
        GridTools::exchange_cell_data_to_ghosts<double, Triangulation<dim>>(
          mesh,
          [&](const Cell &cell) -> std_cxx17::optional<double> {
            return label[cell->active_cell_index()];
          },
          [&](const Cell &cell, const double &value) {
            double &mine = label[cell->active_cell_index()];
            if (value != mine)
              changed = 1;
            mine = std::min(mine, value);
          });
        changed = Utilities::MPI::max(changed, solid.communicator);
      }
    return label;
  }



  void
  ConnectedParts::set_boxes(const std::vector<unsigned int> &part_of_cell, const unsigned int n)
  {
    bodies.assign(n, 0);
    std::vector<double> corners(2 * dim * n, -std::numeric_limits<double>::max());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int k = part_of_cell[cell->active_cell_index()];
          bodies[k]            = cell->material_id();
          for (const unsigned int v : cell->vertex_indices())
            for (unsigned int d = 0; d < dim; ++d)
              {
                double *const of_part = &corners[2 * dim * k + d];
                of_part[0]            = std::max(of_part[0], -cell->vertex(v)[d]);
                of_part[dim]          = std::max(of_part[dim], cell->vertex(v)[d]);
              }
        }
    Utilities::MPI::max(bodies, solid.communicator, bodies);
    Utilities::MPI::max(corners, solid.communicator, corners);
    for (unsigned int k = 0; k < n; ++k)
      {
        Point<dim> low, high;
        for (unsigned int d = 0; d < dim; ++d)
          {
            low[d]  = 0. - corners[2 * dim * k + d]; // no -0 in messages
            high[d] = corners[2 * dim * k + dim + d];
          }
        boxes.emplace_back(std::make_pair(low, high));
      }
  }



  bool
  ConnectedParts::has_others(const unsigned int k) const
  {
    return std::count(bodies.begin(), bodies.end(), bodies[k]) > 1;
  }



  // The smallest eigenvalue of the Gram matrix of the conditions on the six rigid motions of a
  // part, about its centre and in its size; see RigidBodyModes.
  std::vector<bool>
  ConnectedParts::held(const std::vector<Condition> &conditions) const
  {
    constexpr unsigned int n_modes = 6;
    std::vector<double>    gram(n_modes * n_modes * n_parts(), 0.);
    for (const Condition &condition : conditions)
      {
        const unsigned int   k      = of_node(condition.node);
        const auto          &ends   = boxes[k].get_boundary_points();
        const Point<dim>     centre = ends.first + 0.5 * (ends.second - ends.first);
        const Tensor<1, dim> x =
          (condition.position - centre) / (0.5 * ends.first.distance(ends.second));
        const Tensor<1, dim>        turns = cross_product_3d(x, condition.direction);
        std::array<double, n_modes> row;
        for (unsigned int d = 0; d < dim; ++d)
          {
            row[d]       = condition.direction[d];
            row[dim + d] = turns[d];
          }
        for (unsigned int i = 0; i < n_modes; ++i)
          for (unsigned int j = 0; j < n_modes; ++j)
            gram[n_modes * (n_modes * k + i) + j] += row[i] * row[j];
      }
    Utilities::MPI::sum(gram, solid.communicator, gram);
    std::vector<bool> result;
    for (unsigned int k = 0; k < n_parts(); ++k)
      {
        LAPACKFullMatrix<double> matrix(n_modes, n_modes);
        double                   largest = 0.;
        for (unsigned int i = 0; i < n_modes; ++i)
          for (unsigned int j = 0; j < n_modes; ++j)
            {
              matrix(i, j) = gram[n_modes * (n_modes * k + i) + j];
              largest      = std::max(largest, std::abs(matrix(i, j)));
            }
        if (largest > 0.)
          matrix.compute_svd();
        result.push_back(largest > 0. && matrix.singular_value(n_modes - 1) > 1e-8 * largest);
      }
    return result;
  }



  std::string
  ConnectedParts::describe(const std::vector<unsigned int> &parts) const
  {
    // In an order that does not depend on the numbers of nodes, and not more than a reader needs.
    constexpr std::size_t                           most = 3;
    std::vector<std::pair<std::string, Point<dim>>> places;
    for (const unsigned int k : parts)
      places.emplace_back(body(k), boxes[k].get_boundary_points().first);
    std::vector<std::size_t> order(parts.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
      const auto key = [&](const std::size_t i) {
        const Point<dim> &x = places[i].second;
        return std::make_tuple(places[i].first, x[0], x[1], x[2]);
      };
      return key(a) < key(b);
    });
    std::ostringstream text;
    text.imbue(std::locale::classic());
    for (std::size_t i = 0; i < std::min(most, order.size()); ++i)
      {
        const auto &[low, high] = boxes[parts[order[i]]].get_boundary_points();
        text << (i == 0 ? "" : ", ") << "the part of body '" << places[order[i]].first
             << "' between (" << low[0] << ", " << low[1] << ", " << low[2] << ") and (" << high[0]
             << ", " << high[1] << ", " << high[2] << ")";
      }
    if (order.size() > most)
      text << " and " << order.size() - most << " more";
    return text.str();
  }
} // namespace Touchstone
