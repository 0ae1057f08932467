// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_dynamics_h
#define touchstone_drive_dynamics_h

#include <touchstone/drive/time_integration.h>
#include <touchstone/solid/bodies.h>
#include <touchstone/solid/mass.h>

#include <deal.II/lac/full_matrix.h>

#include <array>

namespace Touchstone
{
  /**
   * @brief The generalized-alpha family (Chung and Hulbert 1993, J. Appl. Mech. 60),
   * Newmark's and HHT's methods among them, with the contact forces of the end of the
   * step:
   *
   *   M a_{n+1-m} + C v_{n+1-f} + F_int,n+1-f = F_ext,n+1-f + f_contact,n+1.
   *
   * With m = f = 1/2 (spectral radius 1) this is the midpoint rule, and the energy of
   * linear bodies changes by the work of f_contact,n+1 on the motion of the step alone.
   * Along the normals that is lambda_{n+1} (g_{n+1} - g_n) = -lambda_{n+1} g_n <= 0: zero
   * in persistent and in opening contact, and a loss where contact closes (Kane, Repetto,
   * Ortiz and Marsden 1999, Comput. Methods Appl. Mech. Engng 180). The loss vanishes if
   * a step ends where bodies meet.
   *
   * "contact_stabilized" moves the mass of the slave nodes away (see Mass): then
   * contact forces follow the strain of the cells, not the momentum of the nodes,
   * and do not oscillate.
   */
  class Dynamics : public TimeIntegration
  {
  public:
    /**
     * @param step Nominal length of the steps, time. Other parameters as in
     * TimeIntegration::make().
     */
    Dynamics(const TimeIntegrationParameters &parameters,
             double                           step,
             const Solid                     &solid,
             const std::set<Index>           &slaves,
             const Vector                    &committed_u);

    Vector
    initial_displacement() const override;

    void
    start(const Vector &external, const Vector &internal, const Supports &supports) override;
    void
    begin_step(double t, Vector &u) override;
    void
    balance(const Vector &u, const Vector &external, const Vector &internal, Vector &sum) override;
    const Matrix &
    stiffness() override;
    const Mass *
    moved_mass() const override
    {
      return mass.moved() ? &mass : nullptr;
    }
    double
    weight() const override
    {
      return 1. - scheme.alpha_f;
    }
    bool
    dynamic() const override
    {
      return true;
    }
    double
    inertia_squared() const override
    {
      return inertial_force_squared;
    }
    double
    round_off_squared(const Vector &u) const override;
    Energies
    end_step(const Vector &u, const StepForces &forces) override;
    void
    commit() override;
    void
    rollback() override
    {
    }
    std::vector<const Vector *>
    rates() const override
    {
      return {&v, &a};
    }
    void
    adopt(const std::vector<Vector>                    &rates,
          const StepForces                             &forces,
          const std::vector<std::vector<BodyMomentum>> &before) override;
    std::vector<BodyMomentum>
    momenta() const override
    {
      return momenta_of(v);
    }
    std::vector<std::vector<BodyMomentum>>
    momenta_of_rates() const override
    {
      return {momenta_of(v), momenta_of(a)};
    }

  private:
    const Solid                                  &solid;
    const Vector                                 &committed_u;
    const TimeIntegrationParameters::Coefficients scheme;
    /** Owned nodes without mass. */
    const std::set<Index> massless;
    const Mass            mass;
    /** Index of the body of each owned dof. */
    std::vector<unsigned int> body;
    /** Rayleigh's factors of each owned dof (1/time and time), and whether any is not zero. */
    Vector damping_mass, damping_stiffness;
    bool   damped = false;
    /** Stiffness of the undeformed bodies, if damping needs it beside the present one. */
    Matrix initial_stiffness;
    Matrix effective;
    double effective_step = 0.;

    /** Forces on the nodes, as StepForces has them, but for the last two: the parts of the inertia
     * M a that loads and supports have (doc/time_integration.md, "The energy ledger"). */
    struct NodalForces
    {
      Vector external, internal, normal, tangential, support, load;
      NodalForces &
      operator=(const StepForces &forces);
    };

    double step = 0.;
    /** Velocity, acceleration and forces of the committed state. */
    Vector      v, a;
    NodalForces old;
    double      inertial_force_squared = 0.;
    /** The same at the end of the step; contact forces are without what an impact has taken from
     * the acceleration. */
    Vector      end_v, end_a;
    NodalForces end_forces;

    /** Acceleration and velocity at the end of the step if it ends at @p u. */
    void
    end_of_step(const Vector &u, Vector &velocity, Vector &acceleration) const;
    /**
     * Impact without rebound: remove from end_v and end_a what violates the velocity constraints of
     * active contact nodes; the work of the impulses is added to @p energies.
     */
    void
    lose_rebound(const StepForces &forces, Energies &energies);
    /** What supports must add for the nodes to move with v and a against the forces @p others,
     * which are all but those of inertia and damping. */
    Vector
    support_force(const Vector &others, const std::function<void(Vector &)> &remove_support) const;
    /** C times a velocity. */
    void
    damping_force(const Vector &velocity, Vector &force) const;
    double
    kinetic_energy(const Vector &velocity) const;
    /**
     * Momenta of each body if the nodes moved with @p velocity at the committed displacement.
     * Collective.
     */
    std::vector<BodyMomentum>
    momenta_of(const Vector &velocity) const;
    using Numbers = std::array<double, n_rigid_modes>;
    /** Products of the momentum of each body with its unit rigid motions. */
    static std::vector<Numbers>
    rigid_momenta(const std::vector<BodyMomentum> &momenta, const std::vector<RigidFrame> &frames);
    /** Velocity of all nodes, each in rigid motion @p k of its body at its present position. */
    Vector
    moved_rigidly(unsigned int k, const std::vector<RigidFrame> &frames) const;
    /** Amplitudes of the rigid motions with this momentum, or with that part of it which motions in
     * the columns of @p free can have. @param inertia Momenta of the rigid motions, as columns. */
    static Numbers
    motion_with(const Numbers                    &momentum,
                const dealii::FullMatrix<double> &inertia,
                const dealii::FullMatrix<double> &free);
    /** Combinations of the rigid @p motions of body @p b that its supports do not resist, as
     * columns. Collective. */
    dealii::FullMatrix<double>
    free_motions(unsigned int                         b,
                 const std::vector<Vector>           &motions,
                 const std::function<void(Vector &)> &remove_support) const;
    /** Stiffness for damping. */
    const Matrix &
    damping_matrix() const
    {
      return solid.linear() ? solid.stiffness() : initial_stiffness;
    }
  };
} // namespace Touchstone

#endif
