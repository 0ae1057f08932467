// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/facet_walls.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <map>

// Die corners: the parts of a surface of facets that a point can touch at the same time.
namespace Touchstone
{
  using namespace dealii;

  FacetWalls::FacetWalls(const FacetSurface &surface)
    : facets(surface.all_facets())
  {
    // Cosine of 20 degrees: facets of a curved surface that meet in less are smooth.
    constexpr double                                        smooth = 0.94;
    std::map<FacetSurface::Edge, std::vector<unsigned int>> facets_of_edge;
    for (unsigned int f = 0; f < facets.size(); ++f)
      for (unsigned int k = 0; k < 3; ++k)
        {
          facets_of_edge[FacetSurface::edge_between(facets[f][k], facets[f][(k + 1) % 3])]
            .push_back(f);
          facets_at.resize(std::max<std::size_t>(facets_at.size(), facets[f][k] + 1));
          facets_at[facets[f][k]].push_back(f);
        }
    const auto is_smooth = [&](const std::vector<unsigned int> &both) {
      return surface.facet_normal(both[0]) * surface.facet_normal(both[1]) > smooth;
    };

    boost::disjoint_sets_with_storage<> joined(facets.size());
    for (const auto &[edge, both] : facets_of_edge)
      if (is_smooth(both))
        joined.union_set(both[0], both[1]);
    std::map<std::size_t, unsigned int> numbers;
    for (unsigned int f = 0; f < facets.size(); ++f)
      patches.push_back(numbers.emplace(joined.find_set(f), numbers.size()).first->second);
    walls.assign(numbers.size(), 0);

    at_corner.resize(facets_at.size());
    for (const auto &[edge, both] : facets_of_edge)
      {
        const unsigned int a = patches[both[0]], b = patches[both[1]];
        if (a == b || is_smooth(both))
          continue;
        // In the plane of each facet, perpendicular to the edge.
        const Tensor<1, 3> along = surface.corner(edge[1]) - surface.corner(edge[0]);
        for (unsigned int k = 0; k < 2; ++k)
          {
            const Tensor<1, 3> &normal = surface.facet_normal(both[k]);
            Tensor<1, 3>        across = cross_product_3d(normal, along);
            Point<3>            centre;
            for (const unsigned int v : facets[both[k]])
              centre += surface.corner(v) / 3.;
            if (across * (centre - surface.corner(edge[0])) > 0.)
              across *= -1.;
            // The other facet is above the plane of this one, where the bodies are.
            if (!(surface.side() * (across * surface.facet_normal(both[1 - k])) < 0.))
              continue;
            inner.insert(edge);
            neighbours.insert({std::min(a, b), std::max(a, b)});
            for (const unsigned int v : edge)
              at_corner[v].push_back({both[k], across / across.norm()});
          }
      }
    number_walls();
  }



  // Each patch gets the lowest number that none of its neighbours before it has.
  void
  FacetWalls::number_walls()
  {
    for (unsigned int patch = 0; patch < walls.size(); ++patch)
      {
        std::set<unsigned int> taken;
        for (unsigned int before = 0; before < patch; ++before)
          if (meet(before, patch))
            taken.insert(walls[before]);
        while (taken.count(walls[patch]) > 0)
          ++walls[patch];
        n = std::max(n, walls[patch] + 1);
      }
  }



  std::vector<unsigned int>
  FacetWalls::facets_of(const unsigned int wall) const
  {
    std::vector<unsigned int> result;
    for (unsigned int f = 0; f < patches.size(); ++f)
      if (walls[patches[f]] == wall)
        result.push_back(f);
    return result;
  }



  std::vector<FacetWalls::InnerEdge>
  FacetWalls::inner_edges(const unsigned int patch, const unsigned int corner) const
  {
    std::vector<InnerEdge> result;
    for (const InnerEdge &edge : at_corner[corner])
      if (patches[edge.facet] == patch)
        result.push_back(edge);
    return result;
  }



