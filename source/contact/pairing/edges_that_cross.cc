// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/edge_contact.h>
#include <touchstone/contact/pairing/edge_search.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>

// Sharp edges of the slave that cross edges of the master (doc/theory.md 4.2).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Along the first of two lines, from a to b as 0 to 1, the foot of their common perpendicular,
     * within the edge; @p otherwise if they are parallel. */
    double
    foot(const Point<dim> (&first)[2], const Point<dim> (&second)[2], const double otherwise)
    {
      const Tensor<1, dim> d = first[1] - first[0], e = second[1] - second[0],
                           n = cross_product_3d(d, e);
      if (n.norm() <= Tolerances::parallel_sine * d.norm() * e.norm())
        return otherwise;
      const double s = cross_product_3d(second[0] - first[0], e) * n / n.norm_square();
      return std::clamp(s, 0., 1.);
    }


    /** The sharp edges of faces with the directions of the lines that they make. */
    std::vector<EdgeOfLine>
    lines_of_edges(const std::vector<Face> &faces)
    {
      const std::vector<SharpEdge> edges = sharp_edges(faces, {}, Tolerances::along_normal_cosine);
      std::unordered_multimap<Index, std::size_t> at_nodes;
      for (std::size_t i = 0; i < edges.size(); ++i)
        for (const Index node : edges[i].nodes)
          at_nodes.emplace(node, i);
      std::vector<EdgeOfLine> result;
      for (const SharpEdge &edge : edges)
        {
          result.push_back({edge, {}});
          const Tensor<1, dim> along = edge.b - edge.a;
          for (unsigned int end = 0; end < 2; ++end)
            {
              // Where one other edge goes on from here, the mean of both.
              EdgeTangent &tangent = result.back().tangents[end];
              tangent              = {along, {{edge.nodes[1], 1.}, {edge.nodes[0], -1.}}};
              unsigned int n       = 0;
              const auto   range   = at_nodes.equal_range(edge.nodes[end]);
              for (auto entry = range.first; entry != range.second; ++entry)
                {
                  const SharpEdge &next = edges[entry->second];
                  if (&next == &edge)
                    continue;
                  const unsigned int   from = (next.nodes[0] == edge.nodes[end] ? 0 : 1);
                  const Tensor<1, dim> on =
                    ((from == 0) == (end == 1) ? 1. : -1.) * (next.b - next.a);
                  if (on * along < Tolerances::edge_goes_on * on.norm() * along.norm())
                    continue;
                  ++n;
                  const Index  far = next.nodes[1 - from], opposite = edge.nodes[1 - end];
                  const double sign = (end == 1 ? 0.5 : -0.5);
                  tangent           = {0.5 * (along + on), {{far, sign}, {opposite, -sign}}};
                }
              if (n > 1)
                tangent = {along, {{edge.nodes[1], 1.}, {edge.nodes[0], -1.}}};
            }
        }
      return result;
    }
  } // namespace


  void
  EdgeSearch::find_edges(std::vector<FoundBetweenNodes> &found) const
  {
    const std::vector<EdgeOfLine> own = lines_of_edges(slave_exchange.faces());
    if (own.empty())
      return;
    const std::vector<EdgeOfLine>                         others = lines_of_edges(exchange.faces());
    std::vector<std::pair<BoundingBox<dim>, std::size_t>> boxes;
    for (std::size_t i = 0; i < others.size(); ++i)
      boxes.emplace_back(
        BoundingBox<dim>(std::vector<Point<dim>>{others[i].edge.a, others[i].edge.b}), i);
    const auto tree = pack_rtree(boxes);
    for (const EdgeOfLine &line : own)
      {
        const SharpEdge &edge = line.edge;
        if (!owned({edge.nodes[0], edge.nodes[1]}))
          continue;
        BoundingBox<dim> box(std::vector<Point<dim>>{edge.a, edge.b});
        // Edges may have passed each other by a part of their length within the step.
        box.extend(edge.a.distance(edge.b));
        namespace query = boost::geometry::index;
        for (const auto &entry : tree | query::adaptors::queried(query::intersects(box)))
          add_crossing(line, others[entry.second], found);
      }
  }



  void
  EdgeSearch::add_crossing(const EdgeOfLine               &line,
                           const EdgeOfLine               &other_line,
                           std::vector<FoundBetweenNodes> &found) const
  {
    const SharpEdge &edge = line.edge, &other = other_line.edge;
    const bool       held = is_held(edge.nodes[0], other.key) || is_held(edge.nodes[1], other.key);
    // Edges in contact may be pressed flat.
    const auto crossing = edge_crossing(edge,
                                        other,
                                        Tolerances::beyond_bend,
                                        held ? 1. : Tolerances::along_normal_cosine);
    if (!crossing)
      return;
    const Point<dim>   x[2] = {start.at(edge.nodes[0]), start.at(edge.nodes[1])};
    const Point<dim>   y[2] = {start.at(other.nodes[0]), start.at(other.nodes[1])};
    const double       a = crossing->along_first, b = crossing->along_second;
    const double       a_before = foot(x, y, a);
    const unsigned int end      = node_of_row({edge.nodes[0], edge.nodes[1]},
                                         other.key,
                                         {1. - a, a},
                                         {1. - a_before, a_before});
    if (end == numbers::invalid_unsigned_int)
      return;
    FoundBetweenNodes result;
    result.contact      = std::make_shared<EdgeContact>(line, other_line, *crossing, end);
    result.nodes        = {{edge.nodes[end], end == 0 ? 1. - a : a},
                           {edge.nodes[1 - end], end == 0 ? a : 1. - a}};
    result.held         = held;
    const double length = edge.a.distance(edge.b), length_other = other.a.distance(other.b);
    result.beyond =
      2. * (std::max({0., -a, a - 1.}) * length + std::max({0., -b, b - 1.}) * length_other);
    const double gap_before =
      ((x[0] + a * (x[1] - x[0])) - (y[0] + b * (y[1] - y[0]))) * crossing->normal;
    const double deep = -Tolerances::deep_edge * std::min(length, length_other);
    result.before     = result.contact->gap() < deep && gap_before < deep;
    result.feet       = {{crossing->first, crossing->second}};
    result.order      = {{other.key, edge.key}};
    found.push_back(result);
  }
} // namespace Touchstone
