// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_friction_friction_force_h
#define touchstone_contact_friction_friction_force_h

#include <touchstone/base/types.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief The tangential force of a row: the formulation, which the enforcement chooses, and the
   * response (direction, stiffness, derivatives), which enters the linear system.
   *
   * The tangential force follows a trial force, t_tr = base - c s, with the slip s
   * of the step: inside the cone of radius L(lambda) the node sticks, outside it
   * slips with t = L t_tr / |t_tr|. Formulations differ in base and c:
   * - regularised (elastic-plastic slip): the force at the start of the step,
   *   carried along with the slave surface, and alpha_t;
   * - augmented Lagrangian in an outer loop: the force at the last augmentation, and its penalty;
   * - exact: the force of the last iteration, and the complementarity constant.
   *   The node is then constrained while it sticks, by conditions or by springs that meet them.
   *
   * Simo and Laursen (1992), Comput. Struct. 42; Alart and Curnier (1991), Comput.
   * Methods Appl. Mech. Engng 92; Hueeber, Stadler and Wohlmuth (2008), SIAM J. Sci.
   * Comput. 30; doc/theory.md, sections 6.1 to 6.3.
   */
  struct FrictionForce
  {
    using Vec = dealii::Tensor<1, dim>;
    using Mat = dealii::Tensor<2, dim>;

    /** @name Formulation, chosen by the enforcement */
    /** @{ */
    /** The relative displacement of a node that sticks is constrained by conditions. */
    bool constrained = false;
    /** Tangents along which its condition was refused, because a support or another pair
     * determines its displacement: there springs with an augmented force enforce stick. */
    std::vector<Vec> unconstrained;
    /** Tangents along which supports determine the displacement of both sides: nothing can take
     * back a slip, so that any slip is sliding. */
    std::vector<Vec> held;
    double           c = 1.;
    Vec              base;
    /** The base is the force that is carried along with the slave surface. */
    bool carried = false;
    /** Equilibrium does not determine the force of stick: see undetermined_stick(). */
    bool shared = false;
    /** @} */

    /** @name Response, see friction_response.h */
    /** @{ */
    /** Direction of the force and stiffness, now and in the last linear system;
     * the direction is zero while sticking. */
    Vec direction, last_direction;
    Mat tangent, last_tangent;
    /** Linearised, t = constant + d_lambda lambda + d_area dA - tangent ds - d_spin omega
     * + d_slip (slip_direction . ds), the last where the limit depends on the slip. */
    Vec constant, d_lambda, d_area, d_spin, d_slip, slip_direction;
    /** Radius of the cone, force. */
    double limit = 0.;
    /** The stiffness across the slip is its bound, for the slip is next to nothing. */
    bool bounded = false;
    /** |t_tr| - L, force: a positive value violates stick, a negative one slip. */
    double excess = 0.;
    /** @} */

    /** @brief No force; the formulation stays. */
    void
    clear()
    {
      base = direction = last_direction = constant = d_lambda = d_area = d_spin = Vec();
      d_slip = slip_direction = Vec();
      unconstrained.clear();
      held.clear();
      tangent = last_tangent = Mat();
      limit = excess = 0.;
      bounded        = false;
    }

    /** @brief The one list of what checkpoints hold. */
    template <class Force, class Visitor>
    static void
    visit_state(Force &f, Visitor &&visit)
    {
      visit(f.constrained);
      visit(f.c);
      visit(f.base);
      visit(f.carried);
      visit(f.direction);
      visit(f.last_direction);
      visit(f.tangent);
      visit(f.last_tangent);
      visit(f.constant);
      visit(f.d_lambda);
      visit(f.d_spin);
      visit(f.limit);
      visit(f.excess);
    }
  };
} // namespace Touchstone

#endif
