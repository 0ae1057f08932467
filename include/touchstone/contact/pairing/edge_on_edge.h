// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_edge_on_edge_h
#define touchstone_contact_pairing_edge_on_edge_h

#include <touchstone/contact/geometry/edge_crossing.h>
#include <touchstone/contact/geometry/surface.h>
#include <touchstone/contact/row.h>
#include <touchstone/contact/search/search.h>

#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

namespace Touchstone
{
  /**
   * @brief A slave node on a sharp edge that stands on a sharp edge of the master which is about
   * parallel to it (doc/theory.md 4.2, "Parallel edges").
   *
   * The closest point tells nothing of the direction of the contact force there: it lies within
   * round-off of the edge, beyond which the normal jumps by up to the angle of the edge. The force
   * must be normal to both surfaces, so the normal of the row is the middle of the directions that
   * are normal to both edges.
   */
  class EdgeOnEdge
  {
  public:
    /** Derivatives of averaged normals by face, of Search::normal_derivatives(). */
    using OfNormals = std::unordered_map<const Face *, std::vector<NormalDerivative>>;

    /** @brief Whether faces meet at a node of the slave surface, owned by this rank, with an angle
     * between their normals as on sharp edges, now or in the reference state. */
    static bool
    at_sharp_edge(const Surface &slave, Index node);

    /** @brief How far from an edge a node may be. */
    struct Reach
    {
      /** Of the faces of the node, length. */
      double size = 0.;
      /** How far beyond the end of an edge, as a part of it. */
      double edge_tolerance = 0.;
      /** The node stays on the edge that it stood on, wherever an iterate has carried it. */
      bool stays = false;
    };

    /** @brief The edge that a slave node stands on or is about to, in the last update of the
     * search.
     * @param node Of the slave surface, owned by this rank. */
    static std::optional<EdgeOnEdge>
    find(const Surface    &slave,
         const Search     &search,
         const SlavePoint &point,
         Index             node,
         const Reach      &reach);

    /** @brief Whether the node lies on the edge within tolerances, or in front of it along the
     * normal. */
    bool
    stands() const;

    /** @brief Set stencil, normal, gap vector and gap; the stencil is empty before. */
    void
    set(ContactRow &row) const;

    /** @brief Add the master faces whose averaged normals the row depends on. */
    void
    add_faces(std::vector<const Face *> &faces) const;

    /** @brief Set the derivative of what set() has set. */
    void
    differentiate(const Surface &slave, const OfNormals &of_normals, ContactRow &row) const;

  private:
    /** One of the two normals whose middle is that of the row: of a face at its node or between the
     * two nodes of an edge. */
    struct Side
    {
      const Face                 *face;
      std::array<unsigned int, 2> corners;
      /** Of the slave surface, against which it points: -1, else 1. */
      double                 sign;
      dealii::Tensor<1, dim> normal;
    };

    /** The master edge, from node 0 to node 1, and the fraction at which the node stands. */
    std::array<Index, 2>   nodes;
    dealii::Tensor<1, dim> edge;
    /** One of the faces that meet in it. */
    const Face *edge_face = nullptr;
    double      along     = 0.;
    /** It can move along the edge. */
    bool free = true;
    /** How far it is beyond the end of the edge, as a part of it. */
    double beyond = 0.;
    /** The edges touch each other and not a face the edge. */
    bool                   touch = true;
    Reach                  reach;
    dealii::Tensor<1, dim> distance, normal;
    std::array<Side, 2>    sides;

    static EdgeOnEdge
    on_edge(const SharpEdge &own, const SharpEdge &other, Index node, const dealii::Point<dim> &x);
    /** Distance from the line of the edge across the normal, length. */
    double
    beside() const
    {
      return (distance - (distance * normal) * normal).norm();
    }
    /** Whether a node lies on the line of the edge but for tolerances, along the normal in front of
     * it or where it has come to since the step began, or stays there.
     * @param start Of the node in the step. */
    bool
    holds(const dealii::Point<dim> &start, bool swept) const;
    dealii::Tensor<1, dim>
    sum_of_normals(const Side &side) const;
  };
} // namespace Touchstone

#endif
