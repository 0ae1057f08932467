// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_search_self_contact_h
#define touchstone_contact_search_self_contact_h

#include <touchstone/contact/geometry/face_geometry.h>
#include <touchstone/contact/geometry/surface.h>
#include <touchstone/contact/search/slave_point.h>

#include <array>
#include <set>

namespace Touchstone
{
  /**
   * @brief Which faces a node can meet that belong to its own body (doc/theory.md 4.4).
   *
   * Everything near a node on its own surface is close without touching: the faces around it, the
   * faces beyond an edge, the other side of a wall. What counts is closeness that the reference
   * state does not explain. Where both surfaces of the pair are the same, one of two points that
   * meet is the slave: which of them is decided by their reference positions alone, so that it
   * depends neither on numbers nor on ranks nor on the state.
   */
  class SelfContact
  {
  public:
    using Boundaries = std::set<dealii::types::boundary_id>;

    SelfContact(const Boundaries &slave, const Boundaries &master)
      : slave(slave)
      , master(master)
    {
    }

    /** @brief Whether a node of the slave surface is a node of the master, by the faces of the
     * slave surface around it. */
    bool
    is_master(const Surface &slave_surface, Index node) const;

    /** @brief Whether a node can meet a face at all: it is no node of the face. */
    bool
    may_meet(const SlavePoint &point, const Face &face) const;

    /** @brief Whether of a node and a point of a face, at @p xi, the node is the slave. */
    bool
    is_slave(const SlavePoint &point, const Face &face, const std::array<double, 2> &xi) const;

    /** @brief Whether a node can have passed through a face since the step began: it is the slave,
     * and not deeper than they have moved. */
    bool
    can_have_entered(const SlavePoint &point, const Face &face, const Projection &projection) const;

    /** @brief Whether a node meets a face at its closest point: it is the slave, the line between
     * them is about normal to the face, or lies over a sharp edge, and does not run through the
     * body. Elsewhere a face is the closest only since one that is closer is none that the node can
     * meet. */
    bool
    meets(const SlavePoint &point, const FaceGeometry &face, const Projection &projection) const;

    /**
     * @brief Whether a point behind a face of its own body lies there since that is how the body
     * is made, as a node on the other side of a wall does.
     * @param x, foot Reference positions of the point and of that on the face.
     * @param normal  Of the face, in the reference state.
     * @param depth   Of the point behind the face at present; length.
     */
    static bool
    through_body(const dealii::Point<dim>     &x,
                 const dealii::Point<dim>     &foot,
                 const dealii::Tensor<1, dim> &normal,
                 double                        depth);

    /**
     * @brief Whether a point behind a face of its own body lies there since both have been made to
     * overlap: it is closer than any other side of the body can be.
     * @param x, foot, normal As in through_body().
     * @param cosine          Of the angle between the normals of both surfaces at present.
     */
    static bool
    made_to_overlap(const dealii::Point<dim>     &x,
                    const dealii::Point<dim>     &foot,
                    const dealii::Tensor<1, dim> &normal,
                    const Face                   &face,
                    double                        cosine);

    /** @brief Whether two faces have a node in common. */
    static bool
    share_node(const Face &one, const Face &other);

    /** @brief An order of reference positions, which does not depend on numbers: of two points that
     * meet the first is the slave. */
    static bool
    comes_first(const dealii::Point<dim> &one, const dealii::Point<dim> &other);

  private:
    const Boundaries slave, master;
  };
} // namespace Touchstone

#endif
