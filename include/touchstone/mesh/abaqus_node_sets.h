// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_abaqus_node_sets_h
#define touchstone_mesh_abaqus_node_sets_h

#include <touchstone/mesh/mesh_file.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief The NSETs of an Abaqus file. A set may name nodes that come later; one that cannot be
   * read, as it names nodes of instances for example, is left out. */
  class AbaqusNodeSets
  {
  public:
    /** @brief Add a data line of *NSET.
     * @param generate Whether it holds first, last and step instead of numbers and names. */
    void
    add(const std::string &name, const std::vector<std::string> &words, bool generate);

    /** @brief Put the sets into the mesh.
     * @param node Index of a node's number. */
    void
    put_into(MeshFile &mesh, const std::map<unsigned long, unsigned int> &node) const;

  private:
    std::map<std::string, std::optional<std::set<unsigned long>>> sets;
  };
} // namespace Touchstone

#endif
