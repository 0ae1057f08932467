// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_surface_h
#define touchstone_contact_geometry_surface_h

#include <touchstone/algebra/stencil.h>
#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/contact/geometry/mirror_images.h>
#include <touchstone/contact/geometry/trace_basis.h>
#include <touchstone/solid/solid.h>

#include <set>
#include <unordered_map>
#include <vector>

namespace Touchstone
{
  /** @brief A node of a contact surface, owned by this rank. */
  struct SurfaceNode
  {
    Index              node;
    dealii::Point<dim> reference;
    /** Tributary area: integral of the node's shape function. */
    double area = 0.;
    /** Length of the adjacent faces (square root of the largest area). */
    double size = 0.;
  };

  /** @brief The area vector of a face at a node with the weight by which it and its images count in
   * a nodal normal. */
  struct NormalShare
  {
    const Face            *face;
    unsigned int           m;
    dealii::Tensor<2, dim> weight;
  };

  /**
   * @brief One side of a contact pair: the boundary faces of one body that carry
   * given boundary ids, as far as this rank sees them.
   *
   * Faces of owned and of ghost cells are kept, so areas and averaged normals of
   * the nodes of owned faces are complete without communication. A hanging node
   * has no row and no area of its own; both belong to the nodes that it follows. So
   * the owner of these also gets the faces with hanging nodes that are farther away.
   */
  class Surface
  {
  public:
    /**
     * @param exact Take positions and normals from the exact surfaces of the
     *              geometry where there are any, instead of from the facets.
     */
    Surface(const Solid                                &solid,
            const Forest                               &forest,
            unsigned int                                body,
            const std::set<dealii::types::boundary_id> &boundaries,
            bool                                        exact);

    /** @brief From now on nodal normals are those of the body with its other halves.
     * @param planes Unit normals of the planes of symmetry that nodes of faces of this rank lie on,
     * by node. Edges of faces on them are no ends of the surface for smoothing. */
    void
    set_planes_of_symmetry(const std::map<Index, std::vector<dealii::Tensor<1, dim>>> &planes);

    /** @brief The nodes of all faces of this rank, hanging ones and those of others as well,
     * without areas. The size is that of the largest face around, by its diagonals. */
    std::vector<SurfaceNode>
    all_nodes() const;

    /** @brief Move the surface to the displacement @p u (with ghosts) and average
     * its normals. */
    void
    move(const Vector &u);

    /** @brief Let nodes have no rows: on each face the others take their part, unless there are no
     * others. @param nodes Of any rank. */
    void
    set_without_rows(const std::set<Index> &nodes);

    /** @brief Nodes that this rank owns and that do not hang, in ascending order. */
    const std::vector<SurfaceNode> &
    owned_nodes() const
    {
      return nodes;
    }

    /** @brief Faces of owned cells. */
    const std::vector<Face> &
    owned_faces() const
    {
      return faces;
    }

    /** @brief Faces of ghost cells, and others whose hanging nodes follow nodes of
     * this rank. */
    const std::vector<Face> &
    neighbour_faces() const
    {
      return ghost_faces;
    }

    /** @brief The continuous basis of a face with hanging nodes, or null. */
    const TraceBasis *
    trace(const Face &face) const
    {
      const auto found = traces.find(face.key);
      return found != traces.end() ? &found->second : nullptr;
    }

    /** @brief Dofs of the faces that lie beyond the ghost cells. */
    const std::vector<Index> &
    far_unknowns() const
    {
      return far;
    }

    /** @brief Averaged unit outward normal at a node of an owned face or at an
     * owned node. */
    const dealii::Tensor<1, dim> &
    normal(Index node) const
    {
      return node_of_faces(node).normal;
    }

    /** @brief The faces of the surface around an owned node, each with the local index of the
     * node on that face. */
    std::vector<std::pair<const Face *, unsigned int>>
    faces_around(Index node) const
    {
      const auto &faces = node_of_faces(node).faces;
      return {faces.begin(), faces.end()};
    }

    /** @brief For each owned node two material vectors of the surface: weights of node positions,
     * times an area, whose sums are orthogonal and of the same length in the reference state and
     * move with the body. They are means over all faces around the node, weighted by area, so
     * that no face or direction of the mesh is preferred. With the normal, pointing into the
     * body, they are a right-handed frame. In the order of owned_nodes(). */
    std::vector<std::array<Stencil, 2>>
    material_tangents() const;

    /** @brief Faces, each with the coordinates of one point that they share. */
    using PointOnFaces = std::vector<std::pair<const Face *, std::array<double, 2>>>;

    /** @brief The same at any point. */
    std::array<Stencil, 2>
    material_tangents(const PointOnFaces &list) const;

    /** @brief Current position of an owned node. */
    dealii::Point<dim>
    position(const SurfaceNode &node, const Vector &u) const;

    /** @brief The exact surface of a face, or null. */
    const AnalyticSurface *
    exact_surface(const Face &face) const;

