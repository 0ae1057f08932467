// SPDX-License-Identifier: LGPL-2.1-or-later
// Force and moment on a boundary: nodal forces are statically equivalent, on plane and curved
// boundaries, of degree 1 and 2.

#include <touchstone/scene/scene.h>
#include <touchstone/solid/boundary_conditions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>

#include "mesh_common.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  void
  check_load(const std::string &name, const std::string &geometry, const std::string &boundary)
  {
    for (const unsigned int degree : {1, 2})
      for (const bool with_point : {false, true})
        {
          const Scene scene(
            "set Bodies = x\nsubsection Body x\nset Boundary conditions = " + boundary +
              "\nsubsection Geometry\n" + geometry + "end\nsubsection Material\n" +
              "set Young modulus = 1\nend\nsubsection Boundary " + boundary +
              "\nset Force x = 3*t\nset Force z = -2\nset Moment y = 5\nset Moment z = t^2\n" +
              (with_point ? "set Reference point = 7, -3, 2\n" : "") +
              "end\nend\nsubsection Discretisation\nset Degree = " + std::to_string(degree) +
              "\nend\n",
            "scene.prm",
            {});
          const Forest             forest(scene.forest_input(), ".", MPI_COMM_WORLD);
          const Solid              solid(scene.bodies, degree, forest, MPI_COMM_WORLD);
          const BoundaryConditions conditions(forest, solid);
          Touchstone::Vector u(solid.owned, MPI_COMM_WORLD), force(solid.owned, MPI_COMM_WORLD);
          conditions.external_force(2., u, force);

          std::map<types::global_dof_index, Point<dim>> points;
          DoFTools::map_dofs_to_support_points(solid.mapping, solid.dof_handler, points);
          Tensor<1, dim> sum, moment, centre;
          for (const auto dof : solid.owned)
            if (dof % dim == 0)
              {
                Tensor<1, dim> one;
                for (unsigned int d = 0; d < dim; ++d)
                  one[d] = force(dof + d);
                sum += one;
                moment += cross_product_3d(points.at(dof), one);
              }
          sum    = Utilities::MPI::sum(sum, MPI_COMM_WORLD);
          moment = Utilities::MPI::sum(moment, MPI_COMM_WORLD);
          const Tensor<1, dim> F({6., 0., -2.}), M({0., 5., 4.});
          // Without a point the moment about the origin is not known here; it is at right angles
          // to the force but for M.
          const double error =
            with_point ? (moment - M - cross_product_3d(Tensor<1, dim>({7., -3., 2.}), F)).norm()
                       : std::abs((moment - M) * F);
          if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
            std::cout << name << ", degree " << degree << (with_point ? ", at a point" : "")
                      << ": force " << small((sum - F).norm()) << ", moment " << small(error, 1e-10)
                      << std::endl;
        }
  }
} // namespace

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_load("box", "set Type = box\nset Cells = 2, 3, 2\n", "right");
  check_load("tube",
             "set Type = tube\nset Inner radius = 1\nset Outer radius = 2\nset Cells = 2, 6, 2\n",
             "outer");
  return 0;
}
