// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_bodies_h
#define touchstone_solid_bodies_h

#include <touchstone/solid/solid.h>

#include <deal.II/base/bounding_box.h>

#include <vector>

namespace Touchstone
{
  /** @brief The smallest box around the vertices of each body, undeformed, over all
   * ranks; length. Collective. */
  std::vector<dealii::BoundingBox<dim>>
  body_boxes(const Solid &solid);

  /** @brief Index of the body of each locally owned dof, in the order of the dofs. */
  std::vector<unsigned int>
  bodies_of_unknowns(const Solid &solid);
} // namespace Touchstone

#endif
