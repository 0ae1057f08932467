// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_holding_springs_h
#define touchstone_drive_holding_springs_h

#include <touchstone/solid/rigid_body_modes.h>

namespace Touchstone
{
  /**
   * @brief Springs that hold bodies where a step begins against rigid motions which next to nothing
   * resists, and are made softer until they carry next to nothing (doc/theory.md 9).
   *
   * Without them such motions follow what the shapes of facets make of the forces, and
   * Newton's method goes from one of the many balances to another.
   */
  class HoldingSprings
  {
  public:
    /** @brief Attach springs that hold bodies in the state @p u; owned dofs, length. */
    void
    attach(const Solid &solid, const Vector &u);

    /** @brief Let them act against these rigid motions. */
    void
    act_on(const FreeMotion &motion);

    /** @brief Make them softer; in the end they are taken away. */
    void
    soften();

    /** @brief Take them away. */
    void
    detach()
    {
      fraction = 0.;
    }

    bool
    attached() const
    {
      return fraction > 0.;
    }

    /** @brief Whether there are motions for them to act on. */
    bool
    act() const
    {
      return attached() && modes.n_modes > 0;
    }

    /** @brief The bodies that they hold. */
    const std::set<unsigned int> &
    bodies() const
    {
      return modes.bodies;
    }

    /** @brief The part of the motion from where they hold the bodies to @p u that they resist;
     * owned dofs, length. Collective. */
    Vector
    resisted_motion(const Vector &u) const;

    /** @brief Their forces on the nodes in the state @p u. Collective. */
    Vector
    forces(const Vector &u) const;

    /** @brief What is added to the diagonal of the tangent for them, which is more than their own
     * stiffness, as they resist rigid motions alone; force per length of each owned dof. */
    Vector
    stiffness() const;

  private:
    /** Of the diagonal of the stiffness of bodies; none if it is zero. */
    double       fraction = 0.;
    const Solid *solid    = nullptr;
    /** Where they hold the bodies; displacement. */
    Vector held_at;
    /** The motions that they act against. */
    FreeMotion modes;
  };
} // namespace Touchstone

#endif
