// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_impulse_contact_h
#define touchstone_explicit_impulse_contact_h

#include <touchstone/contact/contact.h>
#include <touchstone/explicit/contact_stiffness.h>
#include <touchstone/explicit/general/general_contact.h>
#include <touchstone/explicit/impulse_solver.h>
#include <touchstone/explicit/impulse_work.h>
#include <touchstone/explicit/node_map.h>
#include <touchstone/explicit/parted_surfaces.h>
#include <touchstone/explicit/row_motion.h>
#include <touchstone/explicit/surface_speeds.h>
#include <touchstone/explicit/tool_nodes.h>

#include <memory>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Energy that contact gave to the bodies, force times length: negative where it took it.
   */
  struct ImpulseEnergy
  {
    /** Of impulses along the normals and against slip, and the work of obstacles and of overlaps
     * that are pressed apart. */
    double normal = 0., friction = 0., obstacles = 0.;
    /** Work that moving obstacles do in half a cycle with the last impulses. */
    double ahead = 0.;
    /** What springs hold at present. */
    double stored = 0.;
  };

  /**
   * @brief The contact of explicit dynamics: each cycle changes the free velocities to those that
   * contact allows (doc/explicit.md, section 9).
   *
   * The rows come from Contact, that is from the same pairings as in implicit runs, and are kept
   * until motion demands others (RowMotion); in between their gaps follow the nodes. What the
   * impulses of an output interval come to goes into the RowState of the rows and into the
   * history of friction, from which all results are made.
   */
  class ImpulseContact : public Stateful
  {
  public:
    /** @param contact With an enforcement that has an ImpulseRule; must live as long, as the others
     * must.
     * @param obstacles Those of the scene.
     * @param general Null if there is none. */
    ImpulseContact(Contact                               &contact,
                   const ContactParameters               &parameters,
                   const NodeMap                         &nodes,
                   const std::vector<BodyParameters>     &bodies,
                   const std::vector<ObstacleParameters> &obstacles,
                   std::unique_ptr<GeneralContact>        general = nullptr);

    /** @brief The inverse masses of owned nodes by local node, without the directions that
     * supports determine. Must be set before the first project(), and when they change. */
    void
    set_mobility(const std::vector<dealii::SymmetricTensor<2, dim>> &inverse_mass);

    /** @brief The state is a committed one: rows are made anew in the next cycle, and what contact
     * does is counted from here. */
    void
    begin_interval();

    /**
     * @brief Change the velocities @p v with which nodes would move during the cycle from @p time
     * to @p time + @p step so that no row penetrates at its end, or as springs want it. Collective.
     * @param acting Time for which forces of springs act in the cycle; 0: @p step.
     * @param u      Displacement at the start of the cycle; ghosts as well, as of the others.
     * @param before Velocities of the cycle before, on the mean of which and the new ones forces do
     *               work. @param v Free velocities; of owned nodes those that contact allows.
     * @return false if surfaces of general contact would cross: nothing has changed but @p v, and
     * a shorter cycle may do better.
     * @throws InfeasibleContact if supports or obstacles leave no such velocity.
     * @throws InputError if an obstacle jumps.
     */
    bool
    project(const NodeField &u,
            const NodeField &before,
            NodeField       &v,
            double           time,
            double           step,
            double           acting = 0.);

    /** @brief Before the first cycle: change the velocities @p v half a cycle before @p time to
     * such that do not come from within a row that is closed and stays so with the initial
     * velocities @p start. Collective. Arguments as of project(). */
    void
    project_before(const NodeField &u,
                   const NodeField &start,
                   NodeField       &v,
                   double           time,
                   double           step);

    /** @brief An upper bound of the squared largest frequency of the springs of all rows by
     * themselves with the displacement @p u, which adds to that of the cells (doc/explicit.md,
     * section 9.3); zero where the enforcement does not touch the stable step. Collective.
     * @param step Of the order of a cycle. */
    double
    square_frequency(const NodeField &u, double time, double step);

    /** @brief Call @p use(node, impulse) for each owned node, by its local number, on which contact
     * acted in the last project(). Impulses, force times time, on supported nodes as well. */
    template <class Use>
    void
    for_each_impulse(const Use &use) const
    {
      if (acted)
        for (unsigned int node = 0; node < local.size(); ++node)
          use(local[node], solver.impulse(node));
    }

    /** @brief The interval ends with the displacement @p u: bring the rows there, and give them
     * their states and histories. Contact::commit() or rollback() follows. Collective. */
    void
    end_interval(const NodeField &u, double time);

    /** @brief Energies since begin_interval(), the same bits on any number of ranks. Collective.
     */
    ImpulseEnergy
    energy() const;

    /** @brief Since begin_interval(). */
    ImpulseWork
    work() const;

    /** @brief Null if there is none. */
    GeneralContact *
    general_contact()
    {
      return general.get();
    }

    /** @brief Obstacles that forces move: the caller gives them the velocities of a cycle before
     * project(), and moves them after it. */
    ToolNodes &
    tool_nodes()
    {
      return tools;
    }
    const ToolNodes &
    tool_nodes() const
    {
      return tools;
    }

    /** @brief The highest velocity of nodes of both sides of a pair of bodies relative to each
     * other since begin_interval(), of all pairs. */
    double
    fastest_approach() const
    {
      return fastest;
    }

    /** @name Springs from one output interval to the next */
    /** @{ */
    void
    commit() override;
    void
    rollback() override;
    void
    save(ArchiveWriter &archive) const override;
    void
    load(const ArchiveReader &archive) override;
    /** @} */

  private:
    Contact                 &contact;
    const ImpulseRule        rule;
    const ContactParameters &parameters;
    const NodeMap           &nodes;
    ImpulseSolver            solver;
    RowMotion                motion;
    SurfaceSpeeds            surfaces;
    PartedSurfaces           planes;
    Vector                   displacement;
    double                   interval_start = 0.;
    bool                     renew_rows     = true;
    /** Nothing has moved since the rows were made. */
    bool fresh = true;
    /** There were impulses in the last cycle. */
    bool acted = false;
    /** Of the cycle before and of the free velocities, and the length of the cycle before. */
    Speeds speeds_before, speeds;
    double last_step = 0., fastest = 0.;
    /** The velocities of the cycle before are its free ones, whose speeds are known. */
    bool      untouched = false;
    RowTravel travelled;
    /** There are planes between all sides, farther from them than within reach: there are no rows.
     * Their least gap when it was last measured, length, and the travel since. */
    bool      parted     = false;
    double    parted_gap = 0.;
    RowTravel parted_travel;
    /** Half the largest sum of the absolute weights of a row and its slave node, over all ranks: by
     * so much a row can move faster than its nodes do apart. */
    double largest_weights = 1.;
    /** By row of the solver: the travel up to which the gap cannot have come into reach, and the
     * least of all ranks; length. */
    std::vector<double> asleep_until;
    double              all_asleep_until = 0.;
    ImpulseWork         counted;

    /** Its rows follow those of Contact in the solver. */
    std::unique_ptr<GeneralContact> general;
    ToolNodes                       tools;
    /** Free velocities of nodes of the solver. */
    std::vector<dealii::Tensor<1, dim>> v_free;

    /** What is known of each row of Contact, by its index. */
    struct RowHistory
    {
      /** Of the last cycle. */
      dealii::Tensor<1, dim> impulse;
      bool                   sliding = false;
      /** Velocity of the obstacle in the last cycle, if it was of the interval; and in the one
       * before the present cycle. */
      dealii::Tensor<1, dim> drive, drive_before;
      bool                   driven = false;
      /** Since the interval began: impulse, slip (length), its path, work against friction, and
       * energies. */
      dealii::Tensor<1, dim> total, slip;
      double                 path = 0., friction_work = 0.;
      /** Without `ahead` and `stored`, which are those of the last cycle. */
      ImpulseEnergy energy;
      bool          pressed = false, slipped = false;
    };
    std::vector<RowHistory> history;
    RowArray<ImpulseSpring> springs{"contact springs"};
    /** Of springs by cells: K A / V at owned nodes here and at nodes of the solver. */
    std::vector<double> stiffness_of_cells, stiffness_of_nodes;
    /** Of springs: ImpulseSolver::mobilities() of the rows. */
    std::vector<std::array<double, 2>> mobilities;
    /** By pair with an obstacle: the size of its smallest face, over all ranks, length. */
    std::vector<double> smallest_face;
    /** Of these pairs, the middle of a box around the slave surface in the reference state, and
     * the distance of its corners with as much again for motion, over all ranks, length. */
    std::vector<dealii::Point<dim>> centre;
    std::vector<double>             radius;
    /** First dofs of the nodes around each slave node of a pair of bodies, by row index. */
    std::vector<std::vector<Index>> patches;

    /** What is known of each row of the solver: the row of Contact, its gap and gap vector at zero
     * displacements, length. */
    struct KeptRow
    {
      std::size_t            index;
      double                 gap;
      dealii::Tensor<1, dim> gap_vector;
      /** ContactPair::part_of_overlap() that counted when the row was made. */
      double part;
      /** The gap at the start of the cycle. */
      double at_start;
    };
    std::vector<KeptRow>     kept;
    std::vector<std::size_t> kept_rows;
    /** By node of the solver: number here of owned ones, which come before those of tools;
     * displacement, reference position,
     * displacement when the rows were made, and motion since. */
    std::vector<unsigned int>           local;
    std::vector<dealii::Tensor<1, dim>> u_nodes, x_nodes, reference, made_at, moved, v_before;
    std::vector<dealii::SymmetricTensor<2, dim>> inverse_masses;

    void
    find_patches();
    void
    find_smallest_faces();
    /** How far the point of an obstacle that is at @p x now moves in a cycle. */
    static dealii::Tensor<1, dim>
    motion_of_obstacle(const ContactPair        &pair,
                       const dealii::Point<dim> &x,
                       double                    time,
                       double                    step);
    /** An upper bound of that of all points that slave nodes of the pair may meet. */
    double
    largest_motion(unsigned int pair, double time, double step) const;
    void
    check_obstacles(double time, double step) const;
    /** Make the rows of the committed state if an interval begins. @return whether it does. */
    bool
    start_interval(const NodeField &u, double time, double step);
    /** Bring Contact to the present state. */
    void
    update_contact(const NodeField &u, double time);
    /** Rows of the present state, unless there are planes between the sides. */
    void
    renew(const NodeField &u, double time, double step);
    /** Look for planes between the sides; the rows of Contact are those of the state. */
    void
    part_sides(const NodeField &u, double time, double step);
    /** Whether the planes are still there. */
    bool
    stays_parted(const NodeField &u, double time, double step);
    /** The rows of this cycle. @return whether the fields were imported. */
    bool
    bring_rows(const NodeField &u,
               const NodeField &before,
               const NodeField &v,
               double           time,
               double           step);
    /** Rows of Contact that pressed in the last cycle leave an edge later than open ones arrive
     * there. */
    void
    tell_what_presses();
    /** Take the rows from Contact. */
    void
    make_rows(const NodeField &u);
    /** Tell the solver its rows, those of general contact as well, with their nodes at @p u. */
    void
    lay_out(const NodeField &u);
    /** Parts of make_rows(): a row that has lost its partner; one that has one, with its nodes;
     * what the nodes are like; the weights of row @p k, and its gap without motion. */
    void
    lose_partner(const ContactRow &row);
    void
    add_row(const ContactRow &from, std::vector<std::pair<Index, RowKey>> &slots);
    void
    set_nodes(const NodeField &u);
    void
    set_weights(std::size_t k);
    /** Gaps of row @p k without the displacement at which it was made. */
    void
    take_out_motion(std::size_t k);
    void
    import(const NodeField &u, const NodeField &before, const NodeField &v);
    /** What contact allows, into @p v and to tools. Collective. */
    void
    take_velocities(NodeField &v);
    /** Renew the rows if motion demands it. Collective. @return whether the rows are as they were,
     * and the fields were imported. */
    bool
    renew_if_moved(const NodeField &u,
                   const NodeField &before,
                   const NodeField &v,
                   double           time,
                   double           step);
    /** No row can be in reach in this cycle, on any rank. */
    bool
    all_asleep(double time, double step) const;
    void
    end_of_action();
    /** The same as project(), with candidates of general contact for so many times of the motion
     * that impulses may make at first. @return why it failed, or none. */
    GeneralContact::Crossings
    project_within(double           reach,
                   const NodeField &u,
                   const NodeField &before,
                   NodeField       &v,
                   double           time,
                   double           step,
                   double           acting);
    /** Solve again until no surfaces of general contact cross. @return what they did last. */
    GeneralContact::Crossings
    keep_apart(const NodeField &u,
               const NodeField &before,
               NodeField       &v,
               double           time,
               double           step,
               ImpulseCounts   &counts);
    void
    keep_drives();
    void
    set_geometry(double time, double step);
    void
    find_near_rows(double reach);
    void
    set_time_to_sleep(std::size_t k);
    /** Relative velocity of the cycle before. */
    dealii::Tensor<1, dim>
    velocity_before(const ImpulseRow &row, const RowHistory &h) const;
    double
    gap_allowed(const ImpulseRow &row, const ContactRow &of, double gap, double step) const;
    /** The gap from which on sides cannot meet within a cycle, length. */
    double
    reach(double time, double step) const;
    void
    set_pair_geometry(ImpulseRow &row, KeptRow &from, double time, double step, double reach);
    void
    set_obstacle_geometry(ImpulseRow &row, KeptRow &from, double time, double step);
    void
    set_lever(ImpulseRow &row, const ContactRow &of);
    void
    check_feasible(double step, bool converged) const;
    void
    keep_results(double step);
    void
    add_energy(const ImpulseRow &row, RowHistory &h) const;
    /** The cycle with impulses by projection, and with springs. */
    ImpulseControl
    control(double time, double step) const;
    ImpulseCounts
    solve(double time, double step);
    ImpulseCounts
    push(double time, double step, double acting);
    double
    stiffness(std::size_t k, double step) const;
    /** K A / V of the slave and the master side of a row between nodes. */
    std::pair<double, double>
    stiffness_of_sides(const ImpulseRow &row) const;
    void
    push_row(std::size_t k, double time, double step, double acting);
    void
    push_friction(std::size_t k, double normal_force, double time, double step);
    void
    keep_springs(double step);
  };
} // namespace Touchstone

#endif
