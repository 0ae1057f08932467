// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_resultant_load_h
#define touchstone_solid_resultant_load_h

#include <touchstone/algebra/linear_system.h>
#include <touchstone/base/formula.h>
#include <touchstone/solid/solid.h>

#include <array>
#include <memory>

namespace Touchstone
{
  /**
   * @brief A force at a point and a moment, carried to a boundary by tractions that leave it free
   * to deform.
   *
   * The traction per reference area is the one that is linear in the position,
   *
   *   f = F / A + (J^{-1} M_c) x (x - c),   M_c = M + (p - c) x F,
   *
   * with area A, mean position c and inertia J = int (r^2 I - r r) dA, r = x - c, of the boundary:
   * it has the force F and about the point p the moment M, and of all such tractions the least mean
   * square. In bodies at finite strain x, c and J are those of the present state and p moves with
   * the boundary as if on a rigid arm, so that force and moment are what is given however the body
   * has turned; at small strain they are those of the reference state.
   */
  class ResultantLoad
  {
  public:
    /** Force and moment by component; null for none. Functions of the time. */
    using Functions = std::array<std::shared_ptr<const Formula>, 2 * dim>;

    /** @brief Moments of the boundary in some state, as integrals over the reference area. */
    class Integrals
    {
    public:
      /** @brief Add a point with its weight (area) and its reference position. */
      void
      add(double weight, const dealii::Tensor<1, dim> &x, const dealii::Tensor<1, dim> &reference);

      /** @brief All numbers, for sums over ranks. */
      static constexpr unsigned int n_values = 1 + 2 * dim + 2 * dim * dim;
      std::array<double, n_values>  values{};
    };

    /** @brief Where the boundary is, for traction(). */
    struct Place
    {
      double                 area = 0.;
      dealii::Point<dim>     mean, point;
      dealii::Tensor<2, dim> inverse_inertia;
      /** int r r^T dA, and, for a point on an arm, int r (R R_0)^T dA with the reference position
       * R_0 from the mean and the rotation R of the boundary: area times length squared. */
      dealii::Tensor<2, dim> second, stretch;
    };

    /** @param point Where the force acts; null: the mean position.
     * @param finite The body is at finite strain. Collective. */
    ResultantLoad(const Solid              &solid,
                  const BoundaryIds        &boundary,
                  const Functions          &functions,
                  const dealii::Point<dim> *point,
                  bool                      finite);

    const Functions &
    functions() const
    {
      return values;
    }

    /** @brief Whether the tractions depend on the displacement. A force at the mean position is
     * uniform in any state. */
    bool
    follows() const
    {
      return moves;
    }

    /** @brief The place of the reference state. */
    const Place &
    at_start() const
    {
      return start;
    }

    /** @brief The place in the state that integrals over the whole boundary are of. */
    Place
    place(const Integrals &integrals) const;

    /** @brief The place in the displacement @p u with ghosts. Collective. */
    Place
    place(const Vector &u) const;

    /** @brief The traction of a unit of component @p k at the position @p x, per area and per area
     * and length. */
    static dealii::Tensor<1, dim>
    traction_of_unit(unsigned int k, const Place &place, const dealii::Tensor<1, dim> &x);

    /** @brief The traction at the position @p x and time @p t, force per reference area. */
    dealii::Tensor<1, dim>
    traction(const Place &place, const dealii::Tensor<1, dim> &x, double t) const;

    /** @brief Add the stiffness -df/du, or its symmetric part, of the cells of this rank, in the
     * displacement @p u without ghosts. Exact where the boundary moves linearly in space.
     * Collective. */
    void
    add_stiffness(double t, const Vector &u, bool symmetric, std::vector<RankOneTerm> &terms) const;

  private:
    /** A node far out on the boundary: its first dof, and its reference position. */
    struct OutermostNode
    {
      Index              dof;
      dealii::Point<dim> position;
    };

    /** With which part the mean position follows a node, and with which the gradient of the
     * displacement over the boundary, per length. */
    struct Follower
    {
      double                 weight = 0.;
      dealii::Tensor<1, dim> gradient;
    };

    const Solid      &solid;
    const BoundaryIds boundary;
    const Functions   values;
    const bool        moves;
    Place             start;
    /** At most one in each direction along each axis, the same on all ranks. */
    std::vector<OutermostNode> outermost;

    void
    choose_outermost();
    std::vector<Follower>
    followers(const Vector &u, const Place &place) const;

    /** Null: of the reference state. Collective. */
    Integrals
    integrals(const Vector *u) const;
  };
} // namespace Touchstone

#endif
