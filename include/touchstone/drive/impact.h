// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_impact_h
#define touchstone_drive_impact_h

#include <touchstone/algebra/vector.h>
#include <touchstone/contact/contact.h>
#include <touchstone/solid/mass.h>
#include <touchstone/solid/solid.h>

#include <Epetra_CrsMatrix.h>
#include <functional>
#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Impact without rebound: nodes that press on each other at the end of a step
   * lose the velocities that contact leaves no room for.
   *
   * The contact force that closes a gap at the end of a step turns the velocity of the
   * node that arrives: alone it rebounds and comes back some steps later. Here
   *
   *   v+ = v - M^{-1} F^T p   with   B v+ = velocity of the obstacle,
   *
   * where B are the conditions of contact and F the directions of their forces: Newton's
   * law of impact with restitution 0, as in Moreau's time stepping (Acary 2016, Z. Angew.
   * Math. Mech. 96). Without friction v+ is the M-orthogonal projection of v, so that
   * kinetic energy is only lost: that of single nodes, which vanishes with the mesh size.
   * While contact lasts there is nothing left to lose.
   */
  class Impact
  {
  public:
    /**
     * @param constraints       Conditions of this rank's nodes, with the velocities that they
     *                       ask for; none that supports decide. It gets the impulses.
     * @param remove_support Takes from forces on nodes what supports carry.
     * Collective.
     */
    Impact(std::vector<VelocityConstraint>     &constraints,
           const Mass                          &mass,
           const Solid                         &solid,
           const std::function<void(Vector &)> &remove_support);

    /** @brief Impulses on the nodes that were taken, along normals and across them, force
     * times time, and what obstacles did not do of the work that their forces of the
     * step stand for, force times length. */
    struct Loss
    {
      Vector normal, tangential;
      double of_obstacles = 0.;
    };

    /**
     * @brief Take from @p v what the conditions leave no room for.
     * @param moving They ask for their velocities; else, of accelerations, for none.
     * @throws LinearSolverFailure Collective.
     */
    Loss
    stop(Vector &v, bool moving);

  private:
    const Mass                      &mass;
    const Solid                     &solid;
    std::function<void(Vector &)>    remove_support;
    std::vector<VelocityConstraint> &constraints;
    /** Numbers of this rank's conditions. */
    dealii::IndexSet rows;
    /** B and F. */
    std::unique_ptr<Epetra_CrsMatrix> motion, force;
    Vector                            scale;
    /** One over the masses of the nodes; 0 where there is none. */
    Vector inverse_mass;

    /** The velocities that impulses on the nodes lead to. */
    void
    respond(Vector &impulse) const;
  };
} // namespace Touchstone

#endif
