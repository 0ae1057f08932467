// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_following_arch_h
#define touchstone_contact_geometry_following_arch_h

#include <touchstone/contact/geometry/face.h>

#include <array>

namespace Touchstone
{
  /** @brief How the arch of an exact surface over a facet turns (doc/theory.md 4, equation (8)). */
  enum class Arch
  {
    /** All of it with the facet: faces that turn by different angles lie over each other beside
     * their common edge, or leave a gap there. */
    with_facet,
    /** Its part along the normals with the averaged normals of the nodes, which faces have in
     * common: the surface is continuous over edges. */
    with_normals
  };

  /**
   * @brief The part of the arch of an exact surface that turns with the averaged normals of the
   * nodes.
   *
   * Of the arch R A, turned with the facet, it takes the part along N = sum N_m R M_m, M_m the
   * averaged normals of the nodes in the reference state, to n = sum N_m n_m:
   * x += a (n - N), a = R A . N / N . N. Equation (8) of doc/theory.md 4.
   */
  class FollowingArch
  {
  public:
    /** @param rotation The facet_rotation(). */
    FollowingArch(const Face &face, const dealii::Tensor<2, dim> &rotation);

    /** @brief What it consists of at one point, with derivatives by xi. */
    struct Part
    {
      /** a; length. */
      double                value = 0.;
      std::array<double, 2> value_xi{};
      /** R A, n and N. */
      dealii::Tensor<1, dim>                arch, normal, turned;
      std::array<dealii::Tensor<1, dim>, 2> arch_xi, normal_xi, turned_xi;
    };

    /** @param on_facet The point there with all of the arch turned with the facet. */
    Part
    at(const FaceShapes &shapes, const FacePoint &on_facet) const;

    /** @brief Move a point with its tangents, all of whose arch has turned with the facet. */
    static void
    add(const Part &part, FacePoint &point);

    /** @brief Second derivatives of the motion by xi: 11, 12, 22; length.
     * @param second Those of the point @p on_facet. */
    std::array<dealii::Tensor<1, dim>, 3>
    second_derivatives(const std::array<double, 2>                 &xi,
                       const FacePoint                             &on_facet,
                       const std::array<dealii::Tensor<1, dim>, 3> &second) const;

  private:
    const Face *face;
    /** R M_m. */
    std::array<dealii::Tensor<1, dim>, Face::max_nodes> turned;
  };
} // namespace Touchstone

#endif
