// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_search_search_h
#define touchstone_contact_search_search_h

#include <touchstone/contact/search/swept_search.h>

#include <optional>
#include <unordered_map>
#include <vector>

namespace Touchstone
{
  /** @brief The master point that a slave node faces. */
  struct ContactPartner
  {
    /** Points into the search that made it; valid until its next update. */
    const Face            *face = nullptr;
    std::array<double, 2>  xi{};
    dealii::Point<dim>     x;
    dealii::Tensor<1, dim> normal;
    /** 1 or -1 in the wedge over a sharp edge, where the normal is this times the
     * direction from the contact point; 0 elsewhere. */
    int wedge = 0;
    /** The same points on other faces that are as close up to round-off, in ascending order of
     * their keys: a node on an edge belongs to all faces that meet there. Empty in the wedge, and
     * without faces beyond a sharp edge. */
    std::vector<ContactPartner> others;
  };

  /** @brief The closest face of a point, and others that are as close up to round-off. */
  struct ClosestFaces
  {
    FaceProjection              best;
    std::vector<FaceProjection> equal;
  };

  /**
   * @brief Finds the master point closest to a slave node, on whatever rank the
   * face lives.
   *
   * FaceExchange brings the faces near this rank's slave nodes, FaceTree keeps their boxes in an
   * R-tree. Closest-point projection on the faces in the order of the distance of their
   * boxes, until no box is closer than the best point found; SweptSearch finds nodes that would be
   * lost because they have passed through a face (doc/theory.md 4, "Search" and "Passing
   * through").
   */
  class Search
  {
  public:
    /**
     * @param reach     Farthest distance at which a partner is looked for, length.
     * @param tolerance How far beyond an edge of the master surface a node still
     *                  finds it, as a fraction of the face.
     * @param kind      What gaps are measured to.
     * @param arch      How exact surfaces turn there.
     */
    Search(const Surface &master,
           double         reach,
           double         tolerance,
           MasterNormal   kind,
           MPI_Comm       communicator,
           Arch           arch = Arch::with_normals);

    /** @brief A step ends with the displacement @p u (with ghosts), null for the
     * reference state. Without any call nodes that pass through faces within a step
     * are not looked for. */
    void
    commit(const Vector *u)
    {
      received.commit(u);
    }

    /** @brief Exchange the master faces in their present position. Collective.
     * @param positions Of this rank's slave nodes, present ones and, if steps are
     *                  committed, those at the start of the step. */
    void
    update(const std::vector<dealii::Point<dim>> &positions);

    /** @brief Free the memory of the faces until the next update. */
    void
    forget()
    {
      drop_tree();
      received.forget();
    }

    /**
     * @brief The partner of a node.
     *
     * The closest face, unless the node is in contact with another that is as close,
     * within the tolerance of edges, across a sharp edge; or unless the node has
     * passed through a face since the start of the step and would be lost: then the
     * closest point around the face that it passed first.
     */
    std::optional<ContactPartner>
    find(const SlavePoint &point) const;

    /** @brief The distance of the node of the last find() from the closest face, at most the reach;
     * length. */
    double
    distance() const
    {
      return last_distance;
    }

    /** @brief The faces of the last update. */
    const FaceExchange &
    exchange() const
    {
      return received;
    }

    /** @brief The same faces in R-trees, built at the first call after an update: where candidates
     * are known from before no tree is needed. */
    const FaceTree &
    tree() const;

    /** @brief The search for faces that nodes have passed through, in tree(). */
    SweptSearch
    swept() const
    {
      return SweptSearch(tree(), reach);
    }

    /** @brief The master faces within reach of a box: FaceTree::facing(). */
    std::vector<const Face *>
    near(const dealii::BoundingBox<dim> &box, const dealii::Tensor<1, dim> &slave_normal) const
    {
      return tree().facing(box, slave_normal, reach);
    }

    /** @brief What gaps to a face are measured to. */
    FaceGeometry
    geometry(const Face &face) const
    {
      return received.geometry(face);
    }

    /** @brief FaceExchange::normal_derivatives(). Collective. */
    std::unordered_map<const Face *, std::vector<NormalDerivative>>
    normal_derivatives(const std::vector<const Face *> &needed) const
    {
      return received.normal_derivatives(needed);
    }

    /** @brief Faces of the last update: of this rank, and near its slave nodes. */
    const std::vector<Face> &
    known_faces() const
    {
      return received.faces();
    }

    /** @brief Counted since this search was made. */
    SearchWork
    work() const;

  private:
    const double reach, tolerance;
    FaceExchange received;
    /** Faces looked at with trees before the present one. */
    std::uint64_t candidates_before = 0;
    /** Of the last update, see tree(). */
    mutable std::optional<FaceTree> present_tree;
    /** See distance(). */
    mutable double last_distance = 0.;
    /** The boxes near a point; kept for its memory alone. */
    mutable std::vector<std::pair<double, std::size_t>> boxes;

    /** Before its faces move or go. */
    void
    drop_tree();
    /** The closest face within reach, or the present one if that is as close. */
    ClosestFaces
    closest(const SlavePoint &point) const;
    /** Whether to this node the master surface ends at the sharp edge on which its closest point
     * lies. */
    bool
    ends_at(const SlavePoint &point, const FaceProjection &candidate) const;
    /** The same by means of the present face, whether in contact or not: nothing if it is not known
     * here or too far away. */
    std::optional<ClosestFaces>
    closest_near_guess(const SlavePoint &point) const;
    ContactPartner
    partner(const SlavePoint &point, const FaceProjection &candidate) const;
  };
} // namespace Touchstone

#endif
