// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/base/near_ranks.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/geometry/deformed_cells.h>
#include <touchstone/contact/overlap_order.h>
#include <touchstone/contact/overlapping_bodies.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <set>
#include <tuple>

// Points of surfaces within cells to which they do not belong, of any body: what contact should
// have prevented, or would have, had a pair been there (doc/theory.md 4.1).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Box = BoundingBox<dim>;

    constexpr unsigned int n_corners = 8, n_faces = 6;

    /** A cell in its present position. */
    struct BodyCell
    {
      unsigned int                      body;
      std::array<Point<dim>, n_corners> corners;
      /** First dofs of the corners. */
      std::array<Index, n_corners> nodes;
      /** Whether a face is part of the surface of the body with what lies beyond its planes of
       * symmetry. */
      std::array<bool, n_faces> outer;
    };

    /** Whether a face lies on a plane of symmetry. */
    bool
    on_plane_of_symmetry(const BodyCell &cell, const unsigned int f, const Contact::Mirrors &planes)
    {
      std::array<Point<dim>, 4> p;
      for (unsigned int k = 0; k < 4; ++k)
        p[k] = cell.corners[GeometryInfo<dim>::face_to_cell_vertices(f, k)];
      const Tensor<1, dim> normal = cross_product_3d(p[3] - p[0], p[2] - p[1]);
      for (unsigned int k = 0; k < 4; ++k)
        {
          const auto found =
            planes.find(cell.nodes[GeometryInfo<dim>::face_to_cell_vertices(f, k)] / dim);
          if (found == planes.end() ||
              std::none_of(found->second.begin(), found->second.end(), [&](const auto &plane) {
                return std::abs(plane * normal) > Tolerances::same_normal_cosine * normal.norm();
              }))
            return false;
        }
      return true;
    }



    /** Call @p use with each cell of this rank: cells are made one at a time, as there may be many.
     */
    template <class Use>
    void
    for_each_cell(const Contact                &contact,
                  const Vector                 &u,
                  const std::set<unsigned int> &bodies,
                  const Use                    &use)
    {
      BodyCell one;
      for (const auto &cell : contact.solid_model().dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && bodies.count(cell->material_id()) > 0)
          {
            one.body    = cell->material_id();
            one.corners = deformed_vertices(cell, u);
            for (unsigned int v = 0; v < n_corners; ++v)
              one.nodes[v] = cell->vertex_dof_index(v, 0);
            for (unsigned int f = 0; f < n_faces; ++f)
              one.outer[f] =
                cell->at_boundary(f) && !on_plane_of_symmetry(one, f, contact.planes_of_symmetry());
            use(one);
          }
    }



    /** What this rank's cells have of the surfaces: nodes, and centres of faces, for all nodes of a
     * strip that is one face wide may lie on the sides of what it reaches into. */
    std::vector<PointOfBody>
    own_surfaces(const Contact &contact, const Vector &u, const std::set<unsigned int> &bodies)
    {
      const Solid             &solid = contact.solid_model();
      std::vector<PointOfBody> points;
      std::vector<bool>        done(solid.relevant.n_elements());
      for_each_cell(contact, u, bodies, [&](const BodyCell &cell) {
        for (unsigned int f = 0; f < n_faces; ++f)
          if (cell.outer[f])
            {
              Point<dim> centre;
              for (unsigned int k = 0; k < GeometryInfo<dim>::vertices_per_face; ++k)
                {
                  const unsigned int v = GeometryInfo<dim>::face_to_cell_vertices(f, k);
                  centre += 0.25 * cell.corners[v];
                  const auto number = solid.relevant.index_within_set(cell.nodes[v]);
                  if (!done[number])
                    points.push_back({cell.body, cell.nodes[v], cell.corners[v]});
                  done[number] = true;
                }
              points.push_back({cell.body, invalid_index, centre});
            }
      });
      return points;
    }



    /** How far a point lies behind the surface of the body in a cell, or behind the nearest face if
     * the cell has no part of the surface; zero for points outside, or not deep inside. */
    double
    depth_in(const BodyCell &cell, const Point<dim> &x, const double at_least)
    {
      double least = std::numeric_limits<double>::max(), least_outer = least;
      for (unsigned int f = 0; f < n_faces; ++f)
        {
          std::array<Point<dim>, 4> p;
          for (unsigned int k = 0; k < 4; ++k)
            p[k] = cell.corners[GeometryInfo<dim>::face_to_cell_vertices(f, k)];
          // The plane of a warped face, through its centre and along its diagonals.
          Tensor<1, dim> normal = cross_product_3d(p[3] - p[0], p[2] - p[1]);
          normal *= (f % 2 == 0 ? -1. : 1.) / normal.norm();
          const Point<dim> centre    = 0.25 * (p[0] + p[1] + p[2] + p[3]);
          double           thickness = 0.;
          for (const Point<dim> &corner : cell.corners)
            thickness = std::max(thickness, (centre - corner) * normal);
          const double depth = (centre - x) * normal;
          if (!(depth > (cell.outer[f] ? at_least : Tolerances::within_cell) * thickness))
            return 0.;
          least = std::min(least, depth);
          if (cell.outer[f])
            least_outer = std::min(least_outer, depth);
        }
      return least_outer < std::numeric_limits<double>::max() ? least_outer : least;
    }



    /** The points of all ranks that may lie in cells of this rank. */
    std::vector<PointOfBody>
    points_around(std::vector<PointOfBody>      own,
                  const Contact                &contact,
                  const Vector                 &u,
                  const std::set<unsigned int> &bodies)
    {
      const MPI_Comm communicator = contact.communicator();
      if (Utilities::MPI::n_mpi_processes(communicator) == 1)
        return own;
      std::vector<Box> boxes, at_points;
      for_each_cell(contact, u, bodies, [&](const BodyCell &cell) {
        boxes.push_back(box_of_cell(cell.corners));
      });
      for (const PointOfBody &point : own)
        at_points.push_back(Box({point.x, point.x}));
      std::map<unsigned int, std::vector<PointOfBody>> messages;
      const auto ranks = near_ranks(boxes, at_points, communicator);
      for (std::size_t k = 0; k < own.size(); ++k)
        for (const unsigned int rank : ranks[k])
          messages[rank].push_back(own[k]);
      std::vector<PointOfBody> result;
      for (const auto &[rank, points] : exchange_records(messages, communicator))
        result.insert(result.end(), points.begin(), points.end());
      return result;
    }



    /** Overlaps that the scene asks for. */
    class Intended
    {
      using Bodies = std::pair<unsigned int, unsigned int>;

    public:
      /** Collective. */
      Intended(const Contact &contact, const Vector &u)
      {
        for (unsigned int p = 0; p < contact.n_pairs(); ++p)
          if (const ContactPair &pair = contact.pair(p); pair.master() != nullptr)
            {
              const Bodies bodies = std::minmax(pair.slave_body(), pair.master_body());
              if (pair.parameters().initial_overlap != ContactPairParameters::Overlap::interference)
                left_out.insert(bodies);
              if (pair.cut() != nullptr)
                cuts.emplace_back(bodies, pair.cut()->taken_out(u));
            }
      }

      bool
      contains(const PointOfBody &point, const unsigned int other) const
      {
        const Bodies bodies = std::minmax(point.body, other);
        return left_out.count(bodies) > 0 ||
               std::any_of(cuts.begin(), cuts.end(), [&](const auto &cut) {
                 return cut.first == bodies && cut.second.contains(point.x);
               });
      }

    private:
      /** Overlap at the start that is adjusted or grows with time. */
      std::set<Bodies> left_out;
      /** Sides of a bolt that pretension has drawn into each other. */
      std::vector<std::pair<Bodies, PlaneCut::Layer>> cuts;
    };



    /** Points within cells of this rank. */
    std::vector<BodyOverlap>
    own_overlaps(const Contact                  &contact,
                 const Vector                   &u,
                 const std::set<unsigned int>   &bodies,
                 const std::vector<PointOfBody> &points,
                 const Intended                 &intended,
                 const double                    least)
    {
      std::vector<std::pair<Point<dim>, std::size_t>> places;
      for (std::size_t k = 0; k < points.size(); ++k)
        places.emplace_back(points[k].x, k);
      const auto               tree = pack_rtree(places);
      std::vector<BodyOverlap> result;
      for_each_cell(contact, u, bodies, [&](const BodyCell &cell) {
        for (const auto &entry :
             tree | boost::geometry::index::adaptors::queried(
                      boost::geometry::index::intersects(box_of_cell(cell.corners))))
          {
            const PointOfBody &point = points[entry.second];
            if (std::find(cell.nodes.begin(), cell.nodes.end(), point.node) != cell.nodes.end() ||
                intended.contains(point, cell.body))
              continue;
            if (const double depth = depth_in(cell, point.x, least); depth > 0.)
              result.push_back({point.body, cell.body, depth, point.x});
          }
      });
      return result;
    }
  } // namespace



  std::string
  BodyOverlap::place(const Solid &solid) const
  {
    char where[120];
    std::snprintf(where,
                  sizeof(where),
                  " at (%.3g, %.3g, %.3g), by %.3g or more",
                  x[0] + 0.,
                  x[1] + 0.,
                  x[2] + 0.,
                  depth);
    return "body '" + solid.bodies[body].name + "' reaches into " +
           (body == other ? "itself" : "body '" + solid.bodies[other].name + "'") + where;
  }



  std::string
  BodyOverlap::text(const Solid &solid) const
  {
    return place(solid) +
           ": no contact pair keeps these surfaces apart, or its rows did not see them";
  }



  std::vector<BodyOverlap>
  overlapping_bodies(const Contact                &contact,
                     const Vector                 &u,
                     const std::set<unsigned int> &bodies,
                     const double                  least)
  {
    return points_in_bodies(contact, u, bodies, own_surfaces(contact, u, bodies), least);
  }



  std::vector<BodyOverlap>
  points_in_bodies(const Contact                &contact,
                   const Vector                 &u,
                   const std::set<unsigned int> &bodies,
                   std::vector<PointOfBody>      own,
                   const double                  least)
  {
    const Intended                 intended(contact, u);
    const std::vector<PointOfBody> points = points_around(std::move(own), contact, u, bodies);

    // Of each two bodies, in an order that does not depend on the partition.
    std::vector<BodyOverlap> all =
      gather_all(own_overlaps(contact, u, bodies, points, intended, least), contact.communicator());
    double deepest = 0.;
    for (const BodyOverlap &overlap : all)
      deepest = std::max(deepest, overlap.depth);
    const auto key = [deepest](const BodyOverlap &o) {
      return std::make_tuple(o.body, o.other, overlap_order(o.depth, o.x, deepest));
    };
    std::sort(all.begin(), all.end(), [&](const BodyOverlap &a, const BodyOverlap &b) {
      return key(a) < key(b);
    });
    std::vector<BodyOverlap> result;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (k == 0 || all[k].body != all[k - 1].body || all[k].other != all[k - 1].other)
        result.push_back(all[k]);
    return result;
  }
} // namespace Touchstone
