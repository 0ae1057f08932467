#ifndef touchstone_contact_search_search_h
#define touchstone_contact_search_search_h

#include <touchstone/contact/geometry/surface.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace Touchstone
{
  /** @brief A slave node that looks for a partner. */
  struct SlavePoint
  {
    /** Present position, and at the start of the step. */
    dealii::Point<dim> x, start;
    /** Outward normal of the slave surface there: faces that look the same way are
     * on the far side of a body. */
    dealii::Tensor<1, dim> normal;
    /** A node in contact slides off an edge only five times as far beyond it as one
     * that is not comes on, or it would go on and off for ever. */
    bool in_contact = false;
    /** Key of the face that a node in contact had last. */
    std::optional<std::uint64_t> present_face;
  };

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
  };

  /** @brief What searches came to so far, on this rank. */
  struct SearchWork
  {
    /** Faces that a point was projected on or a way crossed with, or that stood near a
     * slave face. */
    std::uint64_t candidates = 0;
    /** Other ranks that master faces were sent to, and those faces. */
    std::uint64_t messages = 0, faces_sent = 0;

    SearchWork &
    operator+=(const SearchWork &other)
    {
      candidates += other.candidates;
      messages += other.messages;
      faces_sent += other.faces_sent;
      return *this;
    }
  };

  /**
   * @brief Finds the master point closest to a slave node, on whatever rank the
   * face lives.
   *
   * Global search: each rank receives the master faces that meet the bounding box
   * of its slave nodes, and keeps their boxes in an R-tree. Local search:
   * closest-point projection on the faces in the order of the distance of their
   * boxes, until no box is closer than the best point found.
   */
  class Search
  {
  public:
    /**
     * @param reach     Farthest distance at which a partner is looked for, length.
     * @param tolerance How far beyond an edge of the master surface a node still
     *                  finds it, as a fraction of the face.
     * @param kind      What gaps are measured to.
     */
    Search(const Surface &master,
           double         reach,
           double         tolerance,
           MasterNormal   kind,
           MPI_Comm       communicator);

    /** @brief A step ends with the displacement @p u (with ghosts), null for the
     * reference state. Without any call nodes that pass through faces within a step
     * are not looked for. */
    void
    commit(const Vector *u);

    /** @brief Exchange the master faces in their present position.
     * @param positions Of this rank's slave nodes, present ones and, if steps are
     *                  committed, those at the start of the step. */
    void
    update(const std::vector<dealii::Point<dim>> &positions);

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

    /** @brief What gaps to a face are measured to. */
    FaceGeometry
    geometry(const Face &face) const;

    /** @brief Derivatives of the averaged normals of faces of this search, from the
     * ranks that own them. Empty if normals come from the faces alone. Collective. */
    std::unordered_map<const Face *, std::vector<NormalDerivative>>
    normal_derivatives(const std::vector<const Face *> &needed) const;

    /** @brief The master faces within reach of a box that look the other way than
     * @p slave_normal, in the order of their keys. Not those that are seen edge-on:
     * their shadows on the slave surface are slivers. */
    std::vector<const Face *>
    near(const dealii::BoundingBox<dim> &box, const dealii::Tensor<1, dim> &slave_normal) const;

    /** @brief Numbers for faces of this search, the same for those of @p some that hang
     * together over common nodes. */
    std::vector<unsigned int>
    layers(const std::vector<const Face *> &some) const;

    /** @brief The face where a point has gone into a body since the start of the step
     * and not come out, or a neighbour of it that is closest to where the point is
     * now; null if there is none. */
    const Face *
    entry(const SlavePoint &point) const;

    /** @brief The face closest to a point that is reached from @p from over
     * neighbours. */
    const Face *
    follow(const SlavePoint &point, const Face &from) const
    {
      return walk(point, from).face;
    }

    /** @brief The face with this key, null if this rank has not received it. */
    const Face *
    face(std::uint64_t key) const;

    /** @brief The same, of a face that was at @p place in known_faces() at an earlier
     * update and is so still if nothing else was received. */
    const Face *
    face(std::uint64_t key, std::size_t place) const
    {
      return place < faces.size() && faces[place].key == key ? &faces[place] : face(key);
    }

    /** @brief Where a face is in known_faces(). */
    std::size_t
    place(const Face &face) const
    {
      return &face - faces.data();
    }

    /** @brief Faces of the last update: of this rank, and near its slave nodes. */
    const std::vector<Face> &
    known_faces() const
    {
      return faces;
    }

    /** @brief Counted since this search was made. */
    const SearchWork &
    work() const
    {
      return counted;
    }

  private:
    using Box  = dealii::BoundingBox<dim>;
    using Tree = dealii::RTree<std::pair<Box, std::size_t>>;
    /** Of the nodes of a face. */
    using Displacements = std::array<dealii::Tensor<1, dim>, Face::max_nodes>;

    const Surface     &master;
    const double       reach, tolerance;
    const MasterNormal kind;
    const MPI_Comm     communicator;
    std::vector<Face>  faces;
    /** What is asked of many faces to leave most of them out. */
    struct Outline
    {
      dealii::Tensor<1, dim> normal; // in the middle
      dealii::Point<dim>     centre; // of a sphere around the face
      double                 radius;
    };
    /** Of the faces of the last update. */
    struct Located
    {
      std::vector<Outline> outlines;
      /** Of the faces where they are, and of all places where they were in this step. */
      Tree tree, swept_tree;
    };
    /** Made when first asked for: who knows which faces are near needs none. */
    mutable std::optional<Located> located_now;
    const Located &
    located() const;

    /** For layers(), made when first asked for: small numbers of the nodes of `faces`, and at
     * each node the first of the faces at hand. */
    mutable std::vector<std::array<unsigned int, Face::max_nodes>> node_numbers;
    mutable std::vector<unsigned int>                              first_at_node;

    /** Places in `faces`, filled when a face is first asked for. */
    mutable std::unordered_map<std::uint64_t, std::size_t> by_key;

    mutable SearchWork counted;

    /** Displacements of this rank's faces at the start of the step. */
    std::vector<Displacements> committed;
    bool                       swept = false;

    /** Numbers of this rank's faces that each rank has received, and where its own
     * copies of those of another rank begin. */
    std::map<unsigned int, std::vector<std::size_t>> sent;
    std::map<unsigned int, std::size_t>              received;

    Box
    bounding_box(const Face &face, const Displacements &displacement) const;
    /** The present and the committed place. */
    Box
    swept_box(const Face &face) const;

    /** Whether the point may meet the face on its way, both moving. */
    bool
    may_cross(const SlavePoint &point, const Face &face) const;

    /** A face with the point of it that is closest to a node. */
    struct Candidate
    {
      const Face *face = nullptr;
      Projection  projection;
    };

    /** The closest face within reach, or the present one if that is as close. */
    Candidate
    closest(const SlavePoint &point) const;
    /** The closest point that is reached from a face over its neighbours. */
    Candidate
    walk(const SlavePoint &point, const Face &from) const;
    /** Where a node has passed into a body since the start of the step, unless it
     * came out again. @param penetrates It is known to be in one body. */
    std::optional<Candidate>
    passed(const SlavePoint &point, bool penetrates) const;
    ContactPartner
    partner(const SlavePoint &point, const Candidate &candidate) const;
  };
} // namespace Touchstone

#endif
