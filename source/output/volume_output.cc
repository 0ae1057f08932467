// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/volume_output.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/data_out.h>

#include <algorithm>
#include <list>
#include <tuple>

/**
 * @file
 * Output of the bodies. Scalar nodal fields have a numbering of their own, with one dof per
 * node. It is made at the first output after each change of the mesh (reinit()). Only owned cells
 * are written by a rank.
 */

namespace Touchstone
{
  namespace
  {
    /** DataOut that joins scalars called NAME_0 to NAME_8 to a tensor. */
    class TensorDataOut : public dealii::DataOut<dim>
    {
    public:
      std::vector<std::string> tensors;

    private:
      using Ranges =
        std::vector<std::tuple<unsigned int,
                               unsigned int,
                               std::string,
                               dealii::DataComponentInterpretation::DataComponentInterpretation>>;

      Ranges
      get_nonscalar_data_ranges() const override
      {
        Ranges     ranges = dealii::DataOut<dim>::get_nonscalar_data_ranges();
        const auto names  = get_dataset_names();
        for (const std::string &tensor : tensors)
          {
            const unsigned int first =
              std::find(names.begin(), names.end(), tensor + "_0") - names.begin();
            ranges.emplace_back(first,
                                first + dim * dim - 1,
                                tensor,
                                dealii::DataComponentInterpretation::component_is_part_of_tensor);
          }
        // The writers go through them in the order of the components.
        std::sort(ranges.begin(), ranges.end());
        return ranges;
      }
    };



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



  /** The fields of a file; elements of a list do not move when further ones are added: DataOut
   * keeps pointers to the vectors until the patches are built. */
  struct VolumeOutput::Written
  {
    std::list<NodeField>              scalars;
    std::list<Vector>                 vectors;
    std::list<dealii::Vector<double>> cells;
    TensorDataOut                     data_out;
  };



  VolumeOutput::VolumeOutput(const Solid            &solid,
                             const OutputFolder     &folder,
                             const OutputParameters &parameters)
    : solid(solid)
    , node_fe(solid.fe.degree)
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
    // One scalar dof per node. Bodies share no nodes, so that averages at nodes never mix two
    // bodies across a contact.
    node_dofs.reinit(solid.dof_handler.get_triangulation());
    node_dofs.distribute_dofs(node_fe);
    node_volume = make_node_field();
    node_in_solid.resize(node_volume.locally_owned_size());

    const dealii::IndexSet &owned = node_dofs.locally_owned_dofs();
    std::vector<Index>      nodes(node_fe.n_dofs_per_cell()), dofs(solid.fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      // Ghost cells are visited for the numbering alone: volumes are summed over owned cells, and
      // then added up over the ranks.
      if (!cell->is_artificial())
        {
          // The same cell as seen by the other DoFHandler.
          const dealii::DoFHandler<dim>::active_cell_iterator node_cell(
            &node_dofs.get_triangulation(), cell->level(), cell->index(), &node_dofs);
          node_cell->get_dof_indices(nodes);
          cell->get_dof_indices(dofs);
          const double volume = cell->is_locally_owned() ? cell->measure() : 0.;
          for (unsigned int a = 0; a < nodes.size(); ++a)
            {
              if (cell->is_locally_owned())
                node_volume(nodes[a]) += volume;
              if (owned.is_element(nodes[a]))
                // Index of the node among the owned nodes of the solid: both numberings have the
                // same owner for each node, but not the same order.
                node_in_solid[owned.index_within_set(nodes[a])] =
                  solid.owned.index_within_set(dofs[solid.fe.component_to_system_index(0, a)]) /
                  dim;
            }
        }
    node_volume.compress(dealii::VectorOperation::add);
  }



  VolumeOutput::NodeField
  VolumeOutput::make_node_field() const
  {
    dealii::IndexSet relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(node_dofs, relevant);
    return NodeField(node_dofs.locally_owned_dofs(), relevant, solid.communicator);
  }



