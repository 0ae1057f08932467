#ifndef touchstone_contact_contact_h
#define touchstone_contact_contact_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/ghost_import.h>
#include <touchstone/contact/pairing/pairing.h>
#include <touchstone/contact/results.h>
#include <touchstone/scene/scene.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace Touchstone
{
  class ArchiveReader;
  class ArchiveWriter;

  /** @brief A velocity that contact leaves no room for. */
  struct PressingNode
  {
    /** Of the node and what it touches, with the velocity that they should have,
     * length per time. */
    Condition condition;
    /** Along the normal, not across it. */
    bool normal;
    /** Number of the pair, and of the row in it. */
    unsigned int pair;
    std::size_t  row;
    /** What was taken to make it so, force times time. */
    double impulse = 0.;
  };

  /**
   * @brief All contact pairs of a scene: their surfaces, their rows, the active
   * set, and the one place where contact history is committed or rolled back.
   */
  class Contact
  {
  public:
    /** Normals of the planes of symmetry that nodes lie on. */
    using Mirrors = std::map<Index, std::vector<dealii::Tensor<1, dim>>>;

    /** @param mirrors Of owned nodes, by node.
     * @throws InputError for boundaries that do not exist, surfaces without
     * faces, and pairs whose roles form a circle. */
    Contact(const Scene   &scene,
            const Forest  &forest,
            const Solid   &solid,
            const Mirrors &mirrors = Mirrors());

    /** @brief Rows of this rank, pair after pair. */
    std::vector<std::vector<ContactRow>> rows;

    /** @brief Make the rows describe the displacement @p u (owned unknowns). */
    void
    update(const Vector &u, double time);

    /** @brief Set the derivatives of the active rows in the displacement of the
     * last update(), for the consistent linearisation. */
    void
    differentiate();

    /**
     * @brief Find the rows whose friction would not be unique while they stick.
     *
     * Against an obstacle only the slave node can move. Where @p supports or other active
     * rows determine its tangential displacement, any force within the cone is in
     * equilibrium, and how it is divided would depend on the enforcement and the path of
     * the iteration. There the elastic slip determines it, doc/theory.md 6.1.
     */
    void
    find_shared_nodes(const ConstraintGraph &supports);

    /** @brief What an update of the active set did, over all ranks. */
    struct ActiveSetUpdate
    {
      unsigned int active  = 0;
      unsigned int changes = 0;
      /** Identifies the set, to notice that it comes back. */
      std::uint64_t signature = 0;
      /** Largest |gap| of active and penetration of open rows, relative to the
       * size of the faces. */
      double gap = 0.;
    };

    /**
     * @brief Decide which rows are active: lambda - c g > 0.
     *
     * @param caution 0 changes every row that asks for it, 1 only those that ask
     *                most strongly, more only one: this breaks cycles.
     */
    ActiveSetUpdate
    update_active_set(double gap_tolerance, unsigned int caution);

    /** Part of a contact force. */
    enum class Part
    {
      all,
      normal,
      tangential
    };

    /** @brief Add the contact forces M^T f of all rows, or a part of them, to @p force. */
    void
    add_forces(Vector &force, Part part = Part::all) const;

    /** @brief Work of a part of the contact forces on the motion that obstacles made
     * since the committed state, force times length: the bodies get it from outside.
     * Collective. */
    double
    work_of_obstacles(Part part) const;

    /** @brief The part of the motion since the committed state after which the first
     * open row closes; 1 if none does. Collective. */
    double
    part_to_touch() const;

    /** @brief The relative velocities that are left no room where nodes press, in a step
     * of length @p step: along normals, and across them where nodes stick. None that
     * @p supports decide. */
    std::vector<PressingNode>
    pressing(const ConstraintGraph &supports, double step) const;

    /** @brief Results of the step are to show the impulses, which acts during @p step. */
    void
    add_jumps(const std::vector<PressingNode> &pressing, double step);

    /**
     * @brief Take out rows that depend on each other in a circle.
     *
     * The slave nodes of a row move with its master nodes, and these, if they are slaves
     * of other active rows, with further ones. Where that leads back to a row, those
     * of the later pair are dropped: what they ask for is what the earlier rows
     * see to, up to the mesh size. Kept, they would make multipliers dependent, could not
     * be eliminated, and would let the surfaces fit together only as far as both
     * meshes represent the same functions. Collective.
     * @param graph     The prescribed displacements: rows that these meet lead nowhere.
     * @param threshold Components of a unit normal that are smaller make no circle.
     */
    void
    drop_circles(const ConstraintGraph &graph, double threshold);

    /** @brief Keep the state of the rows: the step has converged. */
    void
    commit();

    /** @brief Go back to the last committed state: the step is repeated. */
    void
    rollback();

    /** Number of fields of a pair in fields(). */
    static constexpr unsigned int n_fields = 3;

    /**
     * @brief What a change of the mesh carries over, as fields over the unknowns:
     * per pair the contact traction; whether a node is active, sticks, and nothing;
     * slip length and work against friction per area, and nothing.
     *
     * Densities, and not forces of nodes, so that they can be interpolated: a new
     * node takes its share by its own area.
     * @param of_committed Of the last committed state instead of the present one.
     */
    std::vector<Vector>
    fields(bool of_committed) const;

    /**
     * @brief Take state and forces of the rows from fields of the same kind over
     * new unknowns, in the displacement of the last update().
     * @param history Take slip and work, too, and let this be the committed state:
     *                a step begins here.
     */
    void
    adopt(const std::vector<Vector> &fields, bool history);

    /** @brief Put the committed state into a checkpoint. Collective. */
    void
    save(ArchiveWriter &archive) const;

    /** @brief Go on from save(), with the committed displacement @p u (owned unknowns) at
     * time @p t. The rows have been made by an update() in the reference state.
     * Collective. @throws ArchiveError */
    void
    load(const ArchiveReader &archive, const Vector &u, double t);

    /** @brief Boundaries of the slave and of the master surface of each pair, by
     * body; empty for an obstacle. */
    struct PairBoundaries
    {
      unsigned int                         slave_body, master_body;
      std::set<dealii::types::boundary_id> slave, master;
    };
    std::vector<PairBoundaries>
    boundaries() const;

    /** @brief Results at this rank's slave nodes in displacement @p u. */
    std::vector<ContactPoint>
    points(const Vector &u) const;

    /** @brief Slave faces of this rank, for pictures. */
    std::vector<ContactFace>
    faces() const;

    /** @brief Sums per pair over all ranks. */
    std::vector<PairResult>
    results(const Vector &u) const;

    unsigned int
    n_searches() const
    {
      return searches;
    }

    /** @brief Contact work of this rank, in counts that do not depend on the machine. */
    struct Work
    {
      std::uint64_t slave_rows = 0, master_faces = 0;
      SearchWork    search;
    };
    Work
    work() const;

    /** @brief Contact in the state of the last update() that rows of slave nodes and master faces
     * cannot describe, in words; empty if there is none. Collective. */
    std::string
    unresolved() const;

    /** @brief Text on gaps and overlaps as the bodies are placed, a line per pair. */
    std::vector<std::string>
    start_report() const;

  private:
    struct Pair
    {
      const ContactPairParameters *parameters;
      std::unique_ptr<Surface>     slave, master;
      std::shared_ptr<Pairing>     pairing;
      unsigned int                 slave_body = 0, master_body = 0;
      /** Stiffness scale: Young's modulus of the softer body. */
      double modulus = 1.;
      bool   tied    = false;
      /** Pairing of the reference state, kept for small sliding and tied. */
      bool                    small = false;
      std::vector<ContactRow> reference;
      /** Initial overlaps that do not count, or not yet; of each row. */
      std::vector<double> overlap;
      /** With friction: two material vectors of the surface at each slave node, see
       * Surface::material_tangents(). */
      std::vector<std::array<Stencil, 2>> tangents;
    };

    const Solid                         &solid;
    const Scene                         &scene;
    std::vector<Pair>                    pairs;
    std::vector<std::vector<ContactRow>> committed;
    /** Displacement with the ghosts that the surfaces need. */
    Vector                     ghosted;
    std::optional<GhostImport> import_ghosts;
    /** The same for the stencils of reference pairings. */
    Vector stencil_values;
    /** With friction: positions of all nodes in the reference state (owned), and
     * at present for those that stencils and anchors refer to. */
    Vector reference_positions, owned_positions, positions;
    /** The same when the step began. */
    Vector           owned_start_positions, start_positions;
    dealii::IndexSet positions_known;
    unsigned int     searches = 0;
    bool             started  = false;
    double           time = 0., committed_time = 0.;
    const double     end_time;

    /** See unresolved(), for one pair. */
    std::string
    unresolved(unsigned int pair) const;
    /** A place of a row in an order that does not depend on the partition. */
    std::vector<double>
    order(const ContactRow &row) const;
    /** The first row, over all ranks, that asks to change its state. */
    std::vector<double>
    first_in_order(const std::function<double(const ContactRow &)> &demand) const;
    /** After the first search of a pair: make a deeper one if the bodies overlap more than it
     * reaches. @throws InputError if the surfaces do not face each other. */
    void
    check_start(Pair &pair, std::vector<ContactRow> &pair_rows, const Vector &u, double time);
    void
    make_reference(Pair &pair, std::vector<ContactRow> &pair_rows, double time);
    void
    update_small(Pair &pair, std::vector<ContactRow> &pair_rows, const Vector &u);
    /** Slip of the rows with friction. */
    void
    update_slip(const Vector &u);
    /** A direction in the plane of the row's normal that turns with the surface of the slave
     * body, whichever directions its mesh has. @param tangents See Surface::material_tangents(). */
    dealii::Tensor<1, dim>
    in_plane_rotation(const ContactRow &row, const std::array<Stencil, 2> &tangents) const;
    /** Position of a node that positions knows. */
    dealii::Tensor<1, dim>
    position(Index node) const;
    /** A step begins with the present positions. */
    void
    start_step();
    /** Displacement of a node that positions knows, since the step began. */
    dealii::Tensor<1, dim>
    displacement_of_step(Index node) const;
    /** Displacement of a slave node relative to the material points of the master
     * surface that it faces now, since the step began. */
    dealii::Tensor<1, dim>
    relative_displacement(const ContactRow &row) const;
    /** Way of a slave node from its anchor. */
    dealii::Tensor<1, dim>
    way_from_anchor(const ContactRow &row) const;
    /** The present place of contact is where slip counts from. */
    void
    set_anchor(ContactRow &row) const;
    void
    set_slip_gradient(ContactRow &row, const std::array<Stencil, 2> &tangents) const;
    void
    commit_friction(ContactRow &row) const;
    /** Pairs whose rows can depend on each other in a circle, in their order. */
    std::vector<unsigned int> circular;
    void
    find_circles();
  };
} // namespace Touchstone

#endif
