// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/scene/free_motion_rules.h>
#include <touchstone/scene/scene.h>

// What an obstacle that is moved by forces needs of the rest of the scene (doc/theory.md 4.5).
namespace Touchstone
{
  using dealii::Patterns::Tools::to_string;

  namespace
  {
    /** Inertia is needed where it resists, and there alone. */
    void
    check_inertia(const Scene &scene, const ObstacleParameters &obstacle)
    {
      const FreeMotionParameters &free    = obstacle.free;
      const std::string           section = obstacle.section();
      const bool                  dynamic = scene.time_integration.dynamic();
      for (unsigned int c = 0; c < FreeMotionParameters::n_components; ++c)
        {
          if (dynamic && free.is_free(c) && !(free.resistance(c) > 0.))
            throw InputError(section,
                             c < 3 ? "Mass" : "Inertia",
                             c < 3 ? to_string(free.mass) : to_string(free.inertia),
                             "leaves nothing that resists the free motion '" +
                               FreeMotionParameters::word(c) + "' in dynamics",
                             "give a positive value");
          if (!dynamic && free.start(c) != 0.)
            throw InputError(section,
                             c < 3 ? "Initial velocity" : "Initial angular velocity",
                             to_string(c < 3 ? free.velocity : free.angular_velocity),
                             "means nothing in statics",
                             "remove the key, or choose a dynamic 'Time integration/Scheme'");
        }
    }
  } // namespace



  void
  check_free_motions(const Scene &scene)
  {
    for (const ContactPairParameters &pair : scene.pairs)
      for (const ObstacleParameters &obstacle : scene.obstacles)
        if (pair.obstacle == obstacle.name && obstacle.shape.name == "reference point" &&
            !pair.tied())
          throw InputError(pair.section(),
                           "Behaviour",
                           pair.behaviour.name,
                           "needs a surface, which the obstacle '" + obstacle.name +
                             "' of the shape 'reference point' does not have",
                           "set it to 'tied', or give the obstacle another shape");
    for (const ObstacleParameters &obstacle : scene.obstacles)
      if (obstacle.free.any())
        {
          check_inertia(scene, obstacle);
          const std::string section = obstacle.section(),
                            words   = to_string(obstacle.free.directions);
          if (scene.time_integration.plastic_impacts())
            throw InputError("Time integration",
                             "Impact",
                             scene.time_integration.impact.word(),
                             "takes the motion of obstacles as given, but '" + obstacle.name +
                               "' is moved by forces",
                             "set it to 'elastic', or 'Scheme' to 'contact_stabilized'");
          for (const ContactPairParameters &pair : scene.pairs)
            if (!pair.pretension_force.empty())
              throw InputError(section,
                               "Free directions",
                               words,
                               "does not go with the 'Pretension force' of the pair '" + pair.name +
                                 "'",
                               "give that pair a 'Pretension shortening', or move the obstacle by "
                               "'Motion x', 'Motion y' and 'Motion z'");
        }
  }
} // namespace Touchstone
