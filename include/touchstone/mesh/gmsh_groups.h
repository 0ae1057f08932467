// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_gmsh_groups_h
#define touchstone_mesh_gmsh_groups_h

#include <touchstone/mesh/gmsh_numbers.h>
#include <touchstone/mesh/mesh_file.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The physical groups of a .msh file: their names, their members, and in version 4 the
   * entities that carry them.
   *
   * Names may come after the members, so they are attached at the end (name_groups()).
   */
  class GmshGroups
  {
  public:
    /** @brief Read $PhysicalNames. Two names for one group, or one name for two groups of the same
     * dimension, would make the boundary conditions ambiguous. */
    void
    read_names(MeshText &text);

    /** @brief Read $Entities, of which only the physical groups are kept. The sign of a group
     * tells its orientation only. */
    void
    read_entities(MeshText &text, GmshNumbers &numbers);

    /** @brief Read $PartitionedEntities, the parts of entities that a partitioned mesh has in place
     * of them, of which the physical groups are kept. A file with a part of the mesh is refused. */
    void
    read_partitioned_entities(MeshText &text, GmshNumbers &numbers);

    /** @brief The physical groups of an entity of dimension @p d; none in a file without
     * $Entities. */
    const std::vector<unsigned int> &
    of_entity(MeshText &text, unsigned int d, unsigned long entity) const;

    /** @brief Add nodes to the sets of physical points (@p d = 0) or curves (1). */
    void
    add_nodes(unsigned int                     d,
              const std::vector<unsigned int> &groups,
              const std::vector<unsigned int> &nodes);

    /** @brief Give the groups of the mesh their names, and make its sets of nodes: those of
     * physical points and curves that have a name. */
    void
    name_groups(MeshFile &mesh) const;

  private:
    /** The physical groups at the present place of the file. */
    static std::vector<unsigned int>
    read_groups(const char *section, unsigned int d, GmshNumbers &numbers);

    bool has_entities = false;
    /** Physical groups of each entity, by dimension. */
    std::map<unsigned long, std::vector<unsigned int>> physical[4];
    /** Vertices of physical points and curves, by dimension and number. */
    std::map<unsigned int, std::set<unsigned int>> nodes_of[2];
    /** Names of physical groups, by dimension. */
    std::map<unsigned int, std::string> names[4];
  };
} // namespace Touchstone

#endif
