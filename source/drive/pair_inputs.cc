#include <touchstone/drive/pair_inputs.h>

#include <algorithm>

namespace Touchstone
{
  std::vector<ContactPairInput>
  pair_inputs(const Scene &scene, const Forest &forest, const Solid &solid)
  {
    std::vector<ContactPairInput> result;
    for (const ContactPairParameters &parameters : scene.pairs)
      {
        ContactPairInput input{parameters, nullptr, solid, forest};
        input.number     = result.size();
        input.slave_body = scene.body_index(parameters.slave_body);
        input.modulus    = scene.bodies[input.slave_body].material.young_modulus;
        input.end_time   = scene.load_stepping.end_time;
        for (const ObstacleParameters &obstacle : scene.obstacles)
          if (obstacle.name == parameters.obstacle)
            input.obstacle = &obstacle;
        if (input.obstacle == nullptr)
          {
            input.master_body = scene.body_index(parameters.master_body);
            input.modulus =
              std::min(input.modulus, scene.bodies[input.master_body].material.young_modulus);
          }
        result.push_back(input);
      }
    return result;
  }
} // namespace Touchstone
