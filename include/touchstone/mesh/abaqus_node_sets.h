// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_abaqus_node_sets_h
#define touchstone_mesh_abaqus_node_sets_h

#include <touchstone/mesh/abaqus_assembly.h>
#include <touchstone/mesh/mesh_file.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief The NSETs of an Abaqus file. A set may name nodes that come later; one that names what
   * is not there is left out. */
  class AbaqusNodeSets
  {
  public:
    explicit AbaqusNodeSets(const AbaqusAssembly &assembly)
      : assembly(assembly)
    {
    }

    /** @brief Add a data line of *NSET.
     * @param instance That of its nodes.
     * @param generate Whether it holds first, last and step instead of numbers and names. */
    void
    add(const AbaqusName               &name,
        const std::vector<std::string> &words,
        unsigned int                    instance,
        bool                            generate);

    /** @brief Put the sets into the mesh.
     * @param node Index of a node's number. */
    void
    put_into(MeshFile &mesh, const std::map<AbaqusNumber, unsigned int> &node) const;

  private:
    using Set = std::set<AbaqusNumber>;

    const AbaqusAssembly                    &assembly;
    std::map<AbaqusName, std::optional<Set>> sets;
  };
} // namespace Touchstone

#endif
