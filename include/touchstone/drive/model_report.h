// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_model_report_h
#define touchstone_drive_model_report_h

#include <touchstone/drive/step.h>
#include <touchstone/mesh/forest.h>
#include <touchstone/scene/scene.h>
#include <touchstone/solid/solid.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief What the program has understood of the bodies of a scene: cells, extents, volumes,
   * masses, faces and areas of each boundary. Undeformed, as they are meshed. Collective.
   */
  std::vector<std::string>
  describe_bodies(const Scene &scene, const Forest &forest, const Solid &solid);

  /**
   * @brief Memory and time that the run may need, by its size alone: from measured runs of like
   * kind (doc/benchmarks.md), good for the order of magnitude. For one core.
   * @param cycles Those of explicit dynamics, of which the stable step is known; null for implicit
   *               runs.
   */
  std::string
  expected_cost(const Scene &scene, const Solid &solid, const CycleCounts *cycles);

  /** @brief First gaps and overlaps of the contact pairs of an explicit run, which has other rows
   * of its own: those that an implicit run would begin with, undeformed. Collective. */
  std::vector<std::string>
  describe_gaps(const Scene &scene, const Forest &forest, const Solid &solid);
} // namespace Touchstone

#endif
