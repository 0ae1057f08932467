// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact_checks.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/geometry/edge_crossing.h>
#include <touchstone/contact/overlapping_bodies.h>
#include <touchstone/contact/tolerances.h>
#include <touchstone/contact/unheld_edges.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>

// Sharp edges that have come to lie in the other body beside slave nodes that carry a force
// (doc/theory.md 4.1). Points between the nodes are looked at: the nodes themselves often lie on
// planes of symmetry or between two cells of the other body, where they are in neither.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A point of a sharp edge. */
    struct EdgePoint
    {
      Point<dim> now, reference;
      /** First degree of freedom of the nearest node. */
      Index dof;
      /** Of the edge; length. */
      double length;
      /** The contact surface ends in the edge. */
      bool at_end;
    };

    /** Whether the other half of a body goes on beyond an edge in which its surface ends. */
    bool
    is_mirrored(const SharpEdge &edge)
    {
      const Face &face = *edge.faces[0];
      const auto  a    = node_coordinates(face, face.number_of(edge.nodes[0])),
                 b     = node_coordinates(face, face.number_of(edge.nodes[1]));
      for (unsigned int k = 0; k < 2; ++k)
        if (a[k] == b[k])
          return (face.mirrored_edges >> (2 * k + (a[k] > 0. ? 1 : 0)) & 1u) != 0;
      return false;
    }

    /** The points of the sharp edges of a surface on this rank. */
    std::vector<EdgePoint>
    points_on_edges(const Contact &contact, const Surface &surface)
    {
      std::vector<const Face *> faces;
      for (const std::vector<Face> *const list :
           {&surface.owned_faces(), &surface.neighbour_faces()})
        for (const Face &face : *list)
          faces.push_back(&face);
      const Vector          &u = contact.ghosted_displacement();
      std::vector<EdgePoint> result;
      for (const SharpEdge &edge : sharp_edges(faces, Tolerances::sharp_edge_cosine))
        {
          const Face &face   = *edge.faces[0];
          const bool  at_end = edge.faces[1] == nullptr;
          if (at_end && is_mirrored(edge))
            continue;
          Point<dim> reference[2], now[2];
          for (unsigned int k = 0; k < 2; ++k)
            {
              now[k] = reference[k] = face.reference[face.number_of(edge.nodes[k])];
              for (unsigned int d = 0; d < dim; ++d)
                now[k][d] += u(dim * edge.nodes[k] + d);
            }
          for (const double at : {0.21, 0.5, 0.79})
            result.push_back({now[0] + at * (now[1] - now[0]),
                              reference[0] + at * (reference[1] - reference[0]),
                              dim * edge.nodes[at < 0.5 ? 0 : 1],
                              now[0].distance(now[1]),
                              at_end});
        }
      return result;
    }



    /** The largest height of the arcs over the facets of a surface, by its nodal normals; length.
     * Collective. */
    double
    height_of_arcs(const Contact &contact, const Surface &surface)
    {
      double result = 0.;
      for (const Face &face : surface.owned_faces())
        for (const auto &[a, b] : corners_of_edges(face))
          result = std::max(result,
                            0.125 * (face.normals[b] - face.normals[a]) *
                              (face.position(b) - face.position(a)));
      return Utilities::MPI::max(result, contact.communicator());
    }



    /** Of the points of the edges of both surfaces of a pair. */
    class EdgesInBodies
    {
    public:
      EdgesInBodies(const Contact &contact, const ContactPair &pair)
        : contact(contact)
        , bodies{pair.slave_body(), pair.master_body()}
      {
        points[pair.slave_body()]          = points_on_edges(contact, pair.slave());
        const std::vector<EdgePoint> added = points_on_edges(contact, *pair.master());
        std::vector<EdgePoint>      &list  = points[pair.master_body()];
        list.insert(list.end(), added.begin(), added.end());
        arcs = height_of_arcs(contact, pair.slave()) + height_of_arcs(contact, *pair.master());
      }

      /** By how much facets may overlap where the surfaces touch; length. */
      double
      overlap_of_facets() const
      {
        return arcs;
      }

      /** The deepest of either body in the other one, by the thickness of the cell more than
       * @p least. @param start In the reference state. */
      std::vector<BodyOverlap>
      find(const bool start, const double least) const
      {
        std::vector<PointOfBody> list;
        for (const auto &[body, on_edges] : points)
          for (const EdgePoint &point : on_edges)
            // A body that meets itself is not beside an edge of its own where its cells have it.
            list.push_back({body,
                            of_one_body() ? point.dof : invalid_index,
                            start ? point.reference : point.now});
        std::vector<BodyOverlap> result =
          points_in_bodies(contact,
                           start ? contact.with_ghosts(contact.solid_model().zero_vector())
                                 : contact.ghosted_displacement(),
                           bodies,
                           list,
                           least);
        result.erase(std::remove_if(result.begin(),
                                    result.end(),
                                    [this](const BodyOverlap &overlap) {
                                      return overlap.body == overlap.other && !of_one_body();
                                    }),
                     result.end());
        return result;
      }

      /** The length of the edge of an overlap. */
      double
      length(const BodyOverlap &overlap) const
      {
        double result = 0.;
        for (const EdgePoint &point : points.at(overlap.body))
          if (point.now.distance(overlap.x) == 0.)
            result = std::max(result, point.length);
        return Utilities::MPI::max(result, contact.communicator());
      }

      /** Whether the surface of a body ends in an edge beside an overlap. */
      bool
      ends_at(const unsigned int body, const BodyOverlap &overlap) const
      {
        // What has slid off an edge is about as far beside it as it is deep.
        const double                  near = 3. * overlap.depth;
        const std::vector<EdgePoint> &list = points.at(body);
        const bool result = std::any_of(list.begin(), list.end(), [&](const EdgePoint &point) {
          return point.at_end && point.now.distance(overlap.x) < near;
        });
        return Utilities::MPI::max(static_cast<int>(result), contact.communicator()) == 1;
      }

      /** Whether both surfaces are those of the same body. */
      bool
      of_one_body() const
      {
        return bodies.size() == 1;
      }

    private:
      const Contact                                 &contact;
      const std::set<unsigned int>                   bodies;
      std::map<unsigned int, std::vector<EdgePoint>> points;
      double                                         arcs;
    };



    std::string
    remedy(const bool slave_ends, const bool master_ends, const bool of_one_body)
    {
      std::string result = ", where rows of slave nodes do not hold it. ";
      if (slave_ends || master_ends)
        result += std::string("If edges touch there, name the faces on both sides of them in '") +
                  (slave_ends ? "Slave boundaries'" : "") +
                  (slave_ends && master_ends ? " and '" : "") +
                  (master_ends ? "Master boundaries'" : "") + ", else refine ";
      else
        result += "Refine ";
      return result + "the slave surface" +
             (of_one_body ? " or round the edges"
                          : ", exchange slave and master, or round the edges");
    }



    /** The deepest overlap that the scene does not have by itself; no depth if there is none.
     * @param left By springs; length. */
    BodyOverlap
    deepest(const EdgesInBodies &edges, const double left)
    {
      // What was half as deep at the start is as the scene has it: facets of tubes overlap more or
      // less as they slide along each other.
      constexpr double half = 0.5, least = Tolerances::deep_smooth_node;
      BodyOverlap      result;
      for (const BodyOverlap &overlap : edges.find(/*start=*/false, least))
        if (overlap.depth > result.depth &&
            overlap.depth >
              left + edges.overlap_of_facets() + Tolerances::deep_edge * edges.length(overlap))
          result = overlap;
      if (result.depth > 0.)
        for (const BodyOverlap &before : edges.find(/*start=*/true, half * least))
          if (before.depth >= half * result.depth)
            return BodyOverlap();
      return result;
    }
  } // namespace



  std::vector<std::string>
  unheld_edges(const Contact &contact)
  {
    const std::map<std::string, LeftPenetration> springs = left_penetration(contact);
    std::vector<std::string>                     result;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair = contact.pair(p);
        const std::string &name = pair.parameters().name;
        // With small sliding edges may be anywhere.
        if (pair.tied() || !pair.master() || pair.small_sliding())
          continue;
        const EdgesInBodies edges(contact, pair);
        const auto          left = springs.find(name);
        const BodyOverlap worst  = deepest(edges, left != springs.end() ? left->second.length : 0.);
        if (worst.depth > 0.)
          result.push_back("contact pair '" + name + "': an edge of " +
                           worst.place(contact.solid_model()) +
                           remedy(edges.ends_at(pair.slave_body(), worst),
                                  edges.ends_at(pair.master_body(), worst),
                                  edges.of_one_body()));
      }
    return result;
  }
} // namespace Touchstone
