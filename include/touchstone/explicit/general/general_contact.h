// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_general_contact_h
#define touchstone_explicit_general_general_contact_h

#include <touchstone/base/exact_sum.h>
#include <touchstone/explicit/general/general_contact_parameters.h>
#include <touchstone/explicit/general/general_results.h>
#include <touchstone/explicit/general/last_impulses.h>
#include <touchstone/explicit/general/mirror_planes.h>
#include <touchstone/explicit/general/travel_limits.h>
#include <touchstone/explicit/impulse_solver.h>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Everything touches everything, in explicit dynamics: the rows that keep surfaces from
   * crossing each other, wherever they meet (doc/general_contact.md).
   *
   * In each cycle there are rows for nodes that touch a face and for edges that pressed in the
   * cycle before, and those that the crossing check asks for: straight motion of all nodes through
   * the cycle, nodes against faces and edges against edges. Nothing is kept from one interval to
   * the next; within an interval only what starts the sweeps, which edges pressed, and which nodes
   * did so lately.
   */
  class GeneralContact
  {
  public:
    /** @param nodes Must live as long, as @p parameters must. */
    GeneralContact(const GeneralContactParameters &parameters,
                   const ImpactSurfaceInput       &input,
                   const Solid                    &solid,
                   const NodeMap                  &nodes);

    /** @brief No surface crosses another with the displacement @p u. Collective.
     * @throws InputError with the places where one does. */
    void
    check_start(const NodeField &u, const std::vector<std::string> &bodies);

    /** @brief At how many faces, and where, surfaces cross with the displacement @p u; empty if
     * nowhere. What it has found for the present interval is forgotten. Collective.
     * @param inwards By so much of the size of faces surfaces are moved inwards. */
    std::string
    crossings_at(const NodeField &u, double inwards, const std::vector<std::string> &bodies);

    /** @brief MirrorPlanes::passed(). Collective. */
    std::string
    passed_symmetry(const NodeField &u, double part, const std::vector<std::string> &bodies) const
    {
      return mirror_planes.passed(u, part, bodies);
    }

    /** @brief A row that is closed too far: a node within another body, or two edges that have
     * passed each other. */
    struct Overlap
    {
      RowKey key;
      /** Of the slave side and, negative, of the master side, by first dofs of nodes; and the
       * direction from the latter to the former. */
      unsigned int           n = 0;
      std::array<Index, 8>   dofs{};
      std::array<double, 8>  weights{};
      dealii::Tensor<1, dim> normal;
      /** Length. */
      double depth = 0.;
    };

    /** @brief Overlaps of up to a quarter of a face with the displacement @p u, of all ranks and in
     * the order of their keys: for each node that of the face that it is nearest to; and where
     * no node is so deep that surfaces cross, those of edges. What it has found for the present
     * interval is forgotten. Collective. */
    std::vector<Overlap>
    overlaps(const NodeField &u);

    /** @brief The state is a committed one: forget what the interval before has left. */
    void
    begin_interval();

    /**
     * @brief A cycle begins at the displacement @p u with the free velocities @p v: find candidates
     * if motion demands it, and the rows of what touches and of what would cross. Collective.
     * @param v_before,step_before Velocities and length of the cycle before; length 0: there was
     *                             none. @param only_touching Without what would cross.
     * @param reach Impulses may move nodes by so many times of what they may at first.
     */
    void
    begin_cycle(const NodeField &u,
                const NodeField &v_before,
                double           step_before,
                const NodeField &v,
                double           step,
                bool             only_touching = false,
                double           reach         = 1.);

    /** @brief What a look at the motion to the end of a cycle has found. */
    enum class Crossings
    {
      /** Nothing crosses. */
      none,
      /** Rows of the present cycle have been added. */
      rows,
      /** Nodes move so far that there may be other candidates. */
      too_far,
      /** What crosses has rows that are open as far as they may be, as in the rounds before. */
      in_vain
    };

    /** @brief Look whether surfaces cross with the velocities @p v, and add the rows that prevent
     * it. Collective. @param round Of this cycle, from 1: in late ones rows of all kinds come at
     * once. */
    Crossings
    find_crossings(const NodeField &u, const NodeField &v, double step, unsigned int round);

    /** @name Rows in the solver, which are its last ones */
    /** @{ */
    /** @brief Rows have come that are not in the solver. The same on all ranks. */
    bool
    must_lay_out() const
    {
      return new_rows;
    }
    /** @brief Add the rows and their slots. */
    void
    lay_out(std::vector<ImpulseRow> &to, std::vector<std::pair<Index, RowKey>> &slots);
    /** @brief Set the geometry of the cycle and add the rows that take part to ImpulseSolver::near.
     * @param first Row of the solver. @param x,v_before Positions and velocities of the cycle
     *              before by node of the solver. */
    void
    set_geometry(ImpulseSolver                             &solver,
                 std::size_t                                first,
                 const std::vector<dealii::Tensor<1, dim>> &x,
                 const std::vector<dealii::Tensor<1, dim>> &v_before,
                 double                                     step);
    /** @brief Add up what came of the cycle. @param given Energies given along normals. */
    void
    keep_results(const ImpulseSolver                       &solver,
                 std::size_t                                first,
                 const std::vector<dealii::Tensor<1, dim>> &v_before,
                 ExactSum                                  &given);
    /** @brief The interval is over: results() are those of it. Collective. @param length Time. */
    void
    end_interval(double length);
    const GeneralResults &
    results() const
    {
      return outcome;
    }
    /** @brief What there is to say when find_crossings() finds some in the shortest of cycles.
     * Collective. */
    std::string
    failure(double time) const;
    /** @brief There were no impulses in the last cycle. */
    void
    forget()
    {
      impulses.forget();
    }
    /** @} */

    /** @brief Energies since begin_interval(), of this rank, as in ImpulseEnergy. */
    struct Energy
    {
      ExactSum normal, friction, obstacles;
    };
    const Energy &
    energy() const
    {
      return energies;
    }
    const CandidateCounts &
    counts() const
    {
      return candidates.counts();
    }
    /** @brief Whether there is anything to look at, on any rank. */
    bool
    any() const
    {
      return candidates.any();
    }

    /** @copydoc MovingSurface::inset */
    static constexpr double inset = MovingSurface::inset;

  private:
    using Row        = SurfaceRow;
    using NodeMotion = MovingSurface::NodeMotion;
    using TwoEdges   = MovingSurface::TwoEdges;

    static constexpr double tie = MovingSurface::tie;
    /** Relative to the size of faces, a gap that is closed. */
    static constexpr double touching = 4. * inset;
    /** Relative to the size of faces: surfaces that are moved inwards and are farther apart than
     * this do not touch, nor cross, while their nodes do not move. Each of both is moved by no more
     * than an inset, in whatever direction, when it is looked at and later. */
    static constexpr double reserve = 1.2 * (touching + 4. * inset);

    /** A node over one of the four triangles of a face. */
    struct Hit
    {
      unsigned int           face = dealii::numbers::invalid_unsigned_int, triangle = 0;
      std::array<double, 3>  weights{};
      dealii::Tensor<1, dim> normal, middle;
      double                 gap = 0., opposed = 0.;
      /** Number of the candidate. */
      unsigned int pair = 0;
    };

    const GeneralContactParameters &parameters;
    const NodeMap                  &nodes;
    ImpactSurface                   surface;
    MirrorPlanes                    mirror_planes;
    ContactCandidates               candidates;
    /** Its faces in the present cycle. */
    MovingSurface              moving;
    LastImpulses               impulses;
    std::optional<FrictionRow> friction;
    /** Size of the smallest faces, length; and the part of it that the margin has at least. */
    double                  smallest     = 0.;
    static constexpr double least_margin = 0.05;
    /** Candidates hold as long as nodes have moved relative to each other by less than the margin
     * since they stood here. The present cycle may move them by its part of it. */
    NodeField made_at;
    double    margin = 0., most_in_cycle = 0.;
    bool      renew = true;
    /** What is known of a candidate from earlier looks: that nothing of it crosses or touches
     * before nodes have #travelled so far, length, and the direction that told its points apart, in
     * the TurningFrame of the first of the pair of faces that it belongs to, if one did. */
    struct Separation
    {
      double                 until = -std::numeric_limits<double>::max();
      dealii::Tensor<1, dim> direction;
      bool                   known = false;
      /** It is not worth to look for a direction in so many further looks; and in so many with
       * free velocities. */
      std::array<unsigned int, 2> hopeless{};
    };
    /** By pair of faces, by pair of a node and a face, and of edges. */
    std::vector<Separation> apart_faces, apart_nodes, apart_edges;
    /** Inner edges of a pair of faces, once they have been looked at: each two of them, and up to
     * where all of them stay apart. */
    struct InnerSeparations
    {
      std::vector<Separation> each;
      double                  until = -std::numeric_limits<double>::max();
    };
    std::vector<InnerSeparations> apart_inner;
    /** By pair of faces: up to where all that belongs to it stays apart. */
    TravelLimits face_limits;
    /** By pair of a node and a face: it has a row as it touches. */
    std::vector<bool> touches;
    /** Bounds of how far any two nodes have moved relative to each other in all cycles so far, and
     * of the motion to be checked; length. */
    double travelled = 0., travels = 0.;
    /** Pairs of faces whose nodes may come together in the present motion. */
    std::vector<unsigned int> near_pairs;
    std::vector<Row>          rows;
    /** Rows by key. */
    std::unordered_map<RowKey, std::size_t, OfRowKey, OfRowKey> numbers;
    bool                                                        new_rows = false;
    Energy                                                      energies;
    GeneralResults                                              outcome;
    /** By row, since the candidates were made. */
    std::vector<GeneralResults::RowTotal> totals;
    void
    keep_totals();

    /** Motion of nodes relative to each other, of all ranks: by axis, and the largest of these, and
     * a bound of the distances; length. Infinite if a motion is not finite. */
    struct Range
    {
      std::array<double, dim> along;
      double                  largest, distance;
    };
    /** @param motion Of an owned node. Collective. */
    template <class Motion>
    Range
    range(const Motion &motion) const;
    /** Whether candidates hold through the cycle at the beginning of which it stands like this,
     * after what nodes have @p moved since the cycle before began. Collective. */
    bool
    candidates_hold(const NodeField &u, const Range &moved);
    /** Bounds of what they have moved since the candidates were made, by axis, length. */
    std::array<double, dim> since_made{};
    void
    renew_candidates(const NodeField &u, const NodeField &v, double step, double in_cycle);
    /** Nothing is known of new candidates. */
    void
    begin_candidates();
    /** Which pairs of faces have nodes that may come together before they have moved by #travels:
     * sets #near_pairs, and adds their faces and nodes to those of the cycle. */
    void
    find_near();
    /** What crosses, in the order in which rows are added. */
    enum class Kind
    {
      slave_node,
      node,
      edges,
      /** Edges from corners of warped faces to their middle, and the middle. */
      inner
    };
    /** Crossings of the last check, with the rows that prevent them. */
    std::vector<Row> found;
    /** Checks of the cycle, one after the other up to now, that found nothing but rows that were
     * fully open. */
    unsigned int checks_in_vain = 0;

    /** Surfaces as they stand with the displacement @p u and, for the check of crossings, moved
     * inwards by a part of the size of their faces: sets the candidates within a distance @p reach
     * of each other, and what is known of their nodes. */
    void
    look_at(const NodeField &u, double inwards, double reach);
    /** Edges that pass through faces there, those that hang on the cell of the face apart: calls
     * @p found with the face of the edge, its corner, and the other face. */
    void
    for_each_crossing(
      const std::function<void(unsigned int, unsigned int, unsigned int)> &found) const;
    /** Of an edge that passes through a face the overlap with the edge of that face, or line from
     * a corner to its middle, that is nearest; nothing if none is near. */
    std::optional<Row>
    passed_edge(const SurfacePoint &begin, const SurfacePoint &end, unsigned int face) const;

    /** By node of the slots: it has got a new row in the present check. */
    std::vector<char> waiting;
    /** Of what was found from #found[@p first] on take out what has no row yet and waits for rows
     * of earlier kinds; later kinds wait for what is left. The same on any number of ranks.
     * Collective. */
    void
    leave_to_earlier_kinds(std::size_t first);
    /** The row takes part in the cycle, as it is or instead of the one of its key. */
    void
    use(const Row &row);
    /** The row of the key of what crosses if that takes part already, or null. */
    const Row *
    taking_part(const RowKey &key) const;
    /** Row::more of a row for what crosses. */
    double
    opens_more(const Row &row) const;

    /** Rows of what touches at the start. */
    void
    find_touching_nodes();
    void
    find_touching_edges();
    /** Whether the node of a pair of a node and a face is the slave: it does not change. */
    bool
                              is_slave(unsigned int pair) const;
    mutable std::vector<char> slave_of_pair;
    /** Where the node of a pair is over the face, or under it, whatever the gap. */
    std::optional<Hit>
    over_face(unsigned int pair) const;
    void
    add_hit(unsigned int pair, std::vector<Hit> &hits) const;
    bool
    stand_together(const Hit &one, const Hit &other, std::size_t node) const;

    /** Two faces that may come together in the present cycle: number of the pair, size of the
     * larger one, length, and the frame of the first. */
    struct OpenFaces
    {
      unsigned int        pair;
      double              size;
      const TurningFrame &frame;
    };
    std::vector<OpenFaces> open_faces;
    /** The motion that is checked is that of free velocities. */
    bool looks_ahead = false;

    /** Check the motion through the cycle that #moving knows: #new_rows is the same on all
     * ranks then. @param ahead With free velocities: only nodes of the finer side that do not
     * touch. @param in_order Rows of a kind come only where no earlier kind brings new ones, that
     * is at other nodes. @return rows if some have been added or changed, on any rank. Collective.
     */
    Crossings
    check_motion(bool ahead, bool in_order);
    /** Its parts: pairs of faces that no direction tells apart; what belongs to one, which is added
     * to #found, and how long that stays apart; a node and a face, two edges, inner edges. */
    void
    find_open_faces();
    /** A pair of a node and a face is looked at with free velocities; and one of a pair of faces is
     * that may come together in them. */
    bool
    counts_ahead(unsigned int pair) const;
    bool
    may_ask_ahead(unsigned int pair) const;
    void
    check_faces(const OpenFaces &faces, Kind kind);
    void
    keep_until(const OpenFaces &faces);
    /** @tparam Groups PointGroups, or what has its functions. */
    template <class Groups>
    bool
    stay_apart(const Groups       &groups,
               const TurningFrame &frame,
               double              size,
               unsigned int        patience,
               Separation         &known) const;
    void
    check_node(const SurfacePoint &node,
               unsigned int        face,
               const OpenFaces    &faces,
               Separation         &known);
    void
    keep_out(const SurfacePoint &node,
             unsigned int        face,
             unsigned int        triangle,
             const Crossing     &crossing);
    void
    check_edges(const TwoEdges  &ends,
                const OpenFaces &faces,
                Separation      &known,
                std::size_t      pair = std::numeric_limits<std::size_t>::max());
    void
    check_inner_edges(const ContactCandidates::FacePair &pair, const OpenFaces &faces);
    /** What is known of inner edges that have not been looked at. */
    std::vector<Separation>
    separations_of_inner_edges(const ContactCandidates::FacePair &pair) const;
    dealii::Tensor<1, dim>
    edge_normal(const TwoEdges               &ends,
                const dealii::Tensor<1, dim> &e,
                const dealii::Tensor<1, dim> &f,
                const dealii::Tensor<1, dim> &closing) const;
  };
} // namespace Touchstone

#endif