  std::vector<dealii::SymmetricTensor<2, dim>>
  VolumeOutput::node_stress(const std::vector<dealii::SymmetricTensor<2, dim>> &cell_stress) const
  {
    constexpr unsigned int n = dealii::SymmetricTensor<2, dim>::n_independent_components;

    std::array<NodeField, n> sums;
    for (NodeField &sum : sums)
      sum = make_node_field();
    // Nodal stress as the mean of the cells at the node, weighted with their volumes: for one node
    // sum_K V_K sigma_K / sum_K V_K.
    std::vector<Index> nodes(node_fe.n_dofs_per_cell());
    for (const auto &cell : node_dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(nodes);
          const double volume = cell->measure();
          const auto  &stress = cell_stress[cell->active_cell_index()];
          for (const Index node : nodes)
            for (unsigned int c = 0; c < n; ++c)
              sums[c](node) += volume * stress.access_raw_entry(c);
        }
    for (NodeField &sum : sums)
      // Contributions of cells of other ranks.
      sum.compress(dealii::VectorOperation::add);

    std::vector<dealii::SymmetricTensor<2, dim>> result(node_in_solid.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      for (unsigned int c = 0; c < n; ++c)
        result[node_in_solid[i]].access_raw_entry(c) =
          sums[c].local_element(i) / node_volume.local_element(i);
    return result;
  }



  std::array<Vector, 2>
  VolumeOutput::nodal_stress(const Vector &displacement)
  {
    if (!node_dofs.has_active_dofs())
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



  VolumeOutput::NodeField
  VolumeOutput::scalar_field(const std::vector<double> &values) const
  {
    NodeField field = make_node_field();
    for (std::size_t i = 0; i < node_in_solid.size(); ++i)
      field.local_element(i) = values[node_in_solid[i]];
    // Written cells have nodes that other ranks own.
    field.update_ghost_values();
    return field;
  }



  Vector
  VolumeOutput::vector_field(const std::vector<double> &values) const
  {
    Vector field(solid.zero_vector());
    std::copy(values.begin(), values.end(), field.begin());
    return solid.ghosted(field);
  }



  void
  VolumeOutput::add_scalar(const std::string         &name,
                           const bool                 at_nodes,
                           const std::vector<double> &values,
                           Written                   &written) const
  {
    const auto add = [&](const std::string &title, const std::vector<double> &numbers) {
      if (at_nodes)
        {
          written.scalars.push_back(scalar_field(numbers));
          written.data_out.add_data_vector(node_dofs, written.scalars.back(), title);
        }
      else
        {
          written.cells.emplace_back(numbers.begin(), numbers.end());
          written.data_out.add_data_vector(written.cells.back(),
                                           title,
                                           dealii::DataOut<dim>::type_cell_data);
        }
    };
    add(name, values);
    if (files->has_doubles())
      add(FileSeries::rest_name(name), rests(values));
  }



  void
  VolumeOutput::add_vector(const std::string         &name,
                           const std::vector<double> &values,
                           Written                   &written) const
  {
    namespace Interpretation = dealii::DataComponentInterpretation;
    const auto add           = [&](const std::string &title, const std::vector<double> &numbers) {
      written.vectors.push_back(vector_field(numbers));
      written.data_out.add_data_vector(solid.dof_handler,
                                       written.vectors.back(),
                                       std::vector<std::string>(dim, title),
                                       std::vector<Interpretation::DataComponentInterpretation>(
                                         dim, Interpretation::component_is_part_of_vector));
    };
    add(name, values);
    if (files->has_doubles())
      add(FileSeries::rest_name(name), rests(values));
  }



  void
  VolumeOutput::add_field(const std::string         &name,
                          const bool                 at_nodes,
                          const unsigned int         n_components,
                          const std::vector<double> &values,
                          Written                   &written) const
  {
    if (n_components == 1)
      add_scalar(name, at_nodes, values, written);
    else if (n_components == dim)
      add_vector(name, values, written);
    else if (files->has_tensors() || !has_components(name))
      {
        // A scalar for each component, which together are a tensor to the viewer.
        if (files->has_tensors())
          written.data_out.tensors.push_back(name);
        std::vector<double> component(values.size() / n_components);
        for (unsigned int c = 0; c < n_components; ++c)
          {
            for (std::size_t i = 0; i < component.size(); ++i)
              component[i] = values[n_components * i + c];
            add_scalar(name + "_" + (files->has_tensors() ? std::to_string(c) : component_name(c)),
                       at_nodes,
                       component,
                       written);
          }
      }
  }



  void
  VolumeOutput::write(const Vector      &displacement,
                      const Vector      *velocity,
                      const unsigned int step,
                      const double       time,
                      const Vector      *reaction)
  {
    if (!node_dofs.has_active_dofs())
      number_nodes();
    const auto        cell_stress = solid.cell_stress(displacement);
    const auto        stress      = node_stress(cell_stress);
    const VolumeState state{
      solid, displacement, velocity, reaction, time, stress, cell_stress, cell_values};
    const std::size_t n_nodes = node_in_solid.size();
    // Cell fields have entries for ghost cells, too, since deal.II indexes them by active cell;
    // those are not written.
    const std::size_t n_cells = node_dofs.get_triangulation().n_active_cells();

    Written written;
    for (const auto &[name, field] : fields)
      if (field->available(state))
        {
          const bool          at_nodes = field->location() == VolumeField::Location::nodes;
          std::vector<double> values((at_nodes ? n_nodes : n_cells) * field->n_components());
          field->evaluate(state, values);
          add_field(name, at_nodes, field->n_components(), values, written);
        }

    TensorDataOut                &data_out = written.data_out;
    dealii::DataOutBase::VtkFlags flags;
    flags.time  = time;
    flags.cycle = step;
    // Output of equal runs is equal byte by byte.
    flags.print_date_and_time = false;
    flags.compression_level   = dealii::DataOutBase::VtkFlags::best_speed;
    // Quadratic cells are written as such: linear pieces of them would show kinks.
    flags.write_higher_order_cells = (solid.fe.degree > 1);
    data_out.set_flags(flags);
    data_out.build_patches(solid.mapping,
                           solid.fe.degree,
                           dealii::DataOut<dim>::curved_inner_cells);

    files->write(data_out, step, time);
  }
} // namespace Touchstone
