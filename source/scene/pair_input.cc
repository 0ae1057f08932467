// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/scene/pair_input.h>
#include <touchstone/scene/scene.h>

#include <algorithm>

namespace Touchstone
{
  ContactPairInput
  pair_input(const Scene       &scene,
             const Forest      &forest,
             const Solid       &solid,
             const unsigned int number)
  {
    const ContactPairParameters &parameters = scene.pairs[number];
    ContactPairInput             input{parameters, nullptr, solid, forest};
    input.number     = number;
    input.slave_body = scene.body_index(parameters.slave_body);
    // Young's modulus of the softer body scales contact forces: c = E A/h, doc/theory.md 5.
    input.modulus  = scene.bodies[input.slave_body].material.young_modulus;
    input.end_time = parameters.ramp_end > 0. ? parameters.ramp_end : scene.load_stepping.end_time;
    input.run_end  = scene.load_stepping.end_time;
    // Explicit steps know of edges by their own search, see GeneralContact.
    input.in_cycles = scene.time_integration.runs_in_cycles();
    input.edges     = !input.in_cycles;

    input.one_of_several = scene.pairs.size() > 1;
    for (const ObstacleParameters &obstacle : scene.obstacles)
      if (obstacle.name == parameters.obstacle)
        input.obstacle = &obstacle;
    // Obstacles are rigid and have no modulus.
    if (input.obstacle == nullptr)
      {
        input.master_body = scene.body_index(parameters.master_body);
        input.modulus =
          std::min(input.modulus, scene.bodies[input.master_body].material.young_modulus);
      }
    return input;
  }



  std::vector<ContactPairInput>
  pair_inputs(const Scene &scene, const Forest &forest, const Solid &solid)
  {
    std::vector<ContactPairInput> result;
    for (unsigned int p = 0; p < scene.pairs.size(); ++p)
      result.push_back(pair_input(scene, forest, solid, p));
    return result;
  }



  ImpactSurfaceInput
  general_contact_input(const Scene &scene, const Forest &forest)
  {
    const GeneralContactParameters &general = scene.general.front();
    ImpactSurfaceInput              input;
    input.bodies.resize(scene.bodies.size());
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      {
        const BodyParameters &body = scene.bodies[b];
        if (!general.all_bodies() &&
            std::find(general.bodies.begin(), general.bodies.end(), body.name) ==
              general.bodies.end())
          continue;
        ImpactSurfaceInput::Boundaries &of = input.bodies[b];
        of.all_but                         = general.all_boundaries();
        of.symmetry = forest.boundaries(b, body.symmetry, body.section(), "Symmetry");
        // What lies beyond a plane of symmetry is the mirrored half of the body.
        of.ids =
          of.all_but
            ? forest.boundary_ids(b, body.symmetry, body.section(), "Symmetry")
            : forest.boundary_ids(b, general.boundaries, general.section(), "Slave boundaries");
      }
    for (const ContactPairParameters &pair : scene.pairs)
      if (pair.obstacle.empty())
        input.declared.emplace_back(forest.boundary_ids(scene.body_index(pair.slave_body),
                                                        pair.slave_boundaries,
                                                        pair.section(),
                                                        "Slave boundaries"),
                                    forest.boundary_ids(scene.body_index(pair.master_body),
                                                        pair.master_boundaries,
                                                        pair.section(),
                                                        "Master boundaries"));
    return input;
  }
} // namespace Touchstone
