// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_edge_grading_h
#define touchstone_mesh_edge_grading_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Sizes of cells that are smallest at the edges of a contact and of its stick zone, and at
   * the contact face: the keys that geometries with such meshes share.
   *
   * Tractions have vertical tangents at these edges. Cells that are small in one direction only
   * cost no more along the edge than the solution there needs.
   */
  class EdgeGrading
  {
  public:
    void
    declare(dealii::ParameterHandler &prm);

    /** @brief Check the keys.
     * @param start, end Where the edges must lie in between, length. @throws InputError */
    void
    check(const std::string &section, double start, double end) const;

    /** @brief Positions along the contact face, from @p start over the edges to @p end.
     * @param factor Cells that there are for each one. */
    std::vector<double>
    along(double start, double end, double factor) const;

    /** @brief Depths of the layers, from 0 to @p height. */
    std::vector<double>
    down(double height, double factor) const;

  private:
    std::vector<double> edges     = {0.25};
    double              edge_size = 0.01, largest = 0.02;
    double              growth = 1.4, outer_growth = 1.4, layer_growth = 1.4;
  };
} // namespace Touchstone

#endif
