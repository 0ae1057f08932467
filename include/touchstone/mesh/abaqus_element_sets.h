// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_abaqus_element_sets_h
#define touchstone_mesh_abaqus_element_sets_h

#include <touchstone/mesh/abaqus_assembly.h>
#include <touchstone/mesh/mesh_file.h>

#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief The ELSETs and element-based SURFACEs of an Abaqus file, which become volumes and
   * surfaces of the mesh. */
  class AbaqusElementSets
  {
  public:
    /** @brief Index of a cell or face by the number of its element. */
    using Indices = std::map<AbaqusNumber, unsigned int>;

    explicit AbaqusElementSets(const AbaqusAssembly &assembly)
      : assembly(assembly)
    {
    }

    /** @brief A set that may stay empty. */
    void
    declare(const AbaqusName &set)
    {
      sets.insert({set, {}});
    }

    void
    add(const AbaqusName &set, const AbaqusNumber &element);

    /** @brief Add a data line of *ELSET.
     * @param instance That of its elements.
     * @param generate Whether it holds first, last and step instead of numbers and names.
     * @throws MeshFileError for sets that are not known yet */
    void
    add(const AbaqusName               &set,
        const std::vector<std::string> &words,
        unsigned int                    instance,
        bool                            generate);

    /** @brief Add a data line of *SURFACE, an element or a set of them and a face "S1" to "S6".
     * Lines of other kinds of surfaces are skipped.
     * @throws MeshFileError for sets that are not known yet */
    void
    add_faces(const AbaqusName               &surface,
              const std::vector<std::string> &words,
              unsigned int                    instance,
              const Indices                  &cell,
              MeshFile                       &mesh);

    /** @brief Put the groups into the mesh, and a volume for each instance. */
    void
    put_into(MeshFile &mesh, const Indices &cell, const Indices &face) const;

  private:
    const AbaqusAssembly                           &assembly;
    std::map<AbaqusName, std::vector<AbaqusNumber>> sets;
    std::map<AbaqusName, std::vector<unsigned int>> surfaces;
    /** In the order of the file, for the numbers of the groups. */
    std::vector<AbaqusName> set_names, surface_names;

    /** The elements that a word stands for: a number, or the name of a set. */
    std::vector<AbaqusNumber>
    elements(const std::string &word, unsigned int instance) const;
  };
} // namespace Touchstone

#endif
