// SPDX-License-Identifier: LGPL-2.1-or-later
// The stiffness does not depend on the number of ranks: symmetric, the same norm,
// the same energies. Three ranks are not two: only then has a rank columns of several
// others.

#include <touchstone/scene/scene.h>
#include <touchstone/solid/solid.h>

#include "mesh_common.h"
#include <cmath>

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string text = R"(
set Bodies = block, ball
subsection Body block
  subsection Geometry
    set Cells = 4, 3, 5
  end
  subsection Material
    set Young modulus = 2
  end
end
subsection Body ball
  subsection Geometry
    set Type   = ball
    set Centre = 5, 0, 0
  end
  subsection Material
    set Young modulus = 1
  end
end
)";

  void
  check(const std::string &law, const std::string &degree)
  {
    const Scene  scene(text,
                      "scene.prm",
                      {"Body ball/Material/Law=" + law, "Discretisation/Degree=" + degree});
    const Forest forest(scene.forest_input(), "", MPI_COMM_WORLD);
    Solid        solid(scene.bodies, scene.discretisation.degree, forest, MPI_COMM_WORLD);

    // Two small displacements as functions of the place.
    Touchstone::Vector x(solid.owned, MPI_COMM_WORLD), y(x), kx(x), ky(x);
    std::vector<Index> dofs(solid.fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (solid.owned.is_element(dofs[i]))
              {
                const Point<dim> p =
                  solid.mapping.transform_unit_to_real_cell(cell, solid.fe.unit_support_point(i));
                const double d = solid.fe.system_to_component_index(i).first;
                x(dofs[i])     = 1e-2 * std::sin(p[0] + 2. * p[1] + 3. * p[2] + d);
                y(dofs[i])     = 1e-2 * std::cos(3. * p[0] - p[1] + p[2] * p[2] - d);
              }
        }
    x.compress(VectorOperation::insert);
    y.compress(VectorOperation::insert);

    solid.assemble();
    solid.assemble(x);
    solid.stiffness().vmult(kx, x);
    solid.stiffness().vmult(ky, y);
    Touchstone::Vector force(x);
    solid.internal_force(x, force);
    const double norm = solid.stiffness().frobenius_norm(), product = kx * y,
                 asymmetry = (product - ky * x) / (kx.l2_norm() * y.l2_norm()),
                 energy = solid.strain_energy(x), work = force * y;
    const bool admissible = solid.admissible(x);
    x *= -300.;
    const bool inverted = !solid.admissible(x);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << law << ", degree " << degree << ": norm " << norm << ", product " << product
                << ", asymmetry " << small(asymmetry) << ", energy " << energy << ", work " << work
                << (admissible ? ", admissible" : ", inadmissible")
                << (inverted ? ", inverted" : ", never inverted") << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string law : {"linear elastic", "neo-Hookean"})
    for (const std::string degree : {"1", "2"})
      check(law, degree);
  return 0;
}
