// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_connection_h
#define touchstone_mesh_connection_h

#include <touchstone/mesh/forest.h>

#include <string>

namespace Touchstone
{
  /**
   * @brief Look for vertices of a body that lie where others do, closer than 1e-6 of its shortest
   * edge: the cells of both are not connected there.
   * @param mesh, body The body, and its number in @p input.
   * @return a warning where such vertices may be meant, as of a crack; empty without any.
   * @throws InputError in the name of @p section if the body falls apart there into parts that do
   * not meet in contact.
   */
  std::string
  check_connection(const BodyMesh    &mesh,
                   const ForestInput &input,
                   unsigned int       body,
                   const std::string &section);
} // namespace Touchstone

#endif
