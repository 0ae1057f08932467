// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_time_integration_h
#define touchstone_drive_time_integration_h

#include <touchstone/algebra/vector.h>
#include <touchstone/base/stateful.h>
#include <touchstone/contact/contact.h>
#include <touchstone/drive/time_parameters.h>
#include <touchstone/solid/energies.h>
#include <touchstone/solid/mass.h>
#include <touchstone/solid/solid.h>

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief The forces on the nodes at the end of a step, for its energies; none has
   * ghosts. */
  struct StepForces
  {
    /** What contact forces of the end of the step count in its momentum and work, those of its
     * beginning having the rest (doc/time_integration.md, "The energy ledger"). */
    double end_weight = 1.;
    /** Of loads and of the stress in the bodies. */
    const Vector *external = nullptr, *internal = nullptr;
    /** Of contact, along the normals and across them. */
    const Vector *normal = nullptr, *tangential = nullptr;
    /** Reactions of supports. */
    const Vector *support = nullptr;
    /** For impacts without rebound, else null; gets the impulses. */
    std::vector<VelocityConstraint> *velocity_constraints = nullptr;
    /** Removes from nodal forces the components that supports carry. */
    std::function<void(Vector &)> remove_support;
    /** Work from outside by the normal and by the tangential contact forces, force times length:
     * of moving obstacles, and along the normal of overlaps that are pressed in. */
    double outside_normal = 0., outside_tangential = 0.;
  };

  /** @brief Mass and momenta of a body. */
  struct BodyMomentum
  {
    /** Of the body, mass. */
    double mass = 0.;
    /** Momentum, and angular momentum about the origin. */
    dealii::Tensor<1, dim> linear, angular;
  };

  /** @brief What results need to know of the motion at the committed state. */
  class CommittedMotion
  {
  public:
    virtual ~CommittedMotion() = default;

    /**
     * @brief Whether there is inertia: then bodies need no support, and energies need the forces.
     */
    virtual bool
    dynamic() const = 0;

    /** @brief The committed energies. */
    const Energies &
    committed_energies() const
    {
      return committed;
    }

    /** @brief Velocity and what else is to be transferred to another mesh; empty in statics. */
    virtual std::vector<const Vector *>
    rates() const
    {
      return {};
    }

    /** @brief Momenta of each body; empty in statics. Collective. */
    virtual std::vector<BodyMomentum>
    momenta() const
    {
      return {};
    }

    /** @brief Of each of rates() the momenta of the bodies if their nodes moved with it: those of
     * the velocity, and the resultants of the forces of inertia. Collective. */
    virtual std::vector<std::vector<BodyMomentum>>
    momenta_of_rates() const
    {
      return {};
    }

  protected:
    Energies committed;
  };



  /**
   * @brief Time integration of one step: the nodal forces without contact (loads, stresses,
   * inertia, damping) and their derivative.
   *
   * The unknown of a step is the displacement at its end. A scheme defines at which times within
   * the step loads, stresses and inertia enter the balance; contact forces are those of the end of
   * the step.
   */
  class TimeIntegration : public Stateful, public CommittedMotion
  {
  public:
    /** @brief The displacement at time 0, without ghosts. Collective. */
    virtual Vector
    initial_displacement() const = 0;

    /**
     * @brief Operations with the supports at time 0: set the prescribed components of a velocity
     * and of an acceleration, and set those of a force to zero.
     */
    struct Supports
    {
      std::function<void(Vector &)> set_velocity, set_acceleration, remove_force;
    };

    /** @brief Take the state at time 0 with the forces there; nothing has ghosts. */
    virtual void
    start(const Vector &external, const Vector &internal, const Supports &supports) = 0;

    /** @brief Begin a step from the committed state to time @p t, and move @p u to a
     * first guess of its end. */
    virtual void
    begin_step(double t, Vector &u) = 0;

    /** @brief Whether the first guess of a step may have bodies where their supports move them
     * (move_driven_bodies()). */
    virtual bool
    follows_supports() const
    {
      return false;
    }

    /** @brief All forces on the nodes but those of contact, force. */
    virtual void
    balance(const Vector &u, const Vector &external, const Vector &internal, Vector &sum) = 0;

    /** @brief Minus the derivative of balance(), for @p solid's present stiffness. */
    virtual const Matrix &
    stiffness() = 0;

    /** @brief The mass, if it is not where the density is, but some nodes have given theirs to
     * others; else null. */
    virtual const Mass *
    moved_mass() const
    {
      return nullptr;
    }

    /** @brief Share of the forces at the end of the step in balance(); no unit. */
    virtual double
    weight() const = 0;

    /** @brief Size of the inertial forces of the last balance(), and of what
     * round-off makes of them at @p u; force. Of this rank's dofs, squared. */
    virtual double
    inertia_squared() const = 0;
    virtual double
    round_off_squared(const Vector &u) const = 0;

    /**
     * @brief Compute velocity, acceleration and energies at the end of the step if its displacement
     * is @p u. @return the energies, force times length. Collective. @throws LinearSolverFailure
     */
    virtual Energies
    end_step(const Vector &u, const StepForces &forces) = 0;

    /** @brief Keep the end of the step as end_step() found it, with its energies. */
    void
    commit() override;

    /** Includes the energies and the time. */
    void
    save(ArchiveWriter &archive) const override;
    void
    load(const ArchiveReader &archive) override;

    /**
     * @brief Continue on another mesh from the transferred rates(), the forces there at the
     * committed state, and the momenta_of_rates() before, which bodies keep where their supports
     * let them. Collective.
     */
    virtual void
    adopt(const std::vector<Vector> & /*rates*/,
          const StepForces & /*forces*/,
          const std::vector<std::vector<BodyMomentum>> & /*before*/)
    {
    }

    /** @brief Set time and energies of the committed state. */
    void
    resume(double time, const Energies &energies);

    /**
     * @brief The scheme that the parameters choose.
     * @param step Nominal length of the steps, time.
     * @param slaves First dofs of the owned slave nodes that are not tied to their master.
     * @param committed_u The displacement at the beginning of a step, kept by reference: it must
     * not change between end_step() and commit().
     * Collective.
     */
    static std::unique_ptr<TimeIntegration>
    make(const TimeIntegrationParameters &parameters,
         double                           step,
         const Solid                     &solid,
         const std::set<Index>           &slaves,
         const Vector                    &committed_u);

  protected:
    /** Of the committed state and of the end of the step; energies of the latter by end_step(). */
    double   committed_time = 0., time = 0.;
    Energies end;
    /** A vector of the committed state other than the displacement, without ghosts, with its name
     * in checkpoints. Those of earlier versions without it have another vector that may stand in
     * its place. */
    struct Field
    {
      std::string name;
      Vector     *values;
      std::string substitute = {};
    };
    std::vector<Field> fields;
  };
} // namespace Touchstone

#endif
