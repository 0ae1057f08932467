// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_elastic_cells_h
#define touchstone_explicit_elastic_cells_h

#include <touchstone/explicit/cell_forces.h>
#include <touchstone/explicit/cell_stiffness.h>

#include <vector>

namespace Touchstone
{
  /** @brief Cells of a linear elastic body by their stiffness, which never changes. */
  class ElasticCells : public CellForces
  {
  public:
    ElasticCells(const NodeMap                   &map,
                 const std::vector<unsigned int> &cells,
                 const BodyParameters            &body);

    unsigned int
    subtract_forces(const NodeField     &u,
                    const NodeField     &v,
                    double               step,
                    const BulkViscosity *bulk,
                    NodeField           &force,
                    NodeField           &viscous) override;
    void
    add_energies(const NodeField &u, CellEnergies &energies) override;
    void
    square_frequencies(const NodeField &u, std::vector<double> &result) override;

  private:
    static constexpr unsigned int n = CellStiffness::n;
    /** Of all cells, row by row. */
    std::vector<double> stiffness;
    std::vector<double> exact;
  };
} // namespace Touchstone

#endif
