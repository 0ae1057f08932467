// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_ground_springs_h
#define touchstone_solid_ground_springs_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/linear_system.h>
#include <touchstone/solid/solid.h>

#include <deal.II/fe/fe_values.h>

#include <functional>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Springs between boundaries and the ground: a bedding of Winkler's kind.
   *
   * The traction on the reference area is -(k_n n n^T + k_t (I - n n^T)) u with the reference
   * normal n, in tension as in compression. It is linear in the displacement: nodal forces, and
   * one term of rank one for each direction of each quadrature point, which any solver takes.
   */
  class GroundSprings
  {
  public:
    /** @brief Stiffnesses of a boundary, force per area and length. */
    struct Spring
    {
      BoundaryIds boundary;
      double      normal, tangential;
    };

    explicit GroundSprings(const Solid &solid)
      : solid(solid)
    {
    }

    void
    add(const Spring &spring)
    {
      springs.push_back(spring);
    }

    bool
    empty() const
    {
      return springs.empty();
    }

    const std::vector<Spring> &
    all_springs() const
    {
      return springs;
    }

    /** @brief Add the nodal forces in the displacement @p u (without ghosts). Collective. */
    void
    add_force(const Vector &u, Vector &force) const;

    /** @brief Append the stiffness of the cells of this rank. */
    void
    add_stiffness(std::vector<RankOneTerm> &terms) const;

    /** @brief Directions in which owned nodes are held by springs, to tell whether a body can move
     * freely. */
    std::vector<Condition>
    conditions() const;

  private:
    const Solid        &solid;
    std::vector<Spring> springs;

    /** Visit the quadrature points of faces with springs, with the directions of springs and their
     * stiffnesses times the weight. */
    void
    for_each_point(
      bool                                                                 with_ghosts,
      const std::function<void(const dealii::FEFaceValues<dim> &,
                               unsigned int                                   q,
                               const std::vector<Index>                      &dofs,
                               const std::array<dealii::Tensor<1, dim>, dim> &directions,
                               const std::array<double, dim> &stiffness)> &visit) const;
  };
} // namespace Touchstone

#endif
