// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_missed_contact_h
#define touchstone_contact_missed_contact_h

#include <touchstone/contact/contact.h>
#include <touchstone/contact/geometry/sampled_face.h>
#include <touchstone/contact/pairing/material_point.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief Looks in a state of balance for places where the other surface of a pair lies within
   * slave faces none of whose nodes carries a force: contact that passes between the slave nodes.
   *
   * Other than UnresolvedContact, which ends a run where bodies overlap by so much that the result
   * cannot be right, it tells of any overlap that surfaces in contact do not have, also with small
   * sliding and where an initial overlap has been adjusted. See doc/theory.md 4.1.
   */
  class MissedContact
  {
  public:
    /** @brief Where the overlap is deepest. */
    struct Place
    {
      /** Zero if there is none; length. */
      double             depth = 0.;
      dealii::Point<dim> x;
      /** Of the slave face; length. */
      double size = 0.;
      /** Of all slave faces with an overlap that is more than facets may be off. */
      double area = 0.;
    };

    /** @brief The first of some places, with the area of all; without depth if there is none. */
    static Place
    first_of(const std::vector<Place> &places);

    /** @brief Which overlaps. */
    enum class Overlaps
    {
      /** Those that are to be none: without what is adjusted of initial ones. */
      that_count,
      /** Those of the bodies as they are placed. */
      as_placed,
      /** Those that are to be none between the points that face each other in the reference state.
       * Rows of small sliding keep these apart, however far the surfaces slide. */
      as_paired
    };

    /** @param forces Normal contact forces of the pair on its slave nodes, with the ghosts
     *                of the slave surface.
     * Collective. */
    MissedContact(const Contact     &contact,
                  const ContactPair &pair,
                  const Vector      &forces,
                  Overlaps           which = Overlaps::that_count);

    /** @brief Whether no node of the pair carries a force. Collective. */
    bool
    carries_nothing() const;

    /** @brief The deepest overlap, the same on all ranks and any number of them. Collective. */
    Place
    deepest() const;

    /** @brief The deepest overlap, more than facets may be off, of each slave face that carries a
     * force at a node; the same on all ranks. Collective. */
    std::vector<Place>
    beside_nodes() const;

    /** @brief Part of the area that should carry the pair of which the overlaps of @p place are: 1
     * where nothing carries. Collective. */
    double
    share(const Place &place) const;

    /** @brief The share from which on the rest says nothing of the force. */
    static constexpr double most_share = 0.4;

    /** @brief Whether the overlap is so deep that the state cannot be right. */
    static bool
    deep(const Place &place);

    /** @brief Where rows of material points are wanted, the deepest first: a point in each face of
     * an overlap, the same on all ranks and any number of them.
     * Collective. */
    std::vector<MaterialPoint>
    points() const;

  private:
    const Contact     &contact;
    const ContactPair &pair;
    const Vector      &forces;
    /** The part of an overlap in the reference state that does not count now. */
    const double part_adjusted;
    /** Overlaps::as_paired. */
    const bool by_reference;
    /** The largest initial overlap of a row that does not count now; length. */
    double adjusted = 0.;

    /** A point of one surface within the other. */
    struct Overlap
    {
      Place place;
      /** Body that it lies in, and the point moved to where it is between straight edges. */
      unsigned int       body = 0;
      dealii::Point<dim> inside;
      /** Of the face that it lies behind, or the obstacle. */
      dealii::Tensor<1, dim> normal;
      /** Whether it must be looked for there: a point of the surface is part of the body. */
      bool in_doubt = true;
      /** An overlap at the start has been taken out of it. */
      bool adjusted = false;
      /** Where it is deepest on the slave face. */
      MaterialPoint deepest{};
      /** In the middle of what is deepest, on the slave face. */
      MaterialPoint point{};
      /** Where that is. */
      dealii::Point<dim> at_point{};
      /** Where it has been looked for, and how deep it is behind the face there. */
      dealii::Point<dim> found_at{};
      double             behind = 0.;
    };
    /** A point of a slave face that lies within the other surface. */
    struct Sample
    {
      MeasuredFace::Xi xi;
      double           depth;
    };

    bool
    carries_nothing(const Face &face) const;
    /** A face where overlaps are looked for: in its present position, also with small sliding,
     * whose surfaces are not moved. Overlaps::as_paired: in the reference state, and the step, from
     * Face::committed on, is what has happened since. */
    Face
    placed(const Face &face) const;
    /** Of the bodies where overlaps are looked for, with ghosts. Collective. */
    Vector
    searched_displacement() const;
    /** In the slave faces of any rank that are idle, or in the others; the deepest first.
     * Collective. */
    std::vector<Overlap>
    overlaps(bool idle) const;
    /** In idle faces, but for those where the row of a point knows that there is none. Collective.
     */
    std::vector<Overlap>
    missed() const;
    /** Points whose row says that nothing touches there. Collective. */
    std::vector<MaterialPoint>
    open_points() const;
    /** Master faces of any rank that are near the boxes of faces of this rank. Collective. */
    std::vector<Face>
    master_faces(const std::vector<Face> &slaves) const;
    /** The deepest overlap of each idle face with the master. Collective. */
    std::vector<Overlap>
    within_faces(const std::vector<Face> &slaves, const std::vector<Face> &masters) const;
    /** Take the deepest point of one face within another, if it is deeper than @p worst, and add
     * all of them to @p samples. */
    void
    add_points(const SampledFace   &of,
               const SampledFace   &in,
               const Face          &slave,
               Overlap             &worst,
               std::vector<Sample> &samples) const;
    /** The middle of the samples that are as deep as the deepest. */
    static MeasuredFace::Xi
    middle(const std::vector<Sample> &samples);
    /** Coordinates in steps that the tolerances of solvers do not reach: the points of a scene are
     * the same with any of them. */
    static MeasuredFace::Xi
    rounded(MeasuredFace::Xi xi);
    /** The deepest point of an obstacle in each idle face, and behind it. Collective. */
    std::vector<Overlap>
    obstacle_within(const std::vector<Face> &slaves) const;
    /** Where an obstacle is deepest on a slave face near @p xi, by Newton's method. */
    MeasuredFace::Xi
    descend(const MeasuredFace &slave, MeasuredFace::Xi xi) const;
    /** Where an obstacle is deepest on a slave face; in the middle of places that are as deep.
     * @param start Where to begin, if it is within
     * no point that is tried. */
    MeasuredFace::Xi
    deepest_in(const MeasuredFace &slave, const MeasuredFace::Xi &start) const;
    /** Which of those that this rank has found lie within the cells of the bodies. Collective. */
    std::vector<bool>
    lie_within_bodies(const std::vector<Overlap> &found) const;
    /** Of the points within the surface of @p body only those count that have come through the face
     * which they are behind. Collective. @param inside Changed for the others. */
    void
    remove_entered_elsewhere(const std::vector<Overlap> &found,
                             unsigned int                body,
                             std::vector<bool>          &inside) const;
    /** Those of all ranks. Collective. */
    std::vector<Overlap>
    deepest_first(const std::vector<Overlap> &found) const;
  };
} // namespace Touchstone

#endif
