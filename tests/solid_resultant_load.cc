// SPDX-License-Identifier: LGPL-2.1-or-later
// Force and moment on a boundary: nodal forces are statically equivalent, on plane and curved
// boundaries, of degree 1 and 2; at finite strain also in bodies that have turned and deformed.

#include <touchstone/scene/scene.h>
#include <touchstone/solid/boundary_conditions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>

#include "mesh_common.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** A turn by 2 about an oblique axis and a shift, or this with a deformation after it. */
  Tensor<1, dim>
  moved(const Point<dim> &x, const bool deformed)
  {
    const Tensor<1, dim> axis({2. / 3., -1. / 3., 2. / 3.});
    Tensor<1, dim>       result = std::cos(2.) * x + std::sin(2.) * cross_product_3d(axis, x) +
                            (1. - std::cos(2.)) * (axis * x) * axis + Tensor<1, dim>({4., 5., -6.});
    if (deformed)
      for (unsigned int d = 0; d < dim; ++d)
        result[d] += 0.3 * x[d] + 0.1 * x[(d + 1) % dim] * x[(d + 1) % dim];
    return result;
  }

  /** Where the body is. */
  enum class State
  {
    reference,
    turned,
    deformed
  };

  void
  check_load(const std::string &name,
             const std::string &geometry,
             const std::string &boundary,
             const State        state)
  {
    for (const unsigned int degree : {1, 2})
      for (const bool with_point : {false, true})
        {
          const Scene  scene("set Bodies = x\nsubsection Body x\nset Boundary conditions = " +
                              boundary + "\nsubsection Geometry\n" + geometry +
                              "end\nsubsection Material\nset Young modulus = 1\n" +
                              (state != State::reference ? "set Law = neo-Hookean\n" : "") +
                              "end\nsubsection Boundary " + boundary +
                              "\nset Force x = 3*t\nset Force z = -2\nset Moment y = 5\n" +
                              "set Moment z = t^2\n" +
                              (with_point ? "set Reference point = 7, -3, 2\n" : "") +
                              "end\nend\nsubsection Discretisation\nset Degree = " +
                              std::to_string(degree) + "\nend\n",
                            "scene.prm",
                            {});
          const Forest forest(scene.forest_input(), ".", MPI_COMM_WORLD);
          const Solid  solid(scene.bodies, degree, forest, MPI_COMM_WORLD);
          const BoundaryConditions conditions(forest, solid);
          Touchstone::Vector u(solid.owned, MPI_COMM_WORLD), force(solid.owned, MPI_COMM_WORLD);
          std::map<types::global_dof_index, Point<dim>> points;
          DoFTools::map_dofs_to_support_points(solid.mapping, solid.dof_handler, points);
          const auto place = [&](const Point<dim> &x) {
            return state == State::reference ? Tensor<1, dim>(x)
                                             : moved(x, state == State::deformed);
          };
          for (const auto dof : solid.owned)
            u(dof) = place(points.at(dof))[dof % dim] - points.at(dof)[dof % dim];
          u.compress(VectorOperation::insert);
          conditions.external_force(2., u, force);

          Tensor<1, dim> sum, moment;
          for (const auto dof : solid.owned)
            if (dof % dim == 0)
              {
                Tensor<1, dim> one;
                for (unsigned int d = 0; d < dim; ++d)
                  one[d] = force(dof + d);
                sum += one;
                moment += cross_product_3d(place(points.at(dof)), one);
              }
          sum    = Utilities::MPI::sum(sum, MPI_COMM_WORLD);
          moment = Utilities::MPI::sum(moment, MPI_COMM_WORLD);
          const Tensor<1, dim> F({6., 0., -2.}), M({0., 5., 4.});
          // Where the moment about the origin is not known here it is at right angles to the force
          // but for M: without a point, and in a deformed body.
          const double error =
            with_point && state != State::deformed
              ? (moment - M - cross_product_3d(place(Point<dim>(7., -3., 2.)), F)).norm()
              : std::abs((moment - M) * F);
          if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
            std::cout << name << ", degree " << degree << (with_point ? ", at a point" : "")
                      << (state == State::turned     ? ", turned"
                          : state == State::deformed ? ", deformed"
                                                     : "")
                      << ": force "
                      << small((sum - F).norm(), state == State::reference ? 1e-12 : 1e-11)
                      << ", moment " << small(error, 1e-10) << std::endl;
        }
  }
} // namespace

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const State state : {State::reference, State::turned, State::deformed})
    {
      check_load("box", "set Type = box\nset Cells = 2, 3, 2\n", "right", state);
      check_load(
        "tube",
        "set Type = tube\nset Inner radius = 1\nset Outer radius = 2\nset Cells = 2, 6, 2\n",
        "outer",
        state);
    }
  return 0;
}
