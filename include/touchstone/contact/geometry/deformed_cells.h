// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_deformed_cells_h
#define touchstone_contact_geometry_deformed_cells_h

#include <touchstone/solid/solid.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <array>
#include <vector>

namespace Touchstone
{
  /** @brief The vertices of a cell with the displacement @p u, with ghosts. */
  std::array<dealii::Point<dim>, 8>
  deformed_vertices(const dealii::DoFHandler<dim>::active_cell_iterator &cell, const Vector &u);

  /** @brief The bounding box of a cell with these vertices, larger by what a point on a plane of
   * symmetry may lie outside of it by round-off. */
  dealii::BoundingBox<dim>
  box_of_cell(const std::array<dealii::Point<dim>, 8> &vertices);

  /** @brief The cells of one body on this rank, with straight edges, to ask whether points
   * lie in the body. */
  class DeformedCells
  {
  public:
    /** @param u Displacement with ghosts. */
    DeformedCells(const Solid &solid, unsigned int body, const Vector &u);

    /** @brief Whether a point lies in a cell that this rank owns. */
    bool
    contain(const dealii::Point<dim> &x) const;

    using Box = dealii::BoundingBox<dim>;
    /** @brief The boxes around the cells. */
    std::vector<Box>
    boxes() const;

  private:
    std::vector<std::array<dealii::Point<dim>, 8>> cells;
    dealii::RTree<std::pair<Box, std::size_t>>     tree;
  };

  /** @brief For each of some points of this rank, whether it lies in the cells of a body, whatever
   * ranks have them. Collective. @param u Displacement with ghosts. */
  std::vector<bool>
  lie_within(const std::vector<dealii::Point<dim>> &points,
             const Solid                           &solid,
             unsigned int                           body,
             const Vector                          &u);

  /** @brief For each of some pairs of points of this rank, of the first and of the second body,
   * whether each lies in the cells of the other body: the bodies overlap there, while at the two
   * sides of a thin body they do not. Collective. @param u Displacement with ghosts. */
  std::vector<bool>
  lie_within_each_other(const std::vector<std::array<dealii::Point<dim>, 2>> &pairs,
                        const Solid                                          &solid,
                        const std::array<unsigned int, 2>                    &bodies,
                        const Vector                                         &u);
} // namespace Touchstone

#endif
