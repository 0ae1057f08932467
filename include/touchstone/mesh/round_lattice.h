// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_round_lattice_h
#define touchstone_mesh_round_lattice_h

#include <deal.II/base/tensor.h>
#include <deal.II/grid/tria_description.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The cells of a disk or a ball of radius one: a core of straight rows,
   * around which rings or shells grow round.
   *
   * Without it, cells at the centre would collapse into wedges.
   */
  struct RoundLattice
  {
    /**
     * @param dimensions 2 for a disk (times a line in the third direction), 3
     *                   for a ball.
     * @param keep       For each of these directions "+", "-" or "both": the
     *                   half that is meshed.
     * @param core       Cells of the core from the centre to its side.
     * @param rings      Cells from there to the surface.
     * @param layers     Cells in the third direction of a disk.
     * @param grading    Thickness of the last ring, at the surface, over that of the first.
     */
    RoundLattice(unsigned int                    dimensions,
                 const std::vector<std::string> &keep,
                 unsigned int                    core,
                 unsigned int                    rings,
                 unsigned int                    layers,
                 double                          grading = 1.);

    /** Points within the unit disk or ball; the third coordinate of a disk runs
     * from 0 to 1. */
    std::vector<dealii::Tensor<1, 3>> points;
    std::vector<dealii::CellData<3>>  cells;
  };
} // namespace Touchstone

#endif
