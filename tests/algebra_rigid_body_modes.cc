// SPDX-License-Identifier: LGPL-2.1-or-later
// What bodies can do without resistance under given supports and contacts, in
// words; and that the modes are motions without energy.

#include <touchstone/scene/scene.h>
#include <touchstone/solid/boundary_conditions.h>
#include <touchstone/solid/rigid_body_modes.h>

#include "mesh_common.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string scene_text = R"(
set Bodies = lower, upper
subsection Body lower
  subsection Geometry
    set Cells = 2, 2, 2
  end
  subsection Material
    set Young modulus = 1000
  end
end
subsection Body upper
  subsection Geometry
    set Lower corner = 3, 0, 1
    set Upper corner = 4, 2, 5
    set Cells        = 1, 2, 3
  end
  subsection Material
    set Young modulus = 10
  end
end
)";

  Condition
  contact(const unsigned int    body,
          const unsigned int    master,
          const Tensor<1, dim> &normal,
          const Tensor<1, dim> &position)
  {
    Condition condition;
    condition.node      = 0;
    condition.direction = normal;
    condition.body      = body;
    condition.position  = position;
    if (master != body)
      {
        condition.master_body     = master;
        condition.master_position = position;
        condition.stencil         = {{1, 1.}};
      }
    return condition;
  }

  void
  print(const std::string              &what,
        const std::vector<std::string> &overrides,
        const std::vector<Condition>   &contacts = {})
  {
    const MPI_Comm communicator = MPI_COMM_WORLD;
    const bool     first        = Utilities::MPI::this_mpi_process(communicator) == 0;
    const Scene    scene(scene_text, "scene.prm", overrides);
    const Forest   forest(scene.forest_input(), "", communicator);
    Solid          solid(scene.bodies, scene.discretisation.degree, forest, communicator);
    solid.assemble();
    const BoundaryConditions boundary_conditions(forest, solid);
    const RigidBodyModes     modes(solid);

    Touchstone::Vector u(solid.owned, communicator);
    ConstraintGraph    graph;
    boundary_conditions.prescribe(1., u, graph);
    std::vector<Condition> conditions = graph.accepted();
    if (first)
      conditions.insert(conditions.end(), contacts.begin(), contacts.end());
    const FreeMotion motion = modes.free_motion(conditions);
    if (first)
      std::cout << what << ": " << motion.n_modes << " free motions of " << motion.bodies.size()
                << " bodies. " << motion.description << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                fix_upper = "Body upper/Fixed=top";
  const auto lower = [](const std::string &value) { return "Body lower/Symmetry=" + value; };

  print("both fixed", {fix_upper, "Body lower/Fixed=left"});
  print("nothing held", {});
  print("lower body free", {fix_upper});
  print("held in x", {fix_upper, lower("left")});
  print("held in x and y", {fix_upper, lower("left, front")});
  print("held in x, y, z", {fix_upper, lower("left, front, bottom")});
  print("upper body held in z alone", {"Body upper/Symmetry=bottom", "Body lower/Fixed=left"});

  const Tensor<1, dim>   x({1., 0., 0.}), y({0., 1., 0.}), z({0., 0., 1.});
  std::vector<Condition> three = {contact(0, 0, z, Tensor<1, dim>({0., 0., 0.})),
                                  contact(0, 0, z, Tensor<1, dim>({1., 0., 0.})),
                                  contact(0, 0, z, Tensor<1, dim>({0., 1., 0.}))};
  print("on an obstacle by three nodes", {fix_upper}, three);
  three.pop_back();
  print("on an obstacle by two nodes", {fix_upper}, three);
  three.pop_back();
  print("on an obstacle by one node, in the corner", {fix_upper}, three);
  print("on the upper body by one node",
        {fix_upper, lower("left, front")},
        {contact(0, 1, z, Tensor<1, dim>({0.5, 0.5, 1.}))});
  print("two free bodies, one node between them",
        {},
        {contact(0, 1, x, Tensor<1, dim>({0.5, 0.5, 1.}))});

  // The modes are in the null space of the stiffness.
  const MPI_Comm communicator = MPI_COMM_WORLD;
  const Scene    scene(scene_text, "scene.prm", {});
  const Forest   forest(scene.forest_input(), "", communicator);
  Solid          solid(scene.bodies, scene.discretisation.degree, forest, communicator);
  solid.assemble();
  const RigidBodyModes modes(solid);
  Epetra_MultiVector   motions(solid.stiffness().rows(), 6), product(motions);
  for (unsigned int k = 0; k < 6; ++k)
    {
      for (int i = 0; i < motions.MyLength(); ++i)
        motions[k][i] = modes.motions()(k, i);
      solid.stiffness().multiply(product[k], motions[k]);
    }
  double largest[6], length[6];
  product.NormInf(largest);
  motions.Norm2(length);
  double worst = 0., shortest = 1e300;
  for (unsigned int k = 0; k < 6; ++k)
    {
      worst    = std::max(worst, largest[k] / 1000.);
      shortest = std::min(shortest, length[k]);
    }
  if (Utilities::MPI::this_mpi_process(communicator) == 0)
    std::cout << "forces of rigid motions " << small(worst)
              << (shortest > 1. ? "" : ", no motion FAILED") << std::endl;
  return 0;
}
