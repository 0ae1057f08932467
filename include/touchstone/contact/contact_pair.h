// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_contact_pair_h
#define touchstone_contact_contact_pair_h

#include <touchstone/base/stateful.h>
#include <touchstone/contact/contact_parameters.h>
#include <touchstone/contact/friction/friction.h>
#include <touchstone/contact/geometry/surface.h>
#include <touchstone/contact/pairing/pairing.h>
#include <touchstone/contact/pairing/point_rows.h>
#include <touchstone/contact/plane_cut.h>
#include <touchstone/contact/row.h>
#include <touchstone/mesh/forest.h>
#include <touchstone/solid/solid.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace Touchstone
{
  /** @brief Input of a contact pair. */
  struct ContactPairInput
  {
    const ContactPairParameters &parameters;
    /** Null for a master body. */
    const ObstacleParameters *obstacle;
    const Solid              &solid;
    const Forest             &forest;
    /** Number of the pair. */
    unsigned int number = 0;
    /** Numbers of the bodies; no master body with an obstacle. */
    unsigned int slave_body = 0, master_body = dealii::numbers::invalid_unsigned_int;
    /** Young's modulus E of the softer body, for the scale E A / h of contact forces per gap. */
    double modulus = 1.;
    /** Time at which an initial overlap that grows ("ramp") has reached its full size. */
    double end_time = 1.;
    /** Time at the end of the run. */
    double run_end = 1.;
    /** Edges and vertices that touch between nodes get rows of their own. */
    bool edges = true;
    /** In explicit dynamics. */
    bool in_cycles = false;
    /** There are other pairs. */
    bool one_of_several = false;
  };

  /**
   * @brief A contact pair: its surfaces, its pairing, and its rows.
   *
   * It applies small sliding and the treatment of initial overlaps. Only the pair and its pairing
   * write the rows.
   */
  class ContactPair : public Stateful
  {
  public:
    /** @throws InputError for boundaries that do not exist, and surfaces without faces.
     * Collective. */
    explicit ContactPair(const ContactPairInput &input);

    const std::vector<ContactRow> &
    rows() const
    {
      return present;
    }

    /** @brief The rows of the last committed state. */
    const std::vector<ContactRow> &
    committed_rows() const
    {
      return committed;
    }

    const ContactPairParameters &
    parameters() const
    {
      return input.parameters;
    }

    /** @brief Null for a master body. */
    const ObstacleParameters *
    obstacle() const
    {
      return input.obstacle;
    }

    const Surface &
    slave() const
    {
      return *slave_surface;
    }

    /** @brief Null for an obstacle. */
    const Surface *
    master() const
    {
      return master_surface.get();
    }

    Pairing &
    pairing() const
    {
      return *pairing_method;
    }

    unsigned int
    slave_body() const
    {
      return input.slave_body;
    }
    unsigned int
    master_body() const
    {
      return input.master_body;
    }

    bool
    tied() const
    {
      return is_tied;
    }

    /** @brief Rows are exact for linear displacements also where the surfaces are apart, by the
     * nodes behind the master faces (doc/theory.md 4.6). */
    bool
    carries_offset() const
    {
      return is_tied && master_surface && !offsets_stay;
    }

    /** @brief Leave offsets to themselves, before the first update: the nodes behind the master
     * faces depend on the slave nodes over other pairs. */
    void
    leave_offsets()
    {
      offsets_stay = true;
    }

    /** @brief Pairing of the reference state, kept for small sliding and tied. */
    bool
    small_sliding() const
    {
      return small;
    }

    /** @brief Initial overlap of row @p k that does not enter the gap, or not yet ("adjust",
     * "ramp"), <= 0; length. */
    double
    overlap(const std::size_t k) const
    {
      return overlaps[k];
    }

    /** @brief The part of overlap() that is taken out of the gap at @p time: 1 but for "ramp". */
    double
    part_of_overlap(double time) const;

    /** @brief What of the overlap that row @p k is placed with has entered its gap since the
     * committed state, of the time @p from: all of an interference in the first step, <= 0;
     * length. */
    double
    entered_overlap(std::size_t k, double from) const;

    /** @brief Along which the sides of the pair are drawn together; null without pretension. */
    PlaneCut *
    cut() const
    {
      return plane_cut.get();
    }

    /** @brief Young's modulus of the softer body, force per area. */
    double
    modulus() const
    {
      return input.modulus;
    }

    /** @brief What nodes pass through counts from the displacement of the last update() on. Done by
     * commit(), too. */
    void
    commit_positions();

    /** @brief A step begins, see Pairing::begin_step(). */
    void
    begin_step()
    {
      pairing_method->begin_step();
    }

    /** @brief See Pairing::leave_edges(). Rows of small sliding keep what they have. */
    bool
    leave_edges()
    {
      return !small && pairing_method->leave_edges();
    }

    /** @brief Material points inside slave faces get rows where the master or an obstacle enters
     * between nodes (doc/theory.md 4.2). */
    bool
    takes_points() const
    {
      return points_meet;
    }

    /** @brief The material points that have rows, the same on all ranks. */
    const std::vector<MaterialPoint> &
    points() const
    {
      return point_rows->points();
    }

    /** @brief Those of the last committed state. */
    const std::vector<MaterialPoint> &
    committed_points() const
    {
      return points_before;
    }

    /** @brief Let these points have rows from the next update() on, on all ranks, where
     * takes_points(). */
    void
    set_points(const std::vector<MaterialPoint> &points)
    {
      point_rows->set(points);
    }

    /** @brief Give the rows their numbers among all of this rank, from @p first_index on. */
    void
    number_rows(std::size_t first_index);

    /** @brief Point the rows to their friction, by row index; null without. */
    void
    set_friction(const std::function<const FrictionRow *(std::size_t)> &friction);

    /** Normals of the planes of symmetry that nodes lie on. */
    using Mirrors = std::map<Index, std::vector<dealii::Tensor<1, dim>>>;

    /** @brief Choose those planes that are planes of symmetry of the pair, see SharedSymmetry. Its
     * surfaces average their normals with what lies beyond.
     * @param of_nodes All that nodes of cells of this rank and their neighbours lie on, also
     * hanging ones. Collective. */
    void
    set_planes_of_symmetry(const Mirrors &of_nodes);

    /** @brief Normals of the planes of symmetry of the pair that nodes of faces of this rank lie
     * on. Other planes support a body as rollers do. */
    const Mirrors &
    planes_of_symmetry() const
    {
      return planes;
    }

    /** @brief The constants of the friction of each row. */
    std::vector<FrictionRow>
    friction_rows(const ContactParameters &contact) const;

    /**
     * @brief Update the rows to a displacement. Collective.
     *
     * @param u       Displacement of owned dofs.
     * @param ghosted The same with the ghosts of the surfaces; must live until commit() or the
     *                next update.
     * @param active  Whether a row is active at present.
     * @throws InputError in the first update, if the surfaces do not face each other.
     */
    void
    update(const Vector                                  &u,
           const Vector                                  &ghosted,
           double                                         time,
           const std::function<bool(const ContactRow &)> &active);

    /** @brief Update again where other pairs cover what this one does not, from what all have found
     * in their update; see cover_by_other_pairs(). Collective.
     * @param u     Of the update. @param part With ghosts; null: nowhere.
     * @param first The update was the first one. */
    void
    complete_cover(const Vector &u, const Vector *part, bool first);

    /** @brief Let slave nodes have no rows where the others of their faces can take their part, see
     * junction_nodes(), and begin again with the next update. Pointwise rows stay.
     * @param nodes The same on all ranks. */
    void
    remove_rows(const std::set<Index> &nodes);

    /** @brief The pairing of a committed state is that of the displacement that has been set, and
     * remembers what an earlier one remembered of it. */
    void
    remember(const PairingMemory &memory);

    /** @brief Rows of the displacement that has been set, as if no node left its row to others and
     * none had been in contact; without obstacles. The rows of this pair stay as they are.
     * Collective.
     * @param u The displacement, of owned dofs. */
    std::vector<ContactRow>
    rows_of_all_nodes(const Vector &u);

    /** @brief Set the derivatives of the active rows in the displacement of the
     * last update(), for the consistent linearisation. Collective. */
    void
    differentiate(const std::function<bool(const ContactRow &)> &active);

    /** @brief Move the surfaces to a displacement with ghosts; update() does so, too.
     * Collective. */
    void
    move_surfaces(const Vector &ghosted);

    unsigned int
    n_searches() const
    {
      return searches;
    }

    void
    commit() override;
    void
    rollback() override;
    void
    save(ArchiveWriter &archive) const override;

    /** @brief Comes after an update in the reference state, and set_displacement(). */
    void
    load(const ArchiveReader &archive) override;

    /** @brief The surfaces are at the displacement @p ghosted, see update(), at a time. */
    void
    set_displacement(const Vector &ghosted, const double t)
    {
      displacement = &ghosted;
      time         = t;
    }

  private:
    const ContactPairInput input;
    const bool             is_tied, small;
    /** There are rows for edges and vertices that touch between nodes, and for points inside slave
     * faces. */
    bool                       edges_meet = false, points_meet = false;
    std::unique_ptr<Surface>   slave_surface, master_surface;
    std::shared_ptr<Pairing>   pairing_method;
    std::unique_ptr<PointRows> point_rows;
    std::unique_ptr<PlaneCut>  plane_cut;
    std::vector<ContactRow>    present, committed;
    std::vector<MaterialPoint> points_before;
    Mirrors                    planes;
    /** Small sliding: the rows of the reference state, and the displacement with the ghosts that
     * their stencils need. */
    struct ReferenceRows
    {
      std::vector<ContactRow> rows;
      Vector                  stencil_values;
    };
    ReferenceRows reference;
    /** The same as if no node left its row to others; made when it is asked for. */
    std::optional<ReferenceRows> reference_of_all;
    /** Nodes that have no rows, and the reach of the pairing that the others have. */
    std::set<Index>     without_rows;
    double              search_distance = 0.;
    std::vector<double> overlaps;
    const Vector       *displacement = nullptr;
    double              time         = 0.;
    unsigned int        searches     = 0;
    bool                started      = false;
    /** See leave_offsets(). */
    bool offsets_stay = false;

    std::unique_ptr<Surface>
    make_surface(unsigned int                    body,
                 const std::vector<std::string> &boundaries,
                 const std::string              &key) const;
    std::shared_ptr<Pairing>
    make_pairing(double search_distance) const;
    PairingInput
    pairing_input(double search_distance) const;
    /** Null without pretension. @throws InputError if it is not plane. */
    std::unique_ptr<PlaneCut>
    make_cut() const;
    bool
    find_points() const;
    bool
    find_edges() const;
    void
    search(const Vector &u);
    /** After the first search: make a deeper one if the bodies overlap more than it
     * reaches. @throws InputError if the surfaces do not face each other. */
    void
    check_start(const Vector &u);
    void
    make_reference();
    /** A vector with the ghosts that the stencils of rows need. Collective. */
    Vector
    with_stencils(const std::vector<ContactRow> &rows) const;
    /** Set gaps of rows of the reference state in a displacement of owned dofs. */
    void
    set_gaps(std::vector<ContactRow> &rows, ReferenceRows &from, const Vector &u) const;
    void
    apply_overlap();
    void
    save_points(ArchiveWriter &archive) const;
    void
    load_points(const ArchiveReader &archive);
  };
} // namespace Touchstone

#endif
