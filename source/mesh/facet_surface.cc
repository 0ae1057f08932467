// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/facet_surface.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

namespace Touchstone
{
  using namespace dealii;

  FacetSurface::FacetSurface(const std::vector<FacetCorners> &triangles, const bool outside)
    : sign(outside ? 1. : -1.)
  {
    join(triangles);
    check();
    numbers.resize(facets.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    tree = tree_of(numbers);
  }



  BoxTree
  FacetSurface::tree_of(const std::vector<unsigned int> &chosen) const
  {
    std::vector<BoundingBox<3>> boxes;
    for (const unsigned int number : chosen)
      {
        const Corners &facet = facets[number];
        Point<3>       low = corners[facet[0]], high = low;
        for (const unsigned int v : facet)
          for (unsigned int d = 0; d < 3; ++d)
            {
              low[d]  = std::min(low[d], corners[v][d]);
              high[d] = std::max(high[d], corners[v][d]);
            }
        boxes.emplace_back(std::make_pair(low, high));
      }
    SearchBoxes search;
    search.append(boxes, "facets");
    BoxTree result;
    result.build(search);
    return result;
  }



  Point<3>
  FacetSurface::project(const Point<3> &x) const
  {
    return closest(x).point;
  }



  Tensor<2, 3>
  FacetSurface::projection_gradient(const Point<3> &x) const
  {
    return gradient_at(closest(x));
  }



  Tensor<2, 3>
  FacetSurface::gradient_at(const Closest &at) const
  {
    Tensor<2, 3> result;
    if (at.n_fixed == 0)
      {
        const Tensor<1, 3> &n = normals[at.facet];
        result                = unit_symmetric_tensor<3>();
        result -= outer_product(n, n);
      }
    else if (at.n_fixed == 1)
      result = outer_product(at.along, at.along);
    return result;
  }



  Tensor<1, 3>
  FacetSurface::normal(const Point<3> &x) const
  {
    return normal_at(x, closest(x));
  }



  Tensor<1, 3>
  FacetSurface::normal_at(const Point<3> &x, const Closest &at) const
  {
    const Tensor<1, 3> pseudo = pseudonormal(at), gap = x - at.point;
    // On the surface, to round-off, the direction of the gap has no meaning.
    if (at.n_fixed == 0 || gap.norm() <= 1e-10 * size)
      return sign * pseudo;
    return (gap * pseudo > 0. ? sign : -sign) * gap / gap.norm();
  }



  void
  FacetSurface::join(const std::vector<FacetCorners> &triangles)
  {
    std::map<std::array<double, 3>, unsigned int> numbers;
    for (const FacetCorners &triangle : triangles)
      {
        Corners facet;
        for (unsigned int v = 0; v < 3; ++v)
          {
            const Point<3> &x = triangle[v];
            if (!std::isfinite(x.norm_square()))
              throw std::runtime_error("a vertex is not finite");
            const auto found =
              numbers.emplace(std::array<double, 3>{{x[0], x[1], x[2]}}, corners.size());
            if (found.second)
              corners.push_back(x);
            facet[v] = found.first->second;
          }
        if (facet[0] != facet[1] && facet[1] != facet[2] && facet[2] != facet[0])
          facets.push_back(facet);
      }
    for (const Point<3> &x : corners)
      size = std::max(size, x.distance(corners[0]));
  }



  void
  FacetSurface::check()
  {
    corner_normals.resize(corners.size());
    std::map<std::array<unsigned int, 2>, int> uses;
    double                                     volume = 0.;
    for (const Corners &facet : facets)
      {
        const Point<3>    &a    = corners[facet[0]];
        const Tensor<1, 3> area = cross_product_3d(corners[facet[1]] - a, corners[facet[2]] - a);
        if (!(area.norm() > 1e-14 * size * size))
          throw std::runtime_error("a facet has no area");
        normals.push_back(area / area.norm());
        volume += Tensor<1, 3>(a - corners[0]) * area / 6.;
        for (unsigned int v = 0; v < 3; ++v)
          {
            const unsigned int from = facet[v], to = facet[(v + 1) % 3];
            if (++uses[{{from, to}}] > 1)
              throw std::runtime_error("two facets at an edge look to different sides, or more "
                                       "than two meet there");
            edge_normals[edge_between(from, to)] += normals.back();
            const Tensor<1, 3> e = corners[to] - corners[from],
                               f = corners[facet[(v + 2) % 3]] - corners[from];
            corner_normals[from] +=
              std::acos(std::clamp(e * f / (e.norm() * f.norm()), -1., 1.)) * normals.back();
          }
      }
    std::size_t open = 0;
    for (const auto &[edge, n] : uses)
      open += uses.count({{edge[1], edge[0]}}) == 0;
    if (open > 0 || facets.empty())
      throw std::runtime_error("the surface is not closed: " + std::to_string(open) +
                               " edges belong to one facet only");
    if (!(volume > 0.))
      throw std::runtime_error("the surface is inside out: its facets look inwards");
    for (auto &[edge, n] : edge_normals)
      n = n.norm() > 0. ? n / n.norm() : n;
    for (Tensor<1, 3> &n : corner_normals)
      n = n.norm() > 0. ? n / n.norm() : n;
  }



  Tensor<1, 3>
  FacetSurface::pseudonormal(const Closest &at) const
  {
    return at.n_fixed == 0 ? normals[at.facet]
           : at.feature[0] != at.feature[1]
             ? edge_normals.at(edge_between(at.feature[0], at.feature[1]))
             : corner_normals[at.feature[0]];
  }



  FacetSurface::Closest
  FacetSurface::closest(const Point<3> &x) const
  {
    return closest_of(x, tree, numbers);
  }



  FacetSurface::Closest
  FacetSurface::closest_of(const Point<3>                  &x,
                           const BoxTree                   &of,
                           const std::vector<unsigned int> &chosen) const
  {
    Closest best;
    double  distance = std::numeric_limits<double>::max();
    of.nearest(x, [&](const unsigned int k) {
      const Closest other = on_facet(x, chosen[k]);
      const double  d     = x.distance(other.point);
      // Of facets in the same distance the first of the file, whatever the order of search.
      if (d < distance || (d == distance && other.facet < best.facet))
        {
          distance = d;
          best     = other;
        }
      return distance;
    });
    if (best.n_fixed == 1)
      {
        best.along = corners[best.feature[1]] - corners[best.feature[0]];
        best.along /= best.along.norm();
      }
    return best;
  }



  // Ericson 2005, Real-Time Collision Detection, 5.1.5.
  FacetSurface::Closest
  FacetSurface::on_facet(const Point<3> &x, const unsigned int number) const
  {
    const Corners     &f = facets[number];
    const Point<3>    &a = corners[f[0]], &b = corners[f[1]], &c = corners[f[2]];
    const Tensor<1, 3> ab = b - a, ac = c - a, ap = x - a, bp = x - b, cp = x - c;
    const double d1 = ab * ap, d2 = ac * ap, d3 = ab * bp, d4 = ac * bp, d5 = ab * cp, d6 = ac * cp;
    // What lies on an edge or corner but for round-off lies there, on any processor: the normal
    // is another one within the facet.
    constexpr double near  = 1e-13;
    const double     of_ab = near * (d1 - d3), of_ac = near * (d2 - d6),
                 of_bc = near * (d4 - d3 + d5 - d6);
    if (d1 <= of_ab && d2 <= of_ac)
      return {a, number, 2, {{f[0], f[0]}}, {}};
    if (d3 >= -of_ab && d4 - d3 <= of_bc)
      return {b, number, 2, {{f[1], f[1]}}, {}};
    if (d6 >= -of_ac && d5 - d6 <= of_bc)
      return {c, number, 2, {{f[2], f[2]}}, {}};
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    // These are barycentric coordinates but for a common factor.
    const double least = near * (std::abs(va) + std::abs(vb) + std::abs(vc));
    if (vc <= least && d1 >= 0. && d3 <= 0.)
      return {Point<3>(a + d1 / (d1 - d3) * ab), number, 1, {{f[0], f[1]}}, {}};
    if (vb <= least && d2 >= 0. && d6 <= 0.)
      return {Point<3>(a + d2 / (d2 - d6) * ac), number, 1, {{f[0], f[2]}}, {}};
    if (va <= least && d4 - d3 >= 0. && d5 - d6 >= 0.)
      return {
        Point<3>(b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b)), number, 1, {{f[1], f[2]}}, {}};
    // By the plane, whose normal is known without cancellation.
    return {Point<3>(x - ((x - a) * normals[number]) * normals[number]), number, 0, {}, {}};
  }
} // namespace Touchstone
