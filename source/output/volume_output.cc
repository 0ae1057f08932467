// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/solid_patches.h>
#include <touchstone/output/volume_output.h>

#include <algorithm>

/**
 * @file
 * Output of the bodies: all fields are evaluated at the nodes or cells that a rank owns, and then
 * written cell by cell. Nodes are numbered at the first output after each change of the mesh. Only
 * owned cells are written by a rank.
 */

namespace Touchstone
{
  namespace
  {
    /** What single precision leaves of numbers. */
    std::vector<double>
    rests(std::vector<double> values)
    {
      for (double &value : values)
        value = FileSeries::rest(value);
      return values;
    }



    /** "xy" for the component of a tensor that is its second number. */
    std::string
    component_name(const unsigned int c)
    {
      constexpr char axes[] = "xyz";
      return {axes[c / dim], axes[c % dim]};
    }
  } // namespace



  bool
  VolumeOutput::has_components(const std::string &tensor) const
  {
    return std::any_of(fields.begin(), fields.end(), [&tensor](const auto &field) {
      return field.first == tensor + "_" + component_name(0);
    });
  }



  VolumeOutput::VolumeOutput(const Solid            &solid,
                             const OutputFolder     &folder,
                             const OutputParameters &parameters)
    : solid(solid)
    , files(FileSeries::make(parameters.format, folder, "solution"))
    , cell_values(parameters.cell_values())
  {
    // Stable sorting: fields of equal order stay sorted by name, as the registry gives them.
    for (const std::string &name : VolumeFieldRegistry::names())
      fields.emplace_back(name, VolumeFieldRegistry::make(name));
    std::stable_sort(fields.begin(), fields.end(), [](const auto &a, const auto &b) {
      return a.second->order() < b.second->order();
    });
  }



  void
  VolumeOutput::number_nodes()
  {
    if (nodes)
      return;
    nodes.emplace(solid);
    node_volume = nodes->zero_field();
    std::vector<unsigned int> of_cell;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          nodes->of_cell(cell, of_cell);
          const double volume = cell->measure();
          for (const unsigned int node : of_cell)
            node_volume.local_element(node) += volume;
        }
    // Those of cells of other ranks.
    node_volume.compress(dealii::VectorOperation::add);
  }



  std::vector<dealii::SymmetricTensor<2, dim>>
  VolumeOutput::node_stress(const std::vector<dealii::SymmetricTensor<2, dim>> &cell_stress) const
  {
    constexpr unsigned int n = dealii::SymmetricTensor<2, dim>::n_independent_components;

    std::array<NodeNumbers::Field, n> sums;
    for (NodeNumbers::Field &sum : sums)
      sum = nodes->zero_field();
    // Nodal stress as the mean of the cells at the node, weighted with their volumes: for one node
    // sum_K V_K sigma_K / sum_K V_K. Bodies share no nodes, so that averages at nodes never mix two
    // bodies across a contact.
    std::vector<unsigned int> of_cell;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          nodes->of_cell(cell, of_cell);
          const double volume = cell->measure();
          const auto  &stress = cell_stress[cell->active_cell_index()];
          for (const unsigned int node : of_cell)
            for (unsigned int c = 0; c < n; ++c)
              sums[c].local_element(node) += volume * stress.access_raw_entry(c);
        }
    for (NodeNumbers::Field &sum : sums)
      // Contributions of cells of other ranks.
      sum.compress(dealii::VectorOperation::add);

    std::vector<dealii::SymmetricTensor<2, dim>> result(nodes->n_owned());
    for (std::size_t i = 0; i < result.size(); ++i)
      for (unsigned int c = 0; c < n; ++c)
        result[i].access_raw_entry(c) = sums[c].local_element(i) / node_volume.local_element(i);
    return result;
  }



  std::array<Vector, 2>
  VolumeOutput::nodal_stress(const Vector &displacement)
  {
    number_nodes();
    const auto          stress = node_stress(solid.cell_stress(displacement));
    std::vector<double> normal, shear;
    for (const dealii::SymmetricTensor<2, dim> &one : stress)
      {
        normal.insert(normal.end(), {one[0][0], one[1][1], one[2][2]});
        shear.insert(shear.end(), {one[0][1], one[1][2], one[0][2]});
      }
    return {{vector_field(normal), vector_field(shear)}};
  }



  Vector
  VolumeOutput::vector_field(const std::vector<double> &values) const
  {
    Vector field(solid.zero_vector());
    std::copy(values.begin(), values.end(), field.begin());
    return solid.ghosted(field);
  }



  void
  VolumeOutput::add_components(const std::string         &name,
                               const bool                 at_nodes,
                               const unsigned int         n_components,
                               const std::vector<double> &values,
                               const bool                 rest,
                               SolidPatches              &patches) const
  {
    // The format finds the rest of each set of numbers by the name of this set.
    const auto set = [rest](const std::string &name) {
      return rest ? FileSeries::rest_name(name) : name;
    };
    const bool          tensor = n_components == dim * dim;
    const bool          joined = n_components == dim || (tensor && files->has_tensors());
    std::vector<double> one(values.size() / n_components);
    for (unsigned int c = 0; c < n_components; ++c)
      {
        for (std::size_t i = 0; i < one.size(); ++i)
          one[i] = values[n_components * i + c];
        patches.add(set(tensor && !joined ? name + "_" + component_name(c) : name), at_nodes, one);
      }
    if (joined)
      patches.join(set(name), n_components);
  }



  void
  VolumeOutput::add_field(const std::string         &name,
                          const bool                 at_nodes,
                          const unsigned int         n_components,
                          const std::vector<double> &values,
                          SolidPatches              &patches) const
  {
    if (n_components == dim * dim && !files->has_tensors() && has_components(name))
      return;
    add_components(name, at_nodes, n_components, values, /*rest=*/false, patches);
    if (files->has_doubles())
      add_components(name, at_nodes, n_components, rests(values), /*rest=*/true, patches);
  }



  void
  VolumeOutput::write(const Vector      &displacement,
                      const Vector      *velocity,
                      const unsigned int step,
                      const double       time,
                      const Vector      *reaction)
  {
    number_nodes();
    const auto        cell_stress = solid.cell_stress(displacement);
    const auto        stress      = node_stress(cell_stress);
    const VolumeState state{
      solid, displacement, velocity, reaction, time, stress, cell_stress, cell_values};
    const std::size_t n_nodes = nodes->n_owned();
    // Cell fields have entries for ghost cells, too; those are not written.
    const std::size_t n_cells = solid.dof_handler.get_triangulation().n_active_cells();

    SolidPatches patches(solid, *nodes);
    for (const auto &[name, field] : fields)
      if (field->available(state))
        {
          const bool          at_nodes = field->location() == VolumeField::Location::nodes;
          std::vector<double> values((at_nodes ? n_nodes : n_cells) * field->n_components());
          field->evaluate(state, values);
          add_field(name, at_nodes, field->n_components(), values, patches);
        }

    patches.flags.time  = time;
    patches.flags.cycle = step;
    // Output of equal runs is equal byte by byte.
    patches.flags.print_date_and_time = false;
    patches.flags.compression_level   = dealii::DataOutBase::VtkFlags::best_speed;
    // Quadratic cells are written as such: linear pieces of them would show kinks.
    patches.flags.write_higher_order_cells = (solid.fe.degree > 1);
    files->write(patches, step, time);
  }
} // namespace Touchstone
