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

  /** @brief Where the rigid motions of a body are taken about, and the length that rotations are
   * divided by: so they displace the nodes of any body by about one, like translations, and what
   * is said of both is comparable. */
  struct RigidFrame
  {
    /** Centre of the box around the undeformed body. */
    dealii::Point<dim> centre;
    /** Half its diagonal; length. */
    double size;
  };

  /** @brief The frame of each body. Collective. */
  std::vector<RigidFrame>
  rigid_frames(const Solid &solid);

  /** @brief Number of rigid motions of a body: three translations, three rotations. */
  constexpr unsigned int n_rigid_modes = 2 * dim;

  /** @brief Displacement of rigid mode @p k (translations along x, y, z, rotations about them) at
   * distance @p x from the centre, in sizes of the body. */
  dealii::Tensor<1, dim>
  rigid_mode(unsigned int k, const dealii::Tensor<1, dim> &x);

  /** @brief Where the displacement @p u takes the nodes, as a vector over the dofs; owned dofs,
   * length. */
  Vector
  present_positions(const Solid &solid, const Vector &u);

  /** @brief Index of the body of each locally owned dof, in the order of the dofs. */
  std::vector<unsigned int>
  bodies_of_unknowns(const Solid &solid);
} // namespace Touchstone

#endif
