// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_impulse_solver_h
#define touchstone_explicit_impulse_solver_h

#include <touchstone/base/exact_sum.h>
#include <touchstone/contact/friction/friction.h>
#include <touchstone/explicit/normal_rows.h>
#include <touchstone/explicit/row_nodes.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <vector>

namespace Touchstone
{
  /**
   * @brief A contact row in one cycle: the relative velocity w = sum A_a v_a - drive, and the
   * impulse p on its slave side, which changes the velocities by W A^T p (doc/explicit.md, section
   * 9.1).
   */
  struct ImpulseRow
  {
    /** @name Fixed while the row is kept */
    /** @{ */
    RowKey key;
    /** Its slots: of the slave node and the stencil, and after them of the nodes that take up the
     * moment of a lever. */
    std::size_t  first   = 0;
    unsigned int n_nodes = 0, n_lever = 0;
    /** The slave and master surface are joined. */
    bool tied = false;
    /** Null without friction. */
    const FrictionRow *friction = nullptr;
    double             area     = 0.;
    /** Neither joined nor with friction when the rows were laid out: forces act along the normal.
     * Set by ImpulseSolver::resize(). */
    bool along_normal = false;
    /** @} */

    /** @name Input of the cycle */
    /** @{ */
    dealii::Tensor<1, dim> normal;
    /** Projector onto the directions of friction; zero without. */
    dealii::Tensor<2, dim> tangential;
    /** Velocity that the gap leaves free: n . w >= -allowed. Of tied rows w = -allowed n. */
    dealii::Tensor<1, dim> allowed;
    /** Velocity of the obstacle. */
    dealii::Tensor<1, dim> drive;
    /** The lever entries act. */
    bool levered = false;
    /** The sides are so far apart that they cannot meet in this cycle: the row takes no part. */
    bool distant = false;
    /** Slips since the cycle before. */
    bool sliding = false;
    /** Slip path before the cycle, length. */
    double slip_length = 0.;
    /** @} */

    /** @name Result, and start of the next cycle */
    /** @{ */
    /** On the slave side, force times time. */
    dealii::Tensor<1, dim> impulse;
    /** Relative velocity at the end of the cycle, and before impulses. */
    dealii::Tensor<1, dim> velocity, free_velocity;
    /** Supports determine the motion along the normal, but not as contact requires. */
    bool blocked = false;
    /** @} */
  };

  /** @brief How the impulses of a cycle are found. */
  struct ImpulseControl
  {
    double       tolerance = 1e-10;
    unsigned int sweeps    = 200;
    /** One sweep from no impulses. */
    bool one_sweep = false;
    /** Nesterov's acceleration; and the part of the minimum of the bound that a sweep takes, below
     * 2: without acceleration and from 1 on sweeps are updates of multipliers. */
    bool   accelerate = true;
    double relaxation = 1.;
    /** Length of the cycle, and time at its end, for friction laws. */
    double step = 1., time = 0.;
  };

  /** @brief Work of a cycle, over all ranks. */
  struct ImpulseCounts
  {
    unsigned int sweeps = 0, rounds = 0;
    /** Conjugate gradient iterations between sweeps, each of which costs as much as one. */
    unsigned int on_faces = 0;
    /** Rows that took part, of this rank. */
    std::size_t active    = 0;
    bool        converged = true;
  };

  /**
   * @brief The impulses of a cycle: minimise 1/2 |v - v*|_M^2 subject to n . w + allowed >= 0 in
   * each row, with friction (doc/explicit.md, sections 9.1 to 9.3).
   *
   * Each sweep moves all rows at once, by the steepest bound of the mass that they share,
   * accelerated by Nesterov's method with restarts and, where that is slow, by conjugate gradients
   * on the impulses that press. Impulses act with the stencils that measure the velocity,
   * so that momentum is exact after any sweep. Sums run in the order of row keys and convergence is
   * judged by maxima: the result has the same bits on any number of ranks.
   */
  class ImpulseSolver
  {
  public:
    explicit ImpulseSolver(MPI_Comm communicator);

    /** The nodes of the slots. */
    RowNodes                nodes;
    std::vector<ImpulseRow> rows;
    /** Indices of the rows that are looked at in this cycle, in ascending order; the others are
     * distant and have no impulse. All after resize(). */
    std::vector<std::size_t> near;
    /** By slot: the weight, or of lever entries the matrix by which the impulse acts on the
     * node; of rows that act along their normal what it does to the normal. The matrices only if
     * there are other rows. */
    std::vector<double>                 weights;
    std::vector<dealii::Tensor<2, dim>> levers;
    std::vector<dealii::Tensor<1, dim>> on_normals;
    /** By node: inverse mass, without the directions of supports; and velocities, ghosts as well.
     */
    std::vector<dealii::SymmetricTensor<2, dim>> mobility;
    std::vector<dealii::Tensor<1, dim>>          velocity;

    /** @brief Take the arrays by node and slot to their lengths, after nodes.reinit(), for the
     * rows that are there. Collective. */
    void
    resize();

    /** @brief Sum over the slots of a row in the order of these keys of nodes; comes after
     * resize(). @param keys By node, ghosts as well. */
    void
    sort_slots(const std::vector<std::uint64_t> &keys);