    /** @brief Whether faces may have exact surfaces. */
    bool
    has_exact_surfaces() const
    {
      return exact;
    }

    /** @brief How the averaged normals of an owned face change with the positions
     * of the nodes around it, in the present position. */
    std::vector<NormalDerivative>
    normal_derivative(const Face &face) const;

    /** @brief What lies beyond the planes of symmetry that an owned node is on. */
    const MirrorImages &
    images(Index node) const
    {
      return node_of_faces(node).images;
    }

    /** @brief Of which area vectors the averaged normal at an owned node is the mean. */
    std::vector<NormalShare>
    normal_shares(Index node) const;

    /** @brief The same of the averaged normal of an owned face at its node @p m, which leaves out
     * faces beyond sharp edges. */
    std::vector<NormalShare>
    normal_shares(const Face &face, unsigned int m) const;

    /** @brief How such a mean changes with the positions of nodes, in the present position: d n /
     * d x_a, per length, for each node a of its faces, once. */
    std::vector<std::pair<Index, dealii::Tensor<2, dim>>>
    normal_derivative(const std::vector<NormalShare> &shares) const;

    /** @brief The boundaries that it is made of. */
    const std::set<dealii::types::boundary_id> &
    boundaries() const
    {
      return ids;
    }

    /** @brief Longest diagonal of any face, over all ranks; length. */
    double
    largest_face() const
    {
      return diagonal;
    }

    /** @brief Shortest side of any face in the reference state, over all ranks; length. */
    double
    shortest_edge() const
    {
      return shortest;
    }

  private:
    const Forest                              &forest;
    const std::set<dealii::types::boundary_id> ids;
    const bool                                 exact;
    std::vector<Face>                          faces, ghost_faces;
    std::vector<SurfaceNode>                   nodes;
    std::vector<Index>                         far;
    double                                     diagonal = 0., shortest = 0.;

    /** By the keys of faces with hanging nodes. */
    std::unordered_map<std::uint64_t, TraceBasis> traces;

    /** An edge as a pair of its corner nodes, the smaller first. */
    using Edge = std::pair<Index, Index>;

    /** A node of the faces that this rank knows. */
    struct NodeOfFaces
    {
      Index node;
      /** Averaged over all faces. */
      dealii::Tensor<1, dim> normal;
      /** Faces around it, with its local index there, in the order in which their normals
       * are summed. */
      std::vector<std::pair<Face *, unsigned int>> faces;
      /** Their unit normals here in the reference state. */
      std::vector<dealii::Tensor<1, dim>> as_made;
      /** What is averaged with these beyond planes of symmetry. */
      MirrorImages images = {};
    };
    /** In ascending order of the nodes. */
    std::vector<NodeOfFaces> surface_nodes;
    /** Of one node, for average_normals(). */
    std::vector<dealii::Tensor<1, dim>> parts;
    std::vector<NormalsAtNode>          at_node;

    /** Faces around a node, each with the local index of the node there. */
    using CornersOfFaces = std::vector<std::pair<const Face *, unsigned int>>;

    /** Of all nodes of all faces in the reference state. */
    std::vector<std::array<dealii::Tensor<1, dim>, 2>> reference_tangents;

    /** An edge of a face that has a node in the middle, which smaller neighbours share, with its
     * two halves. */
    using SplitEdge = std::pair<Edge, std::array<Edge, 2>>;

    /** @throws ExcInternalError if no face of this rank has the node. */
    const NodeOfFaces &
    node_of_faces(Index node) const;
    /** Tangents of a face at a node in the present position. */
    std::array<dealii::Tensor<1, dim>, 2>
    tangents(const Face &face, unsigned int m) const;
    /** Normals of the face number @p i around a node. */
    static NormalsAtNode
    normals_at(const NodeOfFaces &node, std::size_t i);
    /** Set the normals of all faces in their present positions. */
    void
    set_normals();
    /** Set Face::made_normals. */
    void
    set_made_normals();
    /** @param node Its faces have their area vectors as normals, which are replaced. */
    void
    average_normals(NodeOfFaces &node);
    static std::array<Edge, 4>
    edges(const Face &face);
    /** Faces of owned and ghost cells with their TraceBasis. */
    std::vector<SplitEdge>
    collect_faces(const Solid &solid, unsigned int body);
    /** Set Face::outer_edges: edges that belong to one face only. */
    void
    mark_outer_edges(const std::vector<SplitEdge> &split_edges);
    /** Send owners of nodes the faces whose hanging nodes follow these. */
    void
    exchange_far_faces(const Solid &solid);
    /** Fill surface_nodes and reference_tangents. */
    void
    collect_nodes_of_faces();
    /** Fill nodes, with areas and sizes. */
    void
    collect_owned_nodes(const Solid &solid);
    /** Set the longest diagonal and the shortest side. Collective. */
    void
    measure_faces(MPI_Comm communicator);
  };
} // namespace Touchstone

#endif
