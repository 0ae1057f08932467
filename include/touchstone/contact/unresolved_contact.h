// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_unresolved_contact_h
#define touchstone_contact_unresolved_contact_h

#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/contact_parameters.h>
#include <touchstone/contact/geometry/surface.h>

#include <deal.II/base/bounding_box.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Looks in a state of balance for contact that rows of slave nodes and master faces
   * cannot describe: edges that have passed through each other, vertices of the master within
   * slave faces whose nodes touch nothing, and forces that are not normal to the slave surface.
   *
   * The surfaces must have been moved to the state. See doc/theory.md, section 4.
   */
  class UnresolvedContact
  {
  public:
    /** @param u      Displacement, with ghosts.
     * @param forces  Normal contact forces of the pair on its slave nodes, with the ghosts
     *                of the slave surface.
     * @param mirrors Normals of the planes of symmetry of the pair that owned nodes lie on. */
    UnresolvedContact(const Solid                 &solid,
                      const ContactPairParameters &parameters,
                      const Surface               &slave,
                      const Surface               &master,
                      unsigned int                 slave_body,
                      unsigned int                 master_body,
                      const Vector                &u,
                      const Vector                &forces,
                      const ContactPair::Mirrors  &mirrors);

    /** @brief The deepest crossing of two edges, or else the deepest vertex of the master in a
     * slave face, in words; empty if there is none. The same on all ranks. Collective. */
    std::string
    overlap() const;

    /** @brief Where the largest force is that is not normal to the slave surface, in words;
     * empty if there is none. The same on all ranks. Collective. */
    std::string
    oblique_force() const;

  private:
    const Solid                 &solid;
    const ContactPairParameters &parameters;
    const Surface               &slave, &master;
    const unsigned int           slave_body, master_body;
    const Vector                &u, &forces;
    const ContactPair::Mirrors  &mirrors;

    /** A point of each body that has come to lie in the other. */
    struct Overlap
    {
      /** On the slave and on the master. */
      dealii::Point<dim> slave, master;
      double             depth;
    };
    /** The master faces around this rank's slave faces. Collective. */
    std::vector<Face>
    nearby_master_faces() const;
    /** Edges that cross. @param least_depth As a fraction of the shorter one; negative for
     * edges that only come close. */
    std::vector<Overlap>
    crossing_edges(const std::vector<Face> &master_faces, double least_depth) const;
    /** Nodes of the master within slave faces none of whose nodes carries a force. */
    std::vector<Overlap>
    hidden_vertices(const std::vector<Face> &master_faces) const;
    /** Add those of one master face @p other within one slave face. @param box Around the latter.
     */
    void
    add_nodes_within(const Face                     &face,
                     const dealii::BoundingBox<dim> &box,
                     const Face                     &other,
                     std::vector<Overlap>           &found) const;
    /** Of points of the master behind slave faces those that have come through these. Collective.
     */
    std::vector<Overlap>
    entering(const std::vector<Overlap> &found) const;
    /** What of the master may touch the slave surface. */
    enum class Feature
    {
      smooth,
      /** A sharp edge, a vertex, or the end of the surface. */
      sharp,
      /** Edges of both. */
      edges
    };
    /** Within a slave face of @p x. Collective. */
    Feature
    touching_at(const dealii::Point<dim> &x) const;
    /** The deepest of those that lie in the other body, from all ranks; depth zero if there
     * is none. */
    Overlap
    deepest(const std::vector<Overlap> &found, bool edges) const;
  };
} // namespace Touchstone

#endif