    /** @brief The impulses on an owned node in the last solve(), force times time. */
    const dealii::Tensor<1, dim> &
    impulse(const unsigned int node) const
    {
      return sums[node];
    }

    /** @brief Relative velocity w of a row in any velocities by node, ghosts as well. */
    dealii::Tensor<1, dim>
    relative_velocity(const ImpulseRow &row, const std::vector<dealii::Tensor<1, dim>> &v) const;

    /** @brief The slots of a row's own nodes in the order of sort_slots(). */
    std::size_t
    slot(const ImpulseRow &row, const unsigned int i) const
    {
      return order[row.first + i];
    }

    /** @brief Find the impulses and change #velocity by them. Collective. */
    ImpulseCounts
    solve(const ImpulseControl &control);

    /** @brief Change #velocity by the impulses that the rows have. Collective. */
    ImpulseCounts
    apply_given();

    /** @brief Bounds of the mobility of each row with all others, inverse mass: the springs k along
     * normals (or in all directions, of tied rows) and k_t across them have no squared frequency
     * above the largest k times the first and k_t times the second. Collective. */
    std::vector<std::array<double, 2>>
    mobilities();

  private:
    /** After so many sweeps the face that they have found is explored, and again after so many
     * more. Those of declared pairs, whose rows say different things, mostly end before. */
    static constexpr unsigned int first_exploration = 20, between_explorations = 1;
    /** A mobility below this part of all that of the nodes of a row is round-off: supports decide
     * along that direction. */
    static constexpr double immobile = 1e-10;
    /** Bounds of the mobility that a row shares, inverse mass. */
    struct Metric
    {
      double                 normal = 0., tangential = 0.;
      dealii::Tensor<1, dim> tied;
    };
    std::vector<Metric>                 metric;
    std::vector<dealii::Tensor<1, dim>> extrapolated, present, on_rows;
    std::vector<dealii::Tensor<1, dim>> at_slots, sums, free;
    std::vector<unsigned char>          active; // 0 or 1
    std::vector<std::size_t>            order;

    /** @name Sweeps over rows that act along their normals, all of all ranks */
    /** @{ */
    bool                     along_normals = false;
    std::vector<std::size_t> by_key;
    NormalRows               normal_rows;
    /** @} */

    dealii::Tensor<1, dim>
    relative_velocity(const ImpulseRow &row) const
    {
      return relative_velocity(row, velocity);
    }
    /** Set #velocity to what these impulses lead to. */
    void
    apply(const std::vector<dealii::Tensor<1, dim>> &impulses);
    /** Slots of rows that take no part have no impulse. */
    void
    clear_slots()
    {
      std::fill(at_slots.begin(), at_slots.end(), dealii::Tensor<1, dim>());
    }
    void
    set_metric();
    Metric
    metric_of(const ImpulseRow &row) const;
    dealii::Tensor<1, dim>
    improve(ImpulseRow                   &row,
            const Metric                 &m,
            const dealii::Tensor<1, dim> &from,
            const ImpulseControl         &control) const;
    /** Of the nodes of a row and the obstacle, the largest: the scale of round-off. */
    double
    speed(const ImpulseRow &row) const;
    double
    violation(const ImpulseRow &row, const dealii::Tensor<1, dim> &w) const;
    bool
    activate(double tolerance);
    double
    velocity_tolerance(double relative) const;
    bool
    sweep(const ImpulseControl &control, double tolerance, ImpulseCounts &counts);
    /** @name The same with #normal_rows in place of vectors for each row */
    /** @{ */
    /** Collect the active rows, in the order of their keys. */
    void
    collect_acting();
    void
    set_normal_metric(double relaxation);
    /** Make the sums at the nodes, or those of the sizes, complete with what rows of other ranks
     * add. */
    void
    sum_shared_entries(double NormalRows::Row::*impulse);
    void
    sum_shared_sizes();
    void
    apply_normal(double NormalRows::Row::*impulse);
    bool
    sweep_normal(const ImpulseControl &control, double tolerance, ImpulseCounts &counts);
    /** Whether the last sweep moved the impulses away from where its momentum points. Collective.
     * @param largest Change of a velocity and of an impulse in it, of all ranks. */
    bool
    turned(const double (&largest)[2]) const;
    /** Set the sums, velocities and relative velocities that the impulses lead to. */
    void
    finish_normal();
    void
    put_impulses();
    /** Set velocities of the nodes to what impulses change them by. */
    void
    respond_normal(double NormalRows::Row::*impulse);
    void
    explore_normal_face(const ImpulseControl &control, double tolerance, ImpulseCounts &counts);
    /** Its vectors by row. */
    std::vector<double> along, scaled;
    /** @} */
    /** Conjugate gradients from the present impulses on. */
    void
    explore_face(const ImpulseControl &control, double tolerance, ImpulseCounts &counts);
    dealii::Tensor<1, dim>
    on_face(const ImpulseRow &row, const dealii::Tensor<1, dim> &vector) const;
    dealii::Tensor<1, dim>
    preconditioned(const ImpulseRow             &row,
                   const Metric                 &m,
                   const dealii::Tensor<1, dim> &residual) const;
    void
    restrain();
  };
} // namespace Touchstone

#endif
