// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_adjusted_start_h
#define touchstone_drive_adjusted_start_h

#include <touchstone/mesh/forest.h>
#include <touchstone/scene/scene.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Move nodes of meshes whose surfaces cross each other, as 'Initial overlap = adjust' of
   * general contact asks for: the meshes are others then, and free of stress. Collective, and
   * before anything refers to the mesh.
   * @return What has been found and done, as lines for the user; empty if there is nothing to do.
   */
  std::vector<std::string>
  adjust_start(const Scene &scene, Forest &forest, MPI_Comm communicator);
} // namespace Touchstone

#endif