  unsigned int
  FacetWalls::first_facet(const FacetSurface::Closest &at) const
  {
    if (at.n_fixed == 0)
      return at.facet;
    unsigned int result = at.facet;
    for (const unsigned int f : facets_at[at.feature[0]])
      if (std::count(facets[f].begin(), facets[f].end(), at.feature[1]) > 0 &&
          std::make_pair(wall(f), f) < std::make_pair(wall(result), result))
        result = f;
    return result;
  }



  namespace
  {
    /** One wall: the facets of it, which go on as planes beyond the edges that look inwards. */
    class FacetWall : public AnalyticSurface
    {
    public:
      FacetWall(const std::shared_ptr<const FacetSurface> &surface,
                const std::shared_ptr<const FacetWalls>   &walls,
                const unsigned int                         number)
        : surface(surface)
        , walls(walls)
        , number(number)
        , facets(walls->facets_of(number))
        , tree(surface->tree_of(facets))
      {
      }

      Point<3>
      project(const Point<3> &x) const override
      {
        return closest(x).point;
      }

      Tensor<2, 3>
      projection_gradient(const Point<3> &x) const override
      {
        return surface->gradient_at(closest(x));
      }

      Tensor<1, 3>
      normal(const Point<3> &x) const override
      {
        return surface->normal_at(x, closest(x));
      }

      // What is closest to another wall touches this one only if both meet in a corner. An edge
      // that looks outwards belongs to the first of its walls.
      bool
      can_be_touched(const Point<3> &x) const override
      {
        const unsigned int nearest = walls->first_facet(surface->closest(x));
        return walls->wall(nearest) == number ||
               walls->meet(walls->patch(nearest),
                           walls->patch(surface->closest_of(x, tree, facets).facet));
      }

    private:
      std::shared_ptr<const FacetSurface> surface;
      std::shared_ptr<const FacetWalls>   walls;
      const unsigned int                  number;
      const std::vector<unsigned int>     facets;
      const BoxTree                       tree;

      FacetSurface::Closest
      closest(const Point<3> &x) const
      {
        const FacetSurface::Closest at = surface->closest_of(x, tree, facets);
        if (at.n_fixed == 1 &&
            walls->is_inner(FacetSurface::edge_between(at.feature[0], at.feature[1])))
          return in_plane_of(x, at.facet);
        return at.n_fixed == 2 ? beside_corner(x, at) : at;
      }

      /** On the plane of a facet, beyond its edges. */
      FacetSurface::Closest
      in_plane_of(const Point<3> &x, const unsigned int facet) const
      {
        const Tensor<1, 3> &n = surface->facet_normal(facet);
        const Point<3>     &a = surface->corner(surface->all_facets()[facet][0]);
        return {Point<3>(x - ((x - a) * n) * n), facet, 0, {}, {}};
      }

      /** Closest to a corner, with the strips by which facets go on beyond inner edges there. */
      FacetSurface::Closest
      beside_corner(const Point<3> &x, const FacetSurface::Closest &at) const
      {
        const auto edges = walls->inner_edges(walls->patch(at.facet), at.feature[0]);
        if (edges.empty())
          return at;
        constexpr double same = 0.999;
        for (const auto &edge : edges)
          // Between two strips the planes go on, too.
          if (edge.across * edges[0].across < same)
            return in_plane_of(x, edges[0].facet);
        // Beside the end of a single strip.
        const Tensor<1, 3> across = edges[0].across;
        const double       length = (x - at.point) * across;
        if (length <= 0.)
          return at;
        return {at.point + length * across, at.facet, 1, at.feature, across};
      }
    };
  } // namespace



  std::vector<std::shared_ptr<const AnalyticSurface>>
  make_walls(const std::shared_ptr<const FacetSurface> &surface)
  {
    const auto walls = std::make_shared<FacetWalls>(*surface);
    std::vector<std::shared_ptr<const AnalyticSurface>> result;
    if (walls->n_walls() > 1)
      for (unsigned int wall = 0; wall < walls->n_walls(); ++wall)
        result.push_back(std::make_shared<FacetWall>(surface, walls, wall));
    return result;
  }
} // namespace Touchstone
