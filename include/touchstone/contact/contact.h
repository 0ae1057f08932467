// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_contact_h
#define touchstone_contact_contact_h

#include <touchstone/algebra/ghost_import.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/enforcement/cyclic_constraints.h>
#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/contact/friction/friction_rows.h>
#include <touchstone/contact/nodes_without_rows.h>
#include <touchstone/contact/velocity_constraints.h>

#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace Touchstone
{
  /** @brief Part of a contact force. */
  enum class ForcePart
  {
    all,
    normal,
    tangential
  };

  /**
   * @brief All contact pairs of a scene, their friction and their enforcement: each owns its
   * part of the state, and this class calls them in order. Quantities that are derived from the
   * state are free functions: results.h, contact_checks.h, velocity_constraints.h.
   */
  class Contact : public Stateful
  {
  public:
    using Mirrors = ContactPair::Mirrors;

    /** @param inputs     Input of the pairs, in their order.
     * @param parameters How they are enforced; must live as long as this.
     * @param mirrors    Normals of planes of symmetry, see BoundaryConditions::mirrors().
     * @param supports   Directions in which displacements of owned nodes are prescribed, planes of
     *                   symmetry among them, by node.
     * @throws InputError for boundaries that do not exist, and surfaces without faces. */
    Contact(const std::vector<ContactPairInput> &inputs,
            const ContactParameters             &parameters,
            const Solid                         &solid,
            const Mirrors                       &mirrors  = Mirrors(),
            const Mirrors                       &supports = Mirrors());
    Contact(const Contact &) = delete;

    /** @brief The rows of this rank, pair after pair. */
    const ContactRows &
    rows() const
    {
      return all_rows;
    }

    /** @brief A row as of the last committed state. */
    const ContactRow &
    committed(const ContactRow &row) const
    {
      const ContactPair &own = *pairs[row.pair];
      return own.committed_rows()[row.index - own.rows().front().index];
    }

    /** @brief Status and force of a row. */
    const RowState &
    state(const ContactRow &row) const
    {
      return method->states()[row];
    }

    unsigned int
    n_pairs() const
    {
      return pairs.size();
    }

    const ContactPair &
    pair(const unsigned int p) const
    {
      return *pairs[p];
    }

    /** @brief The pair of a row. */
    const ContactPair &
    pair(const ContactRow &row) const
    {
      return *pairs[row.pair];
    }

    /** @brief Slave nodes of the pair @p p that have no rows where they can leave them to others,
     * since supports hold both sides: see held_nodes(). The same on all ranks. */
    const std::set<Index> &
    held(const unsigned int p) const
    {
      return without_rows.held[p];
    }

    /** @brief Normals of the planes of 'Symmetry' that nodes lie on, those that are none of what
     * the body touches among them; see ContactPair::planes_of_symmetry(). */
    const Mirrors &
    planes_of_symmetry() const
    {
      return mirrors;
    }

    const Friction &
    friction() const
    {
      return friction_rows;
    }

    Enforcement &
    enforcement()
    {
      return *method;
    }
    const Enforcement &
    enforcement() const
    {
      return *method;
    }

    const CyclicConstraints &
    cyclic_constraints() const
    {
      return cyclic;
    }

    const Solid &
    solid_model() const
    {
      return solid;
    }

    MPI_Comm
    communicator() const
    {
      return solid.communicator;
    }

    /** @brief Draw the sides of the tied pair @p p together by this length, from the next update()
     * on. */
    void
    set_shortening(const unsigned int p, const double length)
    {
      pairs[p]->cut()->set_shortening(length);
    }

    /** @brief Let these material points of the pair @p p have rows from the next update() on, the
     * same on all ranks; see ContactPair::takes_points(). */
    void
    set_points(unsigned int p, const std::vector<MaterialPoint> &points);

    /** @brief A step begins in the committed state: slave nodes leave their rows to others where
     * pairs meet in it, and only there. Collective.
     * @param u The committed displacement, @param time its time. */
    void
    begin_step(const Vector &u, double time);

    /** @brief Whether pairs meet at more nodes in the displacement of the last update() than when
     * the step began: it is to begin_again() and be solved with the rows of these nodes left to
     * others. Collective. */
    bool
    find_formed(const Vector &u);

    /** @brief The last update() was in a state of balance: whether slave nodes have left edges of
     * the master that they were to stay on in this step, which is to begin_again(). Collective. */
    bool
    leave_edges();

    /** @brief Return to the committed state, but with the material points that have rows now,
     * without the nodes that leave_edges() has found, and
     * with the rows that find_formed() asks for: the step is solved again. Collective.
     * @param u, time As for begin_step(). */
    void
    begin_again(const Vector &u, double time);

    /** @brief Update the geometry of the rows, and the slip, to the displacement @p u (owned dofs)
     * at time @p time. Collective. */
    void
    update(const Vector &u, double time);

    /** @brief Set the derivatives of the active rows in the displacement of the
     * last update(), for the consistent linearisation. Collective. */
    void
    differentiate();

    /** @brief Add the contact forces M^T f of all rows, or a part of them, to @p force.
     * Collective. */
    void
    add_forces(Vector &force, ForcePart part = ForcePart::all) const;

    /** @brief Work of a part of the contact forces on the displacement that obstacles made
     * since the committed state, force times length: the bodies get it from outside.
     * Collective.
     * @param weight Of the forces at the end of the step, those at its beginning having the rest,
     * as in the work on nodes: else nodes that an obstacle carries along would do work on it. */
    double
    work_of_obstacles(ForcePart part, double weight) const;

    /** @brief Work of the contact forces on the overlaps that the bodies are placed with and that
     * enter the gap from the committed state, of the time @p from, to that of the last update(),
     * force times length. The bodies get it from outside, as from one who presses them into each
     * other. Collective. @param weight As in work_of_obstacles(). */
    double
    work_of_overlaps(double weight, double from) const;

    /** @brief What nodes pass through counts from the displacement of the last update() on: the
     * rows of explicit dynamics are updated within a step. */
    void
    commit_positions();

    /** @brief Steps are explicit: they follow friction through their cycles and tell what came of
     * it by record_friction(), and commit() makes no history of its own. */
    void
    follow_cycles()
    {
      in_cycles = true;
    }

    /** @brief What friction did in a row in the step that ends, see follow_cycles().
     * @param force Tangential. @param slip Of the step, length. @param path Its length.
     * @param work Against friction, force times length. */
    void
    record_friction(const ContactRow             &row,
                    const dealii::Tensor<1, dim> &force,
                    const dealii::Tensor<1, dim> &slip,
                    double                        path,
                    double                        work);

    /** @brief The fraction of the displacement since the committed state after which the first
     * open row closes, with gaps that change linearly; 1 if none does. Collective. */
    double
    part_to_touch() const;

    /** @brief What the forces of a step of the length @p step with inertia, which is about to be
     * committed, amount to: the mean force of each pair; and with impacts without rebound (else
     * null) what their impulses add to the reported forces, and excess forces to those that the
     * next step begins with. @param end_weight As in work_of_obstacles(). Collective. */
    void
    keep_impulses(const std::vector<VelocityConstraint> *constraints,
                  double                                 step,
                  double                                 end_weight);

    /** @brief Mean over the last step of the force on the slave body, if keep_impulses() has been
     * called for it. */
    std::optional<dealii::Tensor<1, dim>>
    mean_force(const unsigned int pair) const
    {
      return mean_forces.empty() ? std::nullopt : std::optional(mean_forces[pair]);
    }

    /** @brief What impulses add to the reported force of a row, until the next update(). */
    const dealii::Tensor<1, dim> &
    impulse_force(const ContactRow &row) const
    {
      return impulse_forces[row].force;
    }

    void
    commit() override;
    void
    rollback() override;
    void
    save(ArchiveWriter &archive) const override;
    /** @brief Continue from save() with the committed displacement of the archive. The rows have
     * been made by an update() in the reference state. */
    void
    load(const ArchiveReader &archive) override;

    /** Number of fields of a pair in fields(). */
    static constexpr unsigned int n_fields = 3;

    /**
     * @brief What a change of the mesh carries over, as fields over the dofs:
     * per pair the contact traction; whether a node is active, sticks, and nothing;
     * slip length and work against friction per area, and nothing.
     *
     * Densities, and not nodal forces, because only they can be interpolated; a new node
     * multiplies them by its own area.
     * @param of_committed Of the last committed state instead of the present one.
     */
    std::vector<Vector>
    fields(bool of_committed) const;

    /**
     * @brief Take state and forces of the rows from fields of the same kind over
     * new dofs, in the displacement of the last update().
     * @param history Take slip and work, too, and let this be the committed state:
     *                a step begins here.
     */
    void
    adopt(const std::vector<Vector> &fields, bool history);

    /** @brief Work against friction by pair until the committed state, force times length; what
     * rows did that are no more is part of it. Collective. */
    std::vector<double>
    friction_work() const;

    /** @brief Rows have been made anew, and what they have taken over of their histories is not all
     * of the work @p of_pairs that friction_work() had before. Collective. */
    void
    keep_friction_work(const std::vector<double> &of_pairs);

    /** @brief Of it what rows of pair @p p did that are no more, force times length. */
    double
    friction_work_of_former_rows(unsigned int p) const
    {
      return former_friction_work[p];
    }

    /** @brief Time of the last update(). */
    double
    time() const
    {
      return present_time;
    }

    /** @brief Displacement of the last update() with the ghosts that the surfaces need; empty if
     * there are no pairs. */
    const Vector &
    ghosted_displacement() const
    {
      return ghosted;
    }

    /** @brief A field over owned dofs with the same ghosts. Collective. */
    Vector
    with_ghosts(const Vector &owned) const;

    unsigned int
    n_searches() const;

  private:
    /** What adopt() takes for a row. */
    void
    adopt(const ContactRow &row, const std::vector<Vector> &fields, bool history);

    /** What @p of says of a row and its state at the end of the step, with @p weight, and at its
     * beginning, with the rest; nothing where the row is not active. */
    template <class OfRow>
    auto
    over_step(const ContactRow &row, double weight, const OfRow &of) const;

    /** Set #ghosted. */
    void
    move(const Vector &u);

    struct ImpulseForce
    {
      /** What is added to the reported force, for results of one step only: in no checkpoint; and
       * to the force that the next step begins with. */
      dealii::Tensor<1, dim> force, at_start;

      template <class Self, class Visitor>
      static void
      visit_state(Self &self, Visitor &&visit)
      {
        visit(self.at_start);
      }
    };

    const Solid                              &solid;
    const Mirrors                             mirrors, supports;
    std::vector<std::unique_ptr<ContactPair>> pairs;
    ContactRows                               all_rows;
    Friction                                  friction_rows;
    std::shared_ptr<Enforcement>              method;
    CyclicConstraints                         cyclic;
    RowArray<ImpulseForce>                    impulse_forces;
    /** By pair; empty in statics and explicit dynamics. */
    std::vector<dealii::Tensor<1, dim>> mean_forces;
    /** By pair: friction_work_of_former_rows(). Changes between steps alone. */
    std::vector<double> former_friction_work;
    /** Of the committed state, and of the present one. */
    NodesWithoutRows                      without_rows;
    std::optional<NodesWithoutRowsFinder> without_rows_finder;
    /** What find_formed() has found in this attempt of a step. */
    std::optional<NodesWithoutRows> formed;
    /** Displacement with the ghosts that the surfaces need; empty without pairs. */
    Vector                             ghosted;
    mutable std::optional<GhostImport> import_ghosts;
    bool                               started = false, in_cycles = false;
    /** In the last update slave faces were covered by several pairs. */
    bool   shares_faces = false;
    double present_time = 0.;

    /** Of the first update: NodesWithoutRows. Collective. */
    void
    leave_rows(const Vector &u);

    /** The present rows of all pairs. */
    RowsByPair
    rows_by_pair() const;

    /** Rows of all pairs in the displacement of #ghosted, as if no node left its row to others.
     * @param u The same displacement, owned dofs. Collective. */
    RowsByPair
    rows_of_all_nodes(const Vector &u);

    /** Let other nodes be without rows: the committed state, of a displacement @p u and time, goes
     * over to the new rows. Collective. */
    void
    change_rows(const NodesWithoutRows &nodes, const Vector &u, double time);

    /** Make the rows of a pair as in a first update without displacements. Collective. */
    void
    make_rows_anew(std::size_t p, const std::set<Index> &nodes);

    void
    save_nodes_without_rows(ArchiveWriter &archive) const;
    void
    load_nodes_without_rows(const ArchiveReader &archive);

    /** After all pairs have been updated: rows of slave faces that several pairs cover.
     * Collective. */
    void
    complete_cover(const Vector &u);

    /** All objects with history, in the order in which they are committed and loaded. */
    std::vector<Stateful *> parts;
  };
} // namespace Touchstone

#endif
