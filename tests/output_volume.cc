// SPDX-License-Identifier: LGPL-2.1-or-later
// VTU output of the bodies and the uniform-stress reference: two boxes on top of
// each other with the exact displacement of a uniform stress, for both degrees.

#include <touchstone/output/volume_output.h>
#include <touchstone/verification/point_displacement.h>
#include <touchstone/verification/uniform_stress.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <filesystem>
#include <fstream>
#include <iostream>

using namespace Touchstone;

namespace
{
  const std::string text = R"(
set Bodies = lower, upper
subsection Discretisation
  set Degree = DEGREE
end
subsection Body lower
  subsection Geometry
    set Type = box
    set Lower corner = 0, 0, 0
    set Upper corner = 1, 1, 1
    set Cells = CELLS
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.25
  end
end
subsection Body upper
  subsection Geometry
    set Type = box
    set Lower corner = 0, 0, 1
    set Upper corner = 1, 1, 2
    set Cells = 3, 3, 1
  end
  subsection Material
    set Young modulus = 2000
    set Poisson ratio = 0
  end
end
subsection Reference solution
  set Type = uniform stress
  set Values = szz: -10
end
)";

  /** Displacement by body and position under the stress szz = -10. */
  dealii::Tensor<1, dim>
  exact(const unsigned int body, const dealii::Point<dim> &x)
  {
    if (body == 0)
      return dealii::Tensor<1, dim>({0.0025 * x[0], 0.0025 * x[1], -0.01 * x[2]});
    return dealii::Tensor<1, dim>({0., 0., -0.01 - 0.005 * (x[2] - 1.)});
  }



  void
  run(const std::string &degree, const std::string &cells, const MPI_Comm communicator)
  {
    std::string scene_text = text;
    scene_text.replace(scene_text.find("DEGREE"), 6, degree);
    scene_text.replace(scene_text.find("CELLS"), 5, cells);
    const Scene        scene(scene_text, "test.prm", {});
    const Forest       forest(scene.forest_input(), ".", communicator);
    const Solid        solid(scene.bodies, scene.discretisation.degree, forest, communicator);
    const OutputFolder folder("volume_test", communicator);

    Vector                        owned(solid.owned, communicator);
    const dealii::Quadrature<dim> nodes(solid.fe.base_element(0).get_unit_support_points());
    dealii::FEValues<dim>         fe_values(solid.mapping,
                                    solid.fe,
                                    nodes,
                                    dealii::update_quadrature_points);
    std::vector<Index>            dofs(solid.fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          fe_values.reinit(cell);
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (solid.owned.is_element(dofs[i]))
              {
                const auto [component, node] = solid.fe.system_to_component_index(i);
                owned(dofs[i]) =
                  exact(cell->material_id(), fe_values.quadrature_point(node))[component];
              }
        }
    owned.compress(dealii::VectorOperation::insert);
    Vector displacement(solid.owned, solid.relevant, communicator);
    displacement = owned;

    ReferenceInput input;
    input.solid        = &solid;
    input.displacement = &displacement;
    input.communicator = communicator;
    const auto errors  = scene.reference.type.make(scene)->errors(input);
    if (folder.rank == 0)
      for (const auto &[name, error] : errors)
        std::cout << "degree " << degree << ": " << name
                  << (error < 1e-12 ? " vanishes" : " is wrong") << std::endl;

    const Scene point_scene(scene_text,
                            "test.prm",
                            {"Reference solution/Type=point displacement",
                             "Reference solution/Values=point x: 1, point y: 1, point z: 2, "
                             "displacement z: -0.03"});
    const auto  lines = point_scene.reference.type.make(point_scene)->compare(input).lines;

    VolumeOutput output(solid, folder);
    output.write(displacement, nullptr, 0, 0.);
    output.write(displacement, &displacement, 1, 0.5, &displacement);
    if (folder.rank == 0)
      {
        std::cout << lines.at(0) << std::endl;
        const std::string names[] = {"solution.pvd",
                                     folder.n_ranks == 1 ? "solution_0001.vtu"
                                                         : "solution_0001.pvtu"};
        for (const std::string &name : names)
          {
            std::ifstream file(folder.path(name));
            std::string   line;
            while (std::getline(file, line))
              for (const char *pattern : {"<DataSet", "<Piece", "<PDataArray type=\"F"})
                if (line.find(pattern) != std::string::npos)
                  std::cout << line << std::endl;
          }
        if (std::getenv("KEEP_VTU") == nullptr)
          std::filesystem::remove_all("volume_test");
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  run("1", "2, 2, 2", MPI_COMM_WORLD);
  run("2", "2, 2, 2", MPI_COMM_WORLD);
  // More cells than one piece of a file has.
  run("1", "11, 11, 11", MPI_COMM_WORLD);
  return 0;
}
