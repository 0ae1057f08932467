#include <touchstone/output/volume_output.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/data_out.h>

#include <cmath>

namespace Touchstone
{
  VolumeOutput::VolumeOutput(const Solid &solid, const OutputFolder &folder)
    : solid(solid)
    , node_fe(solid.fe.degree)
    , pictures(folder, "solution")
  {
  }



  void
  VolumeOutput::number_nodes()
  {
    node_dofs.reinit(solid.dof_handler.get_triangulation());
    node_dofs.distribute_dofs(node_fe);
    node_volume = make_node_field();

    std::vector<Index> nodes(node_fe.n_dofs_per_cell());
    for (const auto &cell : node_dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(nodes);
          const double volume = cell->measure();
          for (const Index node : nodes)
            node_volume(node) += volume;
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



  std::array<VolumeOutput::NodeField, 8>
  VolumeOutput::node_stress(const Vector &displacement) const
  {
    static const unsigned int row[6]    = {0, 1, 2, 0, 1, 0};
    static const unsigned int column[6] = {0, 1, 2, 1, 2, 2};

    std::array<NodeField, 8> fields;
    for (NodeField &field : fields)
      field = make_node_field();

    const auto         cell_stress = solid.cell_stress(displacement);
    std::vector<Index> nodes(node_fe.n_dofs_per_cell());
    for (const auto &cell : node_dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(nodes);
          const double volume = cell->measure();
          const auto  &stress = cell_stress[cell->active_cell_index()];
          for (const Index node : nodes)
            for (unsigned int c = 0; c < 6; ++c)
              fields[c](node) += volume * stress[row[c]][column[c]];
        }
    for (unsigned int c = 0; c < 6; ++c)
      fields[c].compress(dealii::VectorOperation::add);

    for (unsigned int i = 0; i < node_volume.locally_owned_size(); ++i)
      {
        dealii::SymmetricTensor<2, dim> stress;
        for (unsigned int c = 0; c < 6; ++c)
          {
            fields[c].local_element(i) /= node_volume.local_element(i);
            stress[row[c]][column[c]] = fields[c].local_element(i);
          }
        fields[6].local_element(i) = std::sqrt(1.5) * dealii::deviator(stress).norm();
        fields[7].local_element(i) = -dealii::trace(stress) / 3.;
      }
    for (NodeField &field : fields)
      field.update_ghost_values();
    return fields;
  }



  void
  VolumeOutput::write(const Vector      &displacement,
                      const Vector      *velocity,
                      const unsigned int step,
                      const double       time)
  {
    static const std::string names[8] = {"stress_xx",
                                         "stress_yy",
                                         "stress_zz",
                                         "stress_xy",
                                         "stress_yz",
                                         "stress_xz",
                                         "von_mises",
                                         "hydrostatic_pressure"};

    if (!node_dofs.has_active_dofs())
      number_nodes();
    const auto             fields        = node_stress(displacement);
    const auto            &triangulation = node_dofs.get_triangulation();
    dealii::Vector<double> body(triangulation.n_active_cells());
    dealii::Vector<double> rank(triangulation.n_active_cells());
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          body(cell->active_cell_index()) = cell->material_id();
          rank(cell->active_cell_index()) = cell->subdomain_id();
        }

    dealii::DataOut<dim> data_out;
    const auto           add_vectors = [&](const Vector &field, const std::string &name) {
      data_out.add_data_vector(
        solid.dof_handler,
        field,
        std::vector<std::string>(dim, name),
        std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>(
          dim, dealii::DataComponentInterpretation::component_is_part_of_vector));
    };
    add_vectors(displacement, "displacement");
    if (velocity != nullptr)
      add_vectors(*velocity, "velocity");
    for (unsigned int c = 0; c < fields.size(); ++c)
      data_out.add_data_vector(node_dofs, fields[c], names[c]);
    dealii::Vector<double> plastic_strain;
    if (solid.has_history())
      {
        plastic_strain = solid.cell_plastic_strain();
        data_out.add_data_vector(plastic_strain,
                                 "equivalent_plastic_strain",
                                 dealii::DataOut<dim>::type_cell_data);
      }
    data_out.add_data_vector(body, "body", dealii::DataOut<dim>::type_cell_data);
    data_out.add_data_vector(rank, "rank", dealii::DataOut<dim>::type_cell_data);

    dealii::DataOutBase::VtkFlags flags;
    flags.time                     = time;
    flags.cycle                    = step;
    flags.print_date_and_time      = false;
    flags.compression_level        = dealii::DataOutBase::VtkFlags::best_speed;
    flags.write_higher_order_cells = (solid.fe.degree > 1);
    data_out.set_flags(flags);
    data_out.build_patches(solid.mapping,
                           solid.fe.degree,
                           dealii::DataOut<dim>::curved_inner_cells);

    pictures.write(data_out, step, time);
  }
} // namespace Touchstone
