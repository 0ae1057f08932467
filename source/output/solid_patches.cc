// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/solid_patches.h>

#include <deal.II/base/quadrature_lib.h>

/**
 * @file
 * deal.II's DataOut evaluates finite elements at the nodes of each cell, and makes all patches
 * before it writes the first: at 600,000 unknowns that took five times as long and 600 MB
 * (doc/benchmarks.md). Values at nodes are known as they are.
 */

namespace Touchstone
{
  SolidPatches::SolidPatches(const Solid &solid, const NodeNumbers &nodes)
    : solid(solid)
    , nodes(nodes)
    , next(solid.dof_handler.begin_active())
    , places(solid.mapping,
             solid.fe,
             dealii::QIterated<dim>(dealii::QTrapezoid<1>(), solid.fe.degree),
             dealii::update_quadrature_points)
  {
    to_next_owned();
  }



  void
  SolidPatches::to_next_owned()
  {
    while (!finished() && !next->is_locally_owned())
      ++next;
  }



  void
  SolidPatches::add(const std::string &name, const bool at_nodes, const std::vector<double> &values)
  {
    rows.push_back({name, at_nodes, {values.begin(), values.end()}});
    if (!at_nodes)
      return;
    // Written cells have nodes that other ranks own.
    AssertDimension(values.size(), nodes.n_owned());
    NodeNumbers::Field field = nodes.zero_field();
    std::copy(values.begin(), values.end(), field.begin());
    field.update_ghost_values();
    std::vector<float> &known = rows.back().values;
    for (std::size_t i = known.size(); i < nodes.n_known(); ++i)
      known.push_back(field.local_element(i));
  }



  void
  SolidPatches::join(const std::string &name, const unsigned int n_components)
  {
    namespace Interpretation = dealii::DataComponentInterpretation;
    ranges.emplace_back(rows.size() - n_components,
                        rows.size() - 1,
                        name,
                        n_components == dim ? Interpretation::component_is_part_of_vector
                                            : Interpretation::component_is_part_of_tensor);
  }



  std::vector<std::string>
  SolidPatches::get_dataset_names() const
  {
    std::vector<std::string> names;
    for (const Row &row : rows)
      names.push_back(row.name);
    return names;
  }



  void
  SolidPatches::make_next(const std::size_t most)
  {
    // Patches of the last turn keep their memory for this one.
    std::size_t n = 0;
    for (; n < most && !finished(); ++n)
      {
        if (n == patches.size())
          patches.emplace_back();
        fill(patches[n]);
        ++next;
        to_next_owned();
      }
    patches.resize(n);
  }



  /** The patch of the next cell. */
  void
  SolidPatches::fill(Patch &patch)
  {
    // Degree 2 has three nodes per direction, i.e. two subdivisions. The nodes of curved cells have
    // places of their own, which deal.II takes from the last rows.
    patch.n_subdivisions       = solid.fe.degree;
    patch.reference_cell       = dealii::ReferenceCells::get_hypercube<dim>();
    patch.points_are_available = solid.fe.degree > 1;
    for (const unsigned int v : next->vertex_indices())
      patch.vertices[v] = next->vertex(v);

    nodes.of_cell(next, of_cell);
    patch.data.reinit(rows.size() + (patch.points_are_available ? dim : 0), of_cell.size());
    for (unsigned int r = 0; r < rows.size(); ++r)
      for (unsigned int a = 0; a < of_cell.size(); ++a)
        patch.data(r, a) =
          rows[r].values[rows[r].at_nodes ? of_cell[a] : next->active_cell_index()];
    if (!patch.points_are_available)
      return;
    places.reinit(next);
    for (unsigned int a = 0; a < of_cell.size(); ++a)
      for (unsigned int d = 0; d < dim; ++d)
        patch.data(rows.size() + d, a) = places.quadrature_point(a)[d];
  }
} // namespace Touchstone
