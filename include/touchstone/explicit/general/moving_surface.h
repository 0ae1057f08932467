// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_moving_surface_h
#define touchstone_explicit_general_moving_surface_h

#include <touchstone/collision/first_crossing.h>
#include <touchstone/explicit/general/contact_candidates.h>
#include <touchstone/explicit/general/inset_history.h>
#include <touchstone/explicit/general/moving_faces.h>

#include <array>
#include <cstdint>
#include <vector>

namespace Touchstone
{
  /** @brief A point of a surface: a corner of a face by its slot, or the middle of the face. */
  struct SurfacePoint
  {
    std::size_t slot   = 0;
    bool        middle = false;
  };

  /**
   * @brief The faces of the candidates of general contact in a cycle: where their nodes are at its
   * start and how they move, and the same surface moved inwards, on which crossings are looked for
   * (doc/general_contact.md, sections 2 and 3).
   *
   * Only the faces and nodes that have been added to those of the cycle are known. All velocities
   * are those of the last import().
   */
  class MovingSurface
  {
  public:
    /** By this part of their size surfaces are moved inwards for the check of crossings: sides that
     * touch, or are flush with each other, do not cross, and what rows leave open, as faces turn
     * and nodes slide within a cycle, is no crossing (doc/general_contact.md, section 3). */
    static constexpr double inset = 1e-4;

    /** Relative to a face, an edge, a cycle: what is so near to their ends is within, and what
     * happens so nearly at once happens at once. Of what meets exactly on lines between faces or at
     * ends of edges nothing is left to round-off. */
    static constexpr double tie = 1e-6;

    /** @brief What is known of a node in a cycle. The normals are those at its start and at the
     * start of the cycle before. */
    struct NodeMotion
    {
      dealii::Tensor<1, dim> x, v, normal, normal_before;
      /** Length, as of ImpactSurface; the depth as the normals. */
      double size = 0., depth = 0., depth_before = 0.;
    };

    /** @brief The ends of an edge, or of two, of the slave first. */
    using Edge     = std::array<SurfacePoint, 2>;
    using TwoEdges = std::array<SurfacePoint, 4>;

    /** @param surface, nodes, candidates Must live as long. */
    MovingSurface(const ImpactSurface     &surface,
                  const NodeMap           &nodes,
                  const ContactCandidates &candidates);

    /** @name The cycle */
    /** @{ */
    /** @brief There are new candidates, of whose nodes and faces none belongs to the cycle. */
    void
    reinit();
    /** @brief Where surfaces that are moved inwards stood a cycle before. */
    InsetHistory insets;
    /** Length of the cycle, time. */
    double cycle = 0.;
    /** @brief The cycle has to do with no faces and nodes so far. */
    void
    clear();
    /** @brief It has to do with these. */
    void
    add_face(unsigned int face);
    void
    add_node(std::size_t slot);
    /** @brief Read positions and velocities of the nodes of the cycle. Collective. */
    void
    import(const NodeField &u, const NodeField &v);
    /** @brief Set the surface that is moved inwards, at the start and at the end of the cycle.
     * @param part Of the size of faces. */
    void
    set_inner_positions(double part = inset);
    /** @} */

    /** @name Points */
    /** @{ */
    SurfacePoint
    corner(const unsigned int face, const unsigned int a) const
    {
      return {4 * std::size_t(face) + a % 4, false};
    }
    SurfacePoint
    middle(const unsigned int face) const
    {
      return {4 * std::size_t(face), true};
    }
    /** @brief The same on any number of ranks. */
    std::uint64_t
    key(const SurfacePoint &point) const;
    std::uint64_t
    face_key(const unsigned int face) const
    {
      return candidates.faces[face].key;
    }
    const NodeMotion &
    at(const std::size_t slot) const
    {
      return motion[candidates.at_slots.node(slot)];
    }
    double
    size(const SurfacePoint &point) const
    {
      return at(point.slot).size;
    }
    /** @brief Of the four corners, if it is the middle of a face. */
    dealii::Tensor<1, dim>
    mean(const SurfacePoint &point, dealii::Tensor<1, dim> NodeMotion::*quantity) const;
    /** @brief Where it is on the surface that is moved inwards, at the start or end of the cycle.
     */
    dealii::Point<dim>
    inner_position(const SurfacePoint &point, const bool at_end) const
    {
      return point.middle ? (at_end ? middle_to : middle_from)[point.slot / 4]
                          : (at_end ? inner_to : inner_from)[candidates.at_slots.node(point.slot)];
    }
    /** @} */

    /** @name Edges and faces */
    /** @{ */
    /** @brief The ends of the edge of a slot, in ascending order of their keys; and of two. */
    Edge
    ends_of(std::size_t edge) const;
    TwoEdges
    ends_of(const ContactCandidates::EdgePair &pair) const;
    /** @brief Roughly the direction from the material of the master to that of the slave. */
    dealii::Tensor<1, dim>
    outward(const TwoEdges &ends) const;
    /** @brief Whether a node is the slave where it meets a face. */
    bool
    is_slave(std::size_t node, unsigned int face) const;
    /** @brief The ends of an edge on the surface that is moved inwards, a little longer, so that
     * edges that meet at their ends do so whatever round-off is. */
    std::array<dealii::Point<dim>, 2>
    inner_edge(const Edge &ends, bool at_end) const;
    /** @brief The corners there. */
    const MovingCorners &
    inner_corners(const unsigned int face) const
    {
      return corners[face];
    }
    /** @brief A node and a triangle of a face there, enlarged a little. */
    FourPoints
    node_and_triangle(const SurfacePoint &node,
                      unsigned int        face,
                      unsigned int        triangle,
                      bool                at_end) const;
    /** @brief Whether the middle of a face is off the plane of its corners there. */
    bool
    is_warped(unsigned int face) const;
    /** @} */

  private:
    const ImpactSurface     &surface;
    const NodeMap           &nodes;
    const ContactCandidates &candidates;
    /** Local numbers of the owned nodes of the candidates. */
    std::vector<unsigned int> local;
    /** By node of the candidates, at the start of the cycle. */
    std::vector<NodeMotion> motion;
    /** Faces and nodes that the present cycle has to do with so far, and whether they are. */
    std::vector<unsigned int> near_faces, near_nodes;
    std::vector<char>         face_is_near, node_is_near;
    /** Positions of nodes and of middles of faces on surfaces that are moved inwards, at the start
     * and at the end; of #near_faces. */
    std::vector<dealii::Point<dim>> inner_from, inner_to, middle_from, middle_to;
    /** The corners there by face. */
    std::vector<MovingCorners> corners;

    void
    import_node(unsigned int node, const NodeField &u, const NodeField &v);
  };
} // namespace Touchstone

#endif
