// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_gauss_cells_h
#define touchstone_explicit_gauss_cells_h

#include <touchstone/explicit/block_law.h>
#include <touchstone/explicit/gauss_kernels.h>
#include <touchstone/explicit/kernel_cells.h>

namespace Touchstone
{
  /** @brief Cells of finite strain with 2x2x2 points, eight at a time: those of KernelCells up to
   * round-off, for laws that have formulas for eight points at once. */
  class GaussCells : public KernelCells
  {
  public:
    /** @brief Whether there are formulas for the body. */
    static bool
    suits(const BodyParameters &body);

    GaussCells(const NodeMap                   &map,
               const std::vector<unsigned int> &cells,
               const BodyParameters            &body);

    unsigned int
    subtract_forces(const NodeField     &u,
                    const NodeField     &v,
                    double               step,
                    const BulkViscosity *bulk,
                    NodeField           &force,
                    NodeField           &viscous) override;

  private:
    BlockLaw                law;
    const bool              f_bar;
    std::vector<GaussBlock> blocks;
  };
} // namespace Touchstone

#endif
