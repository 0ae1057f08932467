// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_edge_on_edge_h
#define touchstone_contact_pairing_edge_on_edge_h

#include <touchstone/contact/geometry/edge_crossing.h>
#include <touchstone/contact/geometry/surface.h>
#include <touchstone/contact/pairing/beyond_edge.h>
#include <touchstone/contact/pairing/row_derivative.h>
#include <touchstone/contact/row.h>
#include <touchstone/contact/search/search.h>
#include <touchstone/contact/tolerances.h>

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
   *
   * Where the slave edge hangs over the end of the master edge it is this end that touches, between
   * the first node beyond it, whose row this is, and its neighbour.
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

    /** @brief How far from an edge a node may be, and what holds it. */
    struct Reach
    {
      /** Of the faces of the node, length. */
      double size = 0.;
      /** How far beyond the end of an edge, as a part of it. */
      double edge_tolerance = 0.;
      /** The node stays on the edge that it stood on, wherever an iterate has carried it. */
      bool stays = false;
      /** The bodies overlap at the edge as the run begins: what is behind it is not the other side
       * of a thin body. */
      bool overlaps = false;
      /** Where faces fit beside both edges, a node that was on the face when the step began is held
       * beyond its edge, too, as at the end of a surface: along the normal that its row has on the
       * face. */
      BeyondEdge beyond_edge = BeyondEdge::free;
      /** The node was in contact when the step began. */
      bool touched = false;
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

    /** @brief Whether it stands there and touches, or comes along the normal. What comes along a
     * face beside the edge, with a clearance, does neither. */
    bool
    may_stay() const;

    /** @brief Whether it is deeper behind the edge than bodies in balance fit within. */
    bool
    deep() const
    {
      return distance * normal <= -Tolerances::deep_edge * reach.size;
    }

    /** @brief Where it touches, on the slave edge and on the master edge. @param x Of the node. */
    std::array<dealii::Point<dim>, 2>
    feet(const dealii::Point<dim> &x) const
    {
      const dealii::Point<dim> of_slave = x - (1. - weight) * slave_edge;
      return {{of_slave, of_slave - distance}};
    }

    /** @brief Set stencil, normal, gap vector and gap, and share, lever and area where the end of
     * the master edge touches; the stencil is empty before, area and share are those of the node.
     */
    void
    set(ContactRow &row) const;

    /** @brief Add the master faces whose averaged normals the row depends on. */
    void
    add_faces(std::vector<const Face *> &faces) const;

    /** @brief Set the derivative of what set() has set. */
    void
    differentiate(const Surface &slave, const OfNormals &of_normals, ContactRow &row) const;

  private:
    /** One of the two normals whose middle is that of the row: of a face between the two nodes of
     * an edge. */
    struct Side
    {
      const Face                 *face;
      std::array<unsigned int, 2> corners;
      std::array<double, 2>       weights;
      /** Of the slave surface, against which it points: -1, else 1. */
      double                 sign;
      dealii::Tensor<1, dim> normal;

      dealii::Tensor<1, dim>
      sum_of_normals() const
      {
        return sign *
               (weights[0] * face->normals[corners[0]] + weights[1] * face->normals[corners[1]]);
      }
    };

    /** How the point of contact changes with the position of a node. */
    struct Motion
    {
      Index                  node;
      dealii::Tensor<2, dim> distance;
      /** Of the fraction `along` or, over the end, of `weight`; per length. */
      dealii::Tensor<1, dim> fraction;
    };

    /** The slave edge, from the other node to that of the row, and the weight of the latter where
     * it touches: one, unless the edge hangs over the end of the master edge. */
    Index                  slave = invalid_index, other = invalid_index;
    dealii::Tensor<1, dim> slave_edge;
    bool                   over_end = false;
    double                 weight   = 1.;
    /** The master edge, from node 0 to node 1, and the fraction at which it is touched. */
    std::array<Index, 2>   nodes;
    dealii::Tensor<1, dim> edge;
    double                 along = 0.;
    /** One of the faces that meet in it. */
    const Face *edge_face = nullptr;
    /** The point of contact can move along the master edge or, over its end, along the slave edge;
     * else how far it is beyond the end of that, as a part of it. */
    bool   free   = true;
    double beyond = 0.;
    /** From the point of the master edge to that of the slave edge. */
    dealii::Tensor<1, dim> distance;
    /** The edges are parallel and touch each other, and no face. */
    bool touch = true;
    /** They are parallel, and a face beside each fits on one beside the other: the direction from
     * the former to its edge, else zero, and how wide the face of the master is in it. */
    dealii::Tensor<1, dim> outward;
    double                 width = 0.;
    dealii::Tensor<1, dim> normal;
    std::array<Side, 2>    sides;
    Reach                  reach;

    EdgeOnEdge(const SharpEdge          &own,
               const SharpEdge          &master,
               Index                     node,
               const dealii::Point<dim> &x,
               const Reach              &reach);
    /** Set the point of contact on the master edge. @param x Of the node. */
    void
    set_point(const SharpEdge &master, const dealii::Point<dim> &x);
    /** Where that is an end of the edge, move it along the slave edge to there. */
    void
    set_point_over_end();
    bool
    fits() const
    {
      return outward.norm_square() > 0.;
    }
    /** Set the normal. */
    void
    set_normal(const SharpEdge &own, const SharpEdge &master);
    /** From the line of the master edge to the node when the step began, at @p start. */
    dealii::Tensor<1, dim>
    distance_at_start(const dealii::Point<dim> &start) const;
    /** Distance from the line of the edge across the normal, length. */
    double
    beside() const;
    /** Whether the node is just beyond the edge of the face that its own one fits on. */
    bool
    holds_beyond(const SlavePoint &point) const;
    /** Whether the node can have the row: it lies on the line of the edge but for tolerances, along
     * the normal in front of it or where it has come to since the step began, or stays there. */
    bool
    holds(const SlavePoint &point, bool swept) const;
    /** Whether it is a better choice than another one, apart from keys of the edges: 1, else -1, or
     * 0 if both are as good. */
    int
    better_than(const EdgeOnEdge &best, const dealii::Point<dim> &start) const;
    std::vector<Motion>
    motions() const;
  };
} // namespace Touchstone

#endif
