// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_volume_output_h
#define touchstone_output_volume_output_h

#include <touchstone/output/file_series.h>
#include <touchstone/output/node_numbers.h>
#include <touchstone/output/volume_field.h>
#include <touchstone/solid/solid.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  class SolidPatches;

  /**
   * @brief Output of the bodies, solution.pvd, with all registered VolumeField classes.
   *
   * The geometry is the undeformed one; the displacement is there to warp it by.
   * Stresses are those of the cells averaged to the nodes with the volumes as
   * weights. Bodies share no nodes, so that nothing is smeared over a contact.
   */
  class VolumeOutput
  {
  public:
    /** @param solid, folder Must outlive this object. */
    VolumeOutput(const Solid            &solid,
                 const OutputFolder     &folder,
                 const OutputParameters &parameters = OutputParameters());

    /** @brief The mesh has changed. */
    void
    reinit()
    {
      nodes.reset();
    }

    /** @brief Write the file of one step.
     * @param displacement With ghosts.
     * @param velocity     With ghosts; null if there is none.
     * @param reaction     Forces of the supports at the nodes, with ghosts; null if not known.
     * @throws OutputError on all ranks. Collective. */
    void
    write(const Vector &displacement,
          const Vector *velocity,
          unsigned int  step,
          double        time,
          const Vector *reaction = nullptr);

    /** @brief The averaged stress as fields over the dofs, with ghosts: xx, yy, zz, and xy, yz, xz;
     * force per area. Collective. */
    std::array<Vector, 2>
    nodal_stress(const Vector &displacement);

    /** @brief The files so far, which a resumed run adds to. */
    FileSeries &
    series()
    {
      return *files;
    }

  private:
    const Solid &solid;
    /** Not known before there is a file to write, for many runs write none. */
    std::optional<NodeNumbers> nodes;
    /** Sum of the volumes of the cells around each node. */
    NodeNumbers::Field          node_volume;
    std::unique_ptr<FileSeries> files;
    /** Write stresses as they are in the cells, too. */
    const bool cell_values;
    /** By name, in the order of the file. */
    std::vector<std::pair<std::string, std::shared_ptr<VolumeField>>> fields;

    /** @brief Number the nodes of a new mesh. Collective. */
    void
    number_nodes();

    /** @brief Averaged stress at the owned nodes of the solid; force per area. */
    std::vector<dealii::SymmetricTensor<2, dim>>
    node_stress(const std::vector<dealii::SymmetricTensor<2, dim>> &cell_stress) const;

    /** @brief Add a field to a file, with the rest of its numbers where the format has doubles. */
    void
    add_field(const std::string         &name,
              bool                       at_nodes,
              unsigned int               n_components,
              const std::vector<double> &values,
              SolidPatches              &patches) const;

    /** @brief Add its components, joined to a vector or tensor where the format has that.
     * @param rest The values are what single precision leaves of those of the field. */
    void
    add_components(const std::string         &name,
                   bool                       at_nodes,
                   unsigned int               n_components,
                   const std::vector<double> &values,
                   bool                       rest,
                   SolidPatches              &patches) const;

    /** @brief Whether the components of this tensor are fields of their own. */
    bool
    has_components(const std::string &tensor) const;

    /** @brief A field over the dofs, with ghosts. */
    Vector
    vector_field(const std::vector<double> &values) const;
  };
} // namespace Touchstone

#endif
