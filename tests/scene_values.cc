// SPDX-License-Identifier: LGPL-2.1-or-later
// What a scene holds after reading: values, overrides, defaults and automatic
// choices; and that the printed scene is the same scene.

#include "scene_support.h"

namespace
{
  void
  show(const Touchstone::Scene &scene)
  {
    std::cout << scene.title << ", " << scene.bodies.size() << " bodies\n";
    for (const auto &body : scene.bodies)
      {
        std::cout << body.name << ": " << body.geometry_type.name << ", "
                  << body.element_type.word() << ", E " << body.material.young_modulus << ", nu "
                  << body.material.poisson_ratio << ", fixed " << body.fixed.size() << '\n';
        for (const auto &[name, boundary] : body.boundaries)
          std::cout << "  " << name << ": pressure '" << boundary.pressure << "'\n";
      }
    for (const auto &obstacle : scene.obstacles)
      std::cout << obstacle.name << ": " << obstacle.shape.name << ", moves " << obstacle.motion_z
                << '\n';
    for (const auto &pair : scene.pairs)
      std::cout << pair.name << ": " << pair.slave_body << ' ' << pair.slave_boundaries.size()
                << " on " << pair.master_body << pair.obstacle << ", " << pair.behaviour.name
                << ", " << pair.sliding.word() << '\n';
    std::cout << "degree " << scene.discretisation.degree << ", steps " << scene.load_stepping.steps
              << ", tolerance " << scene.newton.residual_tolerance << ", "
              << scene.linear_solver.type << ", to " << scene.output.directory << '\n';
    for (const auto &[name, value] : scene.reference.numbers(""))
      std::cout << name << " = " << value << '\n';
    std::cout << std::endl;
  }
} // namespace

int
main()
{
  show(Touchstone::Scene(good_scene, "prm/blocks.v2.prm", {}));

  const Touchstone::Scene scene(good_scene,
                                "prm/blocks.prm",
                                {"Title=Other = blocks",
                                 "Discretisation/Degree = 2",
                                 "Load stepping / Steps=3",
                                 "Load stepping/Steps=4",
                                 "Contact pair between/Behaviour=tied",
                                 "Contact pair between/Slave boundaries=top, left",
                                 "Body upper/Element=full",
                                 "Reference solution/Values=radius: 10, p: -0.5",
                                 "Output/Directory=/tmp/x"});
  show(scene);
  std::cout << "upper is number " << scene.body_index("upper") << "\n\n";

  std::ostringstream printed, again;
  scene.print(printed);
  const Touchstone::Scene copy(printed.str(), "parameters.prm", {});
  copy.print(again);
  show(copy);
  std::cout << (printed.str() == again.str() ? "the same" : "another") << "\n\n";

  // The keys of the geometries are the business of their own tests.
  const std::string all = printed.str();
  std::cout << all.substr(0, all.find("  subsection Geometry")) << "...\n"
            << all.substr(all.find("subsection Obstacle"));
  return 0;
}
