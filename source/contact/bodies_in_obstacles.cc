// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/contact/bodies_in_obstacles.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/geometry/deformed_cells.h>
#include <touchstone/contact/overlap_order.h>
#include <touchstone/contact/tolerances.h>
#include <touchstone/contact/unnamed_nodes.h>

#include <deal.II/base/geometry_info.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <set>

// Faces of bodies within obstacles that no pair names: rows know nothing of them.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The boundaries of the slave body that any pair of it with the same obstacle names. */
    NamedBoundaries
    named_boundaries(const Contact &contact, const ContactPair &pair)
    {
      NamedBoundaries result;
      for (unsigned int p = 0; p < contact.n_pairs(); ++p)
        if (const ContactPair &other = contact.pair(p);
            other.parameters().obstacle == pair.parameters().obstacle &&
            other.slave_body() == pair.slave_body())
          for (const types::boundary_id id : other.slave().boundaries())
            result.emplace(pair.slave_body(), id);
      return result;
    }



    /** The corners of a face of a cell, and its centre. */
    std::array<Point<dim>, 5>
    points_of_face(const std::array<Point<dim>, 8> &corners, const unsigned int f)
    {
      std::array<Point<dim>, 5> result;
      for (unsigned int k = 0; k < 4; ++k)
        {
          result[k] = corners[GeometryInfo<dim>::face_to_cell_vertices(f, k)];
          result[4] += 0.25 * result[k];
        }
      return result;
    }



    /** A point of a body within an obstacle. */
    struct PointInside
    {
      double     depth;
      Point<dim> x;
    };



    /** The points of the slave body within the obstacle of a pair, on this rank. */
    std::vector<PointInside>
    points_inside(const Contact &contact, const ContactPair &pair)
    {
      const auto               named = named_boundaries(contact, pair);
      const Vector             zero  = contact.with_ghosts(contact.solid_model().zero_vector());
      std::vector<PointInside> result;
      const auto add = [&](const Point<dim> &now, const Point<dim> &start, const double least) {
        // What has been so from the start, or half as deep, is as the scene has it.
        if (const double depth = -pair.pairing().distance(now, contact.time());
            depth > least && -pair.pairing().distance(start, 0.) < 0.5 * depth)
          result.push_back({depth, now});
      };
      for (const UnnamedNode &node : unnamed_nodes(contact, named, contact.ghosted_displacement()))
        if (node.body == pair.slave_body())
          add(node.now, node.start, Tolerances::node_in_obstacle * node.size);
      for (const auto &cell : contact.solid_model().dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && cell->material_id() == pair.slave_body() &&
            cell->at_boundary())
          {
            const double least =
              Tolerances::deep_in_body * cell->diameter() / std::sqrt(double(dim));
            const auto now    = deformed_vertices(cell, contact.ghosted_displacement()),
                       before = deformed_vertices(cell, zero);
            for (const unsigned int f : cell->face_indices())
              {
                if (!cell->at_boundary(f) ||
                    named.count({cell->material_id(), cell->face(f)->boundary_id()}) > 0)
                  continue;
                const auto x = points_of_face(now, f), start = points_of_face(before, f);
                for (unsigned int k = 0; k < x.size(); ++k)
                  add(x[k], start[k], least);
              }
          }
      return result;
    }



    std::string
    text(const ContactPairParameters &pair, const PointInside &deepest)
    {
      char where[120];
      std::snprintf(where,
                    sizeof(where),
                    "', by %.3g at (%.3g, %.3g, %.3g)",
                    deepest.depth,
                    deepest.x[0] + 0.,
                    deepest.x[1] + 0.,
                    deepest.x[2] + 0.);
      return "contact pair '" + pair.name + "': body '" + pair.slave_body +
             "' reaches into the obstacle '" + pair.obstacle + where +
             ", with a face that the pair does not name. Name all that may touch it in "
             "'Slave boundaries'";
    }
  } // namespace



  std::vector<std::string>
  bodies_in_obstacles(const Contact &contact)
  {
    std::vector<std::string> result;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const ContactPair &pair = contact.pair(p); !pair.master())
        {
          std::vector<PointInside> all =
            gather_all(points_inside(contact, pair), contact.communicator());
          if (all.empty())
            continue;
          sort_by_depth(all, [](const PointInside &point) { return point; });
          result.push_back(text(pair.parameters(), all.front()));
        }
    return result;
  }
} // namespace Touchstone
