// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/measured_face.h>
#include <touchstone/contact/pairing/sets_of_points.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <cmath>

// Which of the points of overlaps are to have rows (doc/theory.md 4.2).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    bool
    has_node(const MaterialPoint &point, const Index node)
    {
      const auto end = point.nodes.begin() + point.n;
      return std::find(point.nodes.begin(), end, node) != end;
    }



    double
    weight(const MaterialPoint &point, const Index node)
    {
      double result = 0.;
      for (unsigned int a = 0; a < point.n; ++a)
        if (point.nodes[a] == node)
          result += point.weights[a];
      return result;
    }



    bool
    share_node(const MaterialPoint &one, const MaterialPoint &other)
    {
      return std::any_of(one.nodes.begin(), one.nodes.begin() + one.n, [&](const Index node) {
        return refers_to(one, node) && refers_to(other, node);
      });
    }



    /** The part of a point that is on the nodes of another one: 1 on an edge between their faces.
     */
    double
    part_on(const MaterialPoint &other, const MaterialPoint &point)
    {
      double part = 0.;
      for (unsigned int a = 0; a < point.n; ++a)
        if (refers_to(other, point.nodes[a]))
          part += point.weights[a];
      return part;
    }



    /** Whether a point lies on the face of another one or on an edge of it. */
    bool
    lies_on(const MaterialPoint &other, const MaterialPoint &point)
    {
      for (unsigned int a = 0; a < point.n; ++a)
        if (refers_to(point, point.nodes[a]) && !has_node(other, point.nodes[a]))
          return false;
      return true;
    }



    /** Whether a point is the end of an overlap that another point is nearer to the middle of, in
     * the next face: overlaps do not end at edges, and one of them needs one point. */
    bool
    is_end_of(const MaterialPoint &other, const MaterialPoint &point)
    {
      const double part = part_on(other, point);
      return part > Tolerances::at_node && part > part_on(point, other) + same_place;
    }



    /** Move a point to the middle between it and its mirror image in the next face, on the edge
     * between both. @return false if a node of its face hangs: nothing is done. */
    bool
    move_to_edge(MaterialPoint &point, const MaterialPoint &image)
    {
      const unsigned int degree =
        static_cast<unsigned int>(std::lround(std::sqrt(double(point.n)))) - 1;
      const auto coordinates = [&](const auto &weight_of) {
        // Shape functions reproduce the coordinates.
        MeasuredFace::Xi xi{};
        double           sum = 0.;
        for (unsigned int a = 0; a < point.n; ++a)
          {
            const double w = weight_of(a);
            sum += w;
            xi[0] += w * (2. * (a % (degree + 1)) / degree - 1.);
            xi[1] += w * (2. * (a / (degree + 1)) / degree - 1.);
          }
        for (double &value : xi)
          value = std::clamp(value / sum, -1., 1.);
        return xi;
      };
      const MeasuredFace::Xi own =
        coordinates([&](const unsigned int a) { return point.weights[a]; });
      if (std::hypot(own[0] - point.xi[0], own[1] - point.xi[1]) > same_place)
        return false;
      point.xi      = coordinates([&](const unsigned int a) {
        return refers_to(image, point.nodes[a]) ? point.weights[a] + weight(image, point.nodes[a])
                                                     : 0.;
      });
      point.weights = FaceShapes(degree, point.xi).value;
      point.depth   = std::max(point.depth, image.depth);
      return true;
    }
  } // namespace



  bool
  refers_to(const MaterialPoint &point, const Index node)
  {
    return std::abs(weight(point, node)) > Tolerances::negligible_weight;
  }



  std::optional<std::array<double, 2>>
  coordinates_on(const Face &face, const MaterialPoint &point)
  {
    // Shape functions reproduce the coordinates.
    std::array<double, 2> xi{};
    for (unsigned int a = 0; a < point.n; ++a)
      if (refers_to(point, point.nodes[a]))
        {
          const unsigned int m = face.number_of(point.nodes[a]);
          if (m == face.n_nodes())
            return {};
          const auto at_node = node_coordinates(face, m);
          for (unsigned int d = 0; d < 2; ++d)
            xi[d] += point.weights[a] * at_node[d];
        }
    for (double &value : xi)
      value = std::clamp(value, -1., 1.);
    return xi;
  }



  const MaterialPoint *
  point_of(const std::vector<MaterialPoint> &points, const Index node)
  {
    const auto found = std::find_if(points.begin(), points.end(), [&](const MaterialPoint &point) {
      return point.nodes[point.slave] == node;
    });
    return found == points.end() ? nullptr : &*found;
  }



  double
  distance(const MaterialPoint &one, const MaterialPoint &other)
  {
    double sum = 0.;
    for (unsigned int a = 0; a < one.n; ++a)
      sum += std::abs(one.weights[a] - weight(other, one.nodes[a]));
    for (unsigned int b = 0; b < other.n; ++b)
      if (!has_node(one, other.nodes[b]))
        sum += std::abs(other.weights[b]);
    return sum;
  }



  bool
  coincide(const MaterialPoint &one, const MaterialPoint &other)
  {
    return distance(one, other) < same_place;
  }



  bool
  in_same_face(const MaterialPoint &one, const MaterialPoint &other)
  {
    return lies_on(one, other) || lies_on(other, one);
  }



  bool
  goes_on_from(const MaterialPoint &last, const MaterialPoint &point)
  {
    // Nearer to each other than to the next sample of an overlap.
    constexpr double near = 0.25;
    return distance(last, point) < near;
  }



  bool
  equally_deep(const MaterialPoint &one, const MaterialPoint &other)
  {
    constexpr double equal = 0.99;
    return share_node(one, other) &&
           std::min(one.depth, other.depth) > equal * std::max(one.depth, other.depth);
  }



  std::vector<MaterialPoint>
  on_edges(std::vector<MaterialPoint> wanted)
  {
    for (std::size_t i = 0; i < wanted.size(); ++i)
      for (std::size_t j = i + 1; j < wanted.size(); ++j)
        if (const double part = part_on(wanted[j], wanted[i]);
            part > Tolerances::at_node && equally_deep(wanted[i], wanted[j]) &&
            std::abs(part - part_on(wanted[i], wanted[j])) < same_place &&
            move_to_edge(wanted[i], wanted[j]))
          {
            wanted.erase(wanted.begin() + j);
            break;
          }
    return wanted;
  }



  std::vector<MaterialPoint>
  deepest_of_neighbours(const std::vector<MaterialPoint> &wanted)
  {
    std::vector<MaterialPoint> result;
    for (const MaterialPoint &point : wanted)
      if (std::none_of(wanted.begin(),
                       wanted.end(),
                       [&](const MaterialPoint &other) {
                         return equally_deep(point, other) && is_end_of(other, point);
                       }) &&
          std::none_of(result.begin(), result.end(), [&](const MaterialPoint &other) {
            return share_node(point, other) &&
                   (!equally_deep(point, other) || coincide(point, other));
          }))
        result.push_back(point);
    return result;
  }



  bool
  in_cycle(std::vector<MaterialPoint> points)
  {
    // Rows that refer to no other are put aside, one after the other.
    while (!points.empty())
      {
        const auto next =
          std::find_if(points.begin(), points.end(), [&](const MaterialPoint &point) {
            return std::none_of(points.begin(), points.end(), [&](const MaterialPoint &other) {
              return &other != &point && refers_to(point, other.nodes[other.slave]);
            });
          });
        if (next == points.end())
          return true;
        points.erase(next);
      }
    return false;
  }
} // namespace Touchstone
