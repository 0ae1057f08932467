// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exact_sum.h>
#include <touchstone/base/input_error.h>
#include <touchstone/solid/node_sets.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>
#include <set>

// Sets of nodes on the present mesh. A set is known by the corners of the coarse cells in it
// (Forest::node_set()): a node is in the set if the corners that it is an average of are.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Cell = DoFHandler<dim>::active_cell_iterator;

    /** Which corners of the coarse cell around @p cell are in the set; takes points of the cell to
     * that cell. */
    class CoarseCell
    {
    public:
      CoarseCell(const Cell &cell, const Forest::NodeSet &set)
      {
        Triangulation<dim>::cell_iterator at(&cell->get_triangulation(),
                                             cell->level(),
                                             cell->index());
        for (; at->level() > 0; at = at->parent())
          for (unsigned int c = 0; c < at->parent()->n_children(); ++c)
            if (at->parent()->child(c) == at)
              children.push_back(c);
        for (unsigned int v = 0; v < 8; ++v)
          {
            const Point<dim> &x = at->vertex(v);
            corners[v]          = set.count({{x[0], x[1], x[2]}}) > 0;
            any                 = any || corners[v];
          }
      }

      /** Whether a point of the cell, in unit coordinates, belongs to the set. */
      bool
      contains(Point<dim> point) const
      {
        for (const unsigned int child : children)
          point = GeometryInfo<dim>::child_to_cell_coordinates(point, child);
        // Coordinates are multiples of powers of a half: there is no round-off.
        for (unsigned int v = 0; v < 8; ++v)
          if (!corners[v] && GeometryInfo<dim>::d_linear_shape_function(point, v) > 0.)
            return false;
        return true;
      }

      bool any = false;

    private:
      std::vector<unsigned int> children;
      std::array<bool, 8>       corners{};
    };

    /** Call @p use(cell, coarse cell) for the cells of this rank and their neighbours that a set
     * may touch. */
    template <class Use>
    void
    for_each_cell(const Solid           &solid,
                  const Forest::NodeSet &set,
                  const unsigned int     body,
                  const Use             &use)
    {
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (!cell->is_artificial() && cell->material_id() == body)
          if (const CoarseCell coarse(cell, set); coarse.any)
            use(cell, coarse);
    }
  } // namespace



  std::vector<SetNode>
  nodes_of_set(const Forest      &forest,
               const Solid       &solid,
               const unsigned int body,
               const std::string &name)
  {
    const auto          &fe = solid.fe;
    std::vector<SetNode> result;
    std::set<Index>      seen;
    std::vector<Index>   dofs(fe.n_dofs_per_cell());
    for_each_cell(
      solid, forest.node_set(body, name), body, [&](const Cell &cell, const CoarseCell &coarse) {
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (fe.system_to_component_index(i).first == 0 && solid.owned.is_element(dofs[i]) &&
              !solid.hanging.is_constrained(dofs[i]) && coarse.contains(fe.unit_support_point(i)) &&
              seen.insert(dofs[i]).second)
            result.push_back(
              {dofs[i] / dim,
               solid.mapping.transform_unit_to_real_cell(cell, fe.unit_support_point(i))});
      });
    return result;
  }



  void
  set_shares(const Solid          &solid,
             const Forest         &forest,
             const unsigned int    body,
             const std::string    &name,
             const std::string    &section,
             std::vector<SetNode> &nodes)
  {
    // Each edge once, with its nodes and their part of a constant force per length.
    const auto                               &fe = solid.fe;
    std::map<std::pair<Index, Index>, double> lengths;
    std::map<Index, ExactSum>                 shares;
    std::map<std::pair<Index, Index>, Index>  middles;
    std::vector<Index>                        dofs(fe.n_dofs_per_cell());
    int                                       whole_face = 0;
    for_each_cell(
      solid, forest.node_set(body, name), body, [&](const Cell &cell, const CoarseCell &coarse) {
        cell->get_dof_indices(dofs);
        const auto node_at = [&](const Point<dim> &point) {
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (fe.system_to_component_index(i).first == 0 &&
                fe.unit_support_point(i).distance(point) < 1e-6)
              return dofs[i];
          return invalid_index;
        };
        for (const unsigned int l : cell->line_indices())
          {
            const Point<dim> ends[2] = {
              GeometryInfo<dim>::unit_cell_vertex(GeometryInfo<dim>::line_to_cell_vertices(l, 0)),
              GeometryInfo<dim>::unit_cell_vertex(GeometryInfo<dim>::line_to_cell_vertices(l, 1))};
            const Point<dim> middle = ends[0] + 0.5 * (ends[1] - ends[0]);
            // An edge between two nodes of the set need not belong to it.
            if (!coarse.contains(middle))
              continue;
            const Index a = node_at(ends[0]), b = node_at(ends[1]);
            // Of the halves of an edge with a hanging node the edge itself is there, too.
            if (solid.hanging.is_constrained(a) || solid.hanging.is_constrained(b))
              continue;
            const auto key = std::minmax(a, b);
            lengths[key]   = cell->line(l)->vertex(0).distance(cell->line(l)->vertex(1));
            if (fe.degree == 2)
              middles[key] = node_at(middle);
          }
        for (const unsigned int f : cell->face_indices())
          {
            Point<dim> centre(0.5, 0.5, 0.5);
            centre[f / 2] = f % 2;
            whole_face |= coarse.contains(centre);
          }
      });
    if (Utilities::MPI::max(whole_face, solid.communicator) > 0)
      throw InputError(section,
                       "Force",
                       "",
                       "the set has all nodes of a face, over which no force per length is meant",
                       "name the boundary of these faces, whose 'Force' is spread over its area");
    for (const auto &[key, length] : lengths)
      {
        const double of_end = fe.degree == 2 ? length / 6. : length / 2.;
        shares[key.first].add(of_end);
        shares[key.second].add(of_end);
        if (fe.degree == 2)
          shares[middles.at(key)].add(4. * of_end);
      }
    const bool points =
      Utilities::MPI::max(static_cast<int>(!lengths.empty()), solid.communicator) == 0;
    ExactSum sum;
    int      alone = 0;
    for (SetNode &node : nodes)
      {
        const auto found = shares.find(dim * node.node);
        node.share       = points ? 1. : found != shares.end() ? found->second.value() : 0.;
        alone |= (node.share == 0.);
        sum.add(node.share);
      }
    if (Utilities::MPI::max(alone, solid.communicator) > 0)
      throw InputError(
        section,
        "Force",
        "",
        "the set has edges and single points, between which a force cannot be shared",
        "make a set of each");
    const double all = sum.value(solid.communicator);
    for (SetNode &node : nodes)
      node.share /= all;
  }



  void
  check_for_node_set(const BoundaryParameters &condition, const std::string &section)
  {
    const auto refuse = [&](const std::string &key, const std::string &value) {
      throw InputError(section,
                       key,
                       value,
                       "needs faces, but this is a set of nodes",
                       "take 'Displacement' or 'Force', or name a boundary");
    };
    for (const auto &[key, text] : condition.formulas())
      if (!text.empty() && key.rfind("Displacement", 0) != 0 && key.rfind("Force", 0) != 0)
        refuse(key, text);
    if (!condition.reference_point.empty())
      refuse("Reference point", Patterns::Tools::to_string(condition.reference_point));
    if (condition.spring_normal > 0.)
      refuse("Spring stiffness normal", Patterns::Tools::to_string(condition.spring_normal));
    if (condition.spring_tangential > 0.)
      refuse("Spring stiffness tangential",
             Patterns::Tools::to_string(condition.spring_tangential));
  }
} // namespace Touchstone
