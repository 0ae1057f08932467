// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_rigid_tools_h
#define touchstone_drive_rigid_tools_h

#include <touchstone/base/stateful.h>
#include <touchstone/contact/rigid_tool.h>
#include <touchstone/drive/broyden.h>
#include <touchstone/drive/time_parameters.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Obstacles that forces move in implicit steps (doc/theory.md 4.5): in statics they are in
   * equilibrium, in dynamics rigid bodies with inertia, in the same scheme as the nodes.
   *
   * Their displacements and turns are the unknowns of Broyden's method around Newton's: contact
   * sees an obstacle that stands somewhere, whatever the enforcement, the rows and the solver. In
   * the equations turns are multiplied and moments divided by RigidTool::length(), so that all
   * unknowns are lengths and all residuals forces.
   */
  class RigidTools : public Stateful
  {
  public:
    /** @param contact, obstacles Must live as long as this.
     * @param residual_tolerance To which Newton's method finds forces, relative. Collective. */
    RigidTools(const std::vector<ObstacleParameters> &obstacles,
               const TimeIntegrationParameters       &time_integration,
               double                                 residual_tolerance,
               const Contact                         &contact);

    /** @brief At time 0, after the first update of contact. @throws InputError for a free direction
     * that contact cannot resist, in statics. Collective. */
    void
    start();

    /** @brief Put the obstacles where a step to time @p t is first solved. */
    void
    begin_step(double t);

    /**
     * @brief Move the obstacles if they are not in balance in the state that has been found, of the
     * displacement @p u with ghosts. Collective.
     * @return whether they were moved, so that the state has to be found anew.
     * @throws NotBalanced after too many changes. @throws NothingResists @throws ToolSlides
     */
    bool
    correct(const Vector &u);

    /** @brief Of the last correct(), by name of the obstacle. */
    std::map<std::string, RigidToolResult>
    results() const;

    void
    commit() override;
    void
    rollback() override;
    void
    save(ArchiveWriter &archive) const override;
    void
    load(const ArchiveReader &archive) override;

    /** What goes over to another mesh, and into checkpoints. */
    struct Transfer
    {
      std::vector<RigidTool::State> states;
      /** Of Broyden's method, for steps of this length. */
      Broyden::Numbers inverse;
      double           step = 0.;
      double           time = 0.;
      /** Motion since; not in checkpoints. */
      Broyden::Numbers guess;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &states &inverse &step &time;
      }
    };
    Transfer
    transfer() const;

    /** @brief Continue on another mesh: the obstacles are at the committed state, until
     * continue_at() puts them where they were in the present one. */
    void
    adopt(const Transfer &before);
    void
    continue_at(double t, const Broyden::Numbers &of_other_mesh);

  private:
    /** A direction of an obstacle. */
    struct Unknown
    {
      unsigned int tool, component;
      /** Factor that makes a length of it. */
      double scale;
    };
    using Numbers    = Broyden::Numbers;
    using Components = RigidTool::Components;

    const double                                           residual_tolerance;
    const Contact                                         &contact;
    std::vector<RigidTool>                                 tools;
    std::optional<TimeIntegrationParameters::Coefficients> scheme; // none in statics
    std::vector<Unknown>                                   unknowns;
    Broyden                                                broyden;
    Numbers                                                committed_inverse;
    /** Where the next step begins, if not where it would. */
    Numbers guess;
    double  time = 0., committed_time = 0., step = 0., committed_step = 0.;
    /** In this step. */
    unsigned int approaches = 0;

    void
    place();
    Components
    motion_of(unsigned int tool) const;
    /** Force and moment of inertia along fixed axes; sets velocity and acceleration. */
    Components
    inertia(RigidTool &tool, const Components &motion) const;
    /** By unknown what is missing to balance, with changed sign, and the largest force or moment on
     * its obstacle; the largest of all; and the largest with what bodies hold obstacles by in
     * directions that are not free; the largest load. */
    struct Residual
    {
      Numbers missing, size;
      double  largest = 0., of_bodies = 0., of_loads = 0.;
    };
    Residual
    residual(const std::vector<PairResult> &results);
    /** The unknown that is farthest from balance, if any is not in balance. */
    std::optional<std::size_t>
    worst(const Residual &residual) const;
    Numbers
    stiffness(const std::vector<PairResult> &results) const;
    /** Bring obstacles that touch nothing to where they do, in statics. @return whether any. */
    bool
    approach(const Numbers &residual, double scale, const std::vector<PairResult> &results);
    double
    way_to_touch(const RigidTool &tool, const Components &direction) const;
    /** The force that moves an obstacle which touches nothing, zero for all others. */
    double
    loose_force(unsigned int                   tool,
                const Numbers                 &residual,
                double                         scale,
                const std::vector<PairResult> &results) const;
    /** How far an obstacle would go along its load to touch a body, in the unknowns. */
    double
    way_along_load(unsigned int tool, const Numbers &residual, double force) const;
    /** Let Broyden's method see obstacles that it has thrown off where they begin to touch. */
    void
    return_to_touch(const Numbers &residual, double scale, const std::vector<PairResult> &results);
    /** End the attempt: the balance does not change along @p direction.
     * @throws ToolSlides @throws NothingResists */
    [[noreturn]] void
    give_up(const Numbers &direction, const std::vector<PairResult> &results) const;
    /** The obstacle and component that @p direction is mostly of, for messages. */
    std::string
    name(const Numbers &direction) const;
    /** Which rows resist which unknowns, at time 0. */
    void
    check_resistance() const;
  };
} // namespace Touchstone

#endif
