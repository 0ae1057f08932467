// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_explicit_step_h
#define touchstone_drive_explicit_step_h

#include <touchstone/drive/step.h>
#include <touchstone/explicit/explicit_cells.h>
#include <touchstone/explicit/impulse_contact.h>
#include <touchstone/explicit/nodal_loads.h>
#include <touchstone/explicit/node_supports.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief An output interval of explicit dynamics: as many cycles of central differences with
   * lumped mass as the stable step asks for (doc/explicit.md).
   *
   * The state holds the displacement at the end of a cycle and the velocity in its middle.
   * Everything in a cycle is done on plain arrays; results have the same bits on any number of
   * ranks.
   */
  class ExplicitStep : public Step, public CommittedMotion
  {
  public:
    ExplicitStep(const Scene         &scene,
                 const Forest        &forest,
                 Solid               &solid,
                 dealii::TimerOutput &timer);
    ~ExplicitStep() override;

    std::vector<std::string>
    start() override;
    /** @return 0: there are no iterations. @throws ExplicitFailure */
    unsigned int
    solve(double t, const NewtonParameters &parameters, const Newton::Observer &observer) override;
    void
    prepare(double) override
    {
    }
    StepFindings
    findings() const override;
    StepDifficulty
    difficulty() const override
    {
      return {};
    }
    double
    try_commit(double smallest_part) override;
    void
    rollback() override;
    StepState
    state() const override;
    const CycleCounts *
    cycle_counts() const override
    {
      return &counts;
    }
    void
    add_contact_results(std::vector<ContactFace>  &faces,
                        std::vector<ContactPoint> &points) const override;
    std::string
    advice() const override;
    /** @throws dealii::ExcInternalError: scenes with refinement are refused
     * (check_combinations()), and nothing else changes the mesh. */
    StepTransfer
    transfer() const override;
    void
    adopt(const StepTransfer &before, double t) override;
    void
    save(ArchiveWriter &archive) override;
    void
    load(const ArchiveReader &archive) override;

    bool
    dynamic() const override
    {
      return true;
    }
    std::vector<const Vector *>
    rates() const override
    {
      return {&velocity};
    }
    std::vector<BodyMomentum>
    momenta() const override;

  private:
    /** The end of a cycle, without the motion. */
    struct Balance
    {
      double time = 0.;
      /** Length of the cycle. */
      double length = 0.;
      /** Forces on the nodes at the end of the cycle: of loads (empty if there are none), of
       * stress and of bulk viscosity. */
      NodeField external, internal, viscous;
      /** Forces of supports during the cycle, by place in NodeSupports::nodes(). */
      NodeField support;

      /** All but those of supports. */
      dealii::Tensor<1, dim>
      force(const unsigned int node) const
      {
        return external.empty() ? internal[node] + viscous[node]
                                : external[node] + internal[node] + viscous[node];
      }
    };
    /** What a cycle changes. */
    struct State : Balance
    {
      NodeField u, v;
    };

    /** Work since the committed state by owned node, force times length; empty where there is none
     * of the kind. */
    struct NodalWork
    {
      std::vector<double> external, viscous, damping;

      void
      reset()
      {
        for (std::vector<double> *kind : {&external, &viscous, &damping})
          std::fill(kind->begin(), kind->end(), 0.);
      }
    };

    const Scene              &scene;
    Solid                    &solid;
    dealii::TimerOutput      &timer;
    const ExplicitParameters &parameters;
    BoundaryConditions        boundary_conditions;
    Contact                   contact;
    NodeMap                   map;
    NodeSupports              supports;
    /** Null without contact pairs. */
    std::unique_ptr<ImpulseContact> impulses;
    NodalLoads                      loads;
    ExplicitCells                   cells;
    State                           now;
    /** The committed state. Its displacements and velocities are the vectors for results. */
    Balance kept;
    /** Its velocities of supported nodes, by place as in Balance::support. */
    NodeField kept_on_supports;
    NodalWork work;
    /** Velocity before a cycle; empty if nothing asks for it: no contact, supports or damping. */
    NodeField v_before;
    /** Stable step of all cells together over that of the cells by themselves, at least 1. */
    double assembled_to_cells = 1.;
    /** Of the supports in the interval so far, as State::support. */
    NodeField    support_impulse;
    StepFindings found;
    /** Of a pair whose contact forces have been far from normal to the slave surface since so many
     * intervals: their impulse, and the highest velocity of both sides relative to each other. */
    struct ObliqueContact
    {
      double impulse = 0., speed = 0.;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &impulse &speed;
      }
    };
    std::vector<ObliqueContact> oblique, oblique_now;
    /** Why such a contact ends the run, if it does. */
    std::string persistent;
    /** Where surfaces of general contact have crossed first, and passed through their plane of
     * symmetry, for warnings. */
    std::string crossed, mirrored;
    /** Half a cycle's work of moving obstacles at the committed state, and what contact springs
     * hold at present; force times length. */
    double obstacles_ahead = 0., obstacles_ahead_now = 0., held_by_springs = 0.;
    /** Rayleigh's mass factor by owned node, 1/time; empty if there is none. */
    std::vector<double> damping;
    CycleCounts         counts;
    /** The committed displacement and velocity for results. */
    Vector displacement, velocity;

    /** Tell contact the inverse masses without the directions of supports, for a cycle whose forces
     * act for the time @p between. */
    void
           set_mobilities(double between);
    double mobile_for = 0.;
    /** Impulse that changes the velocity of an owned node by one: the mass, and the damping of what
     * the velocity changes by, since that is damped with the mean of both ends. */
    double
    damped_mass(const unsigned int node, const double between) const
    {
      return cells.masses()[node] * (damping.empty() ? 1. : 1. + 0.5 * damping[node] * between);
    }
    std::vector<std::string>
    names_of_bodies() const;
    /** Set initial displacements and velocities by the formulas of the bodies. */
    void
    set_initial_values();
    void
    set_from_formulas(const std::string         &key,
                      std::array<std::string, 3> BodyParameters::*formulas,
                      NodeField                                  &field) const;
    /** Forces at the present time and displacement, the history of the materials going on by @p
     * step. @throws ExplicitFailure on all ranks */
    void
    evaluate_forces(double step);
    /** Equal cycles up to the end of the interval, and after how many of them the stable step must
     * be computed anew. */
    struct Plan
    {
      unsigned int cycles = 1, next = 1;
    };
    /** Compute the stable step. @param t End of the interval. */
    Plan
    plan_cycles(double t);
    /** The stable step of the cells and of contact springs of squared frequencies up to @p square.
     */
    double
    with_springs(double length, double square) const;
    /** Shorten the stable step where damping in proportion to the mass is large for it. */
    void
    shorten_for_damping();
    /** Set assembled_to_cells at the displacement of the committed state. @param of_cells Stable
     * step of the cells, time. Collective. */
    void
    find_assembled_step(double of_cells);
    /** Set the warnings on the state at the end of an interval. Collective. */
    void
    judge();
    /** Those of surfaces of general contact. Collective. */
    void
    judge_surfaces();
    /** Watch for directions of contact forces that are not right, in an interval of this length.
     * Collective. */
    void
    judge_directions(double length);
    /** One cycle of this length, or as many shorter ones as general contact needs.
     * @param halved So many times. @throws ExplicitFailure if that is too often. */
    void
    cycle(double length, unsigned int halved = 0);
    /** Set now.v to the velocity that forces and supports give. */
    void
    kick(double length);
    /** Add half of the work of a cycle, that of the present forces, and the work of damping. */
    void
    add_work(double length);
    void
    add_damping(double length);
    /** Let contact change the velocities of a cycle. @return false if it cannot. */
    bool
    press(double length);
    /** Work of supports in a cycle. */
    void
    add_support_work(double length);
    /** @throws ExplicitFailure if a cell of this rank has failed or a velocity is not finite. */
    void
    check(const CellPlace &failed) const;
    /** @throws ExplicitFailure if corners of a cell have passed through each other. Collective. */
    void
    check_inverted() const;
    /** Collective. */
    double
    round_off_of_energies() const;
    double
    work_ahead(const Balance &at, const dealii::Tensor<1, dim> &v, unsigned int node) const;
    /** Energies at the end of the present interval. Collective. */
    Energies
    energies();
    /** The present state is the committed one from here on. */
    void
    keep();
  };
} // namespace Touchstone

#endif
