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
   * @brief Impact without rebound: contact nodes that are active at the end of a step lose the
   * velocities that violate contact.
   *
   * The contact force that closes a gap at the end of a step reverses the velocity of the node that
   * arrives: alone it rebounds and comes back some steps later. Here
   *
   * v+ = v - M^{-1} F^T p with B v+ = velocity of the obstacle,
   *
   * where B are the constraints of contact and F the directions of their forces: Newton's law of
   * impact with restitution 0, as in Moreau's time stepping (Acary 2016, Z. Angew. Math. Mech. 96).
   * Without friction v+ is the M-orthogonal projection of v, so that kinetic energy is only lost:
   * that of single nodes, which vanishes with the mesh size. In persistent contact v+ = v.
   */
  class Impact
  {
  public:
    /**
     * @param constraints Velocity constraints of this rank's nodes with their prescribed
     * velocities; those implied by supports are omitted. Their impulses are set by stop().
     * @param remove_support Removes from nodal forces the components that supports carry.
     * Collective.
     */
    Impact(std::vector<VelocityConstraint>     &constraints,
           const Mass                          &mass,
           const Solid                         &solid,
           const std::function<void(Vector &)> &remove_support);

    /**
     * @brief Impulses on the nodes that have been removed, along the normals and tangential to
     * them, force times time; and the impulses times the velocities of the obstacles, by which the
     * work of obstacles over the step is too large, force times length.
     */
    struct Loss
    {
      Vector normal, tangential;
      double normal_of_obstacles = 0., tangential_of_obstacles = 0.;
    };

    /**
     * @brief Remove from @p v the part that violates the constraints.
     * @param of_velocity @p v is a velocity; otherwise an acceleration. It will be that of the
     * obstacles.
     * @throws LinearSolverFailure Collective.
     */
    Loss
    stop(Vector &v, bool of_velocity);

  private:
    const Mass                      &mass;
    const Solid                     &solid;
    std::function<void(Vector &)>    remove_support;
    std::vector<VelocityConstraint> &constraints;
    /** Global indices of this rank's constraints. */
    dealii::IndexSet rows;
    /** B and F. */
    std::unique_ptr<Epetra_CrsMatrix> motion, force;
    Vector                            scale;
    /** One over the masses of the nodes; 0 where there is none. */
    Vector inverse_mass;

    /**
     * Replace impulses on the nodes by the change of velocity that they cause, M^{-1} @p impulse.
     */
    void
    respond(Vector &impulse) const;
  };
} // namespace Touchstone

#endif
