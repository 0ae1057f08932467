#ifndef touchstone_contact_surface_h
#define touchstone_contact_surface_h

#include <touchstone/contact/face_derivative.h>
#include <touchstone/contact/results.h>
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

  /**
   * @brief One side of a contact pair: the boundary faces of one body that carry
   * given boundary ids, as far as this rank sees them.
   *
   * Faces of owned and of ghost cells are kept, so areas and averaged normals of
   * the nodes of owned faces are complete without communication.
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

    /** @brief Move the surface to the displacement @p u (with ghosts) and average
     * its normals. */
    void
    move(const Vector &u);

    /** @brief Nodes that this rank owns, in ascending order. */
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

    /** @brief Faces of ghost cells. */
    const std::vector<Face> &
    neighbour_faces() const
    {
      return ghost_faces;
    }

    /** @brief Averaged unit outward normal at a node of an owned face or at an
     * owned node. */
    const dealii::Tensor<1, dim> &
    normal(Index node) const
    {
      return normals.at(node);
    }

    /** @brief For each owned node weights of node positions whose sum is a tangent
     * of the surface there; it moves with the body. In the order of owned_nodes(). */
    std::vector<Stencil>
    tangents() const;

    /** @brief Current position of an owned node. */
    dealii::Point<dim>
    position(const SurfaceNode &node, const Vector &u) const;

    /** @brief The exact surface of a face, or null. */
    const AnalyticSurface *
    exact_surface(const Face &face) const;

    /** @brief How the averaged normals of an owned face change with the positions
     * of the nodes around it, in the present position. */
    std::vector<NormalDerivative>
    normal_derivative(const Face &face) const;

    /** @brief Longest diagonal of any face, over all ranks; length. */
    double
    largest_face() const
    {
      return diagonal;
    }

  private:
    const Forest            &forest;
    const bool               exact;
    std::vector<Face>        faces, ghost_faces;
    std::vector<SurfaceNode> nodes;
    double                   diagonal = 0.;

    std::unordered_map<Index, dealii::Tensor<1, dim>> normals;

    /** Faces around a node, with its local number there, in the order in which
     * their normals are summed. Filled when derivatives are first asked for. */
    mutable std::unordered_map<Index, std::vector<std::pair<const Face *, unsigned int>>> around;

    void
    mark_outer_edges();
  };
} // namespace Touchstone

#endif
