// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/parted_surfaces.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Surfaces with a plane between them. Rows of finite sliding join a slave node to a weighted mean
// of master nodes: along the normal of the plane their gap vector is no shorter than the distance
// of the extents, but for what weights outside of faces can add.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Of the faces, edges and corners of a cube, one of each two. */
    std::vector<Tensor<1, dim>>
    directions_of_cube()
    {
      std::vector<Tensor<1, dim>> result;
      for (int i = 0; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
          for (int k = -1; k <= 1; ++k)
            if (i > 0 || j > 0 || (j == 0 && k > 0))
              {
                Tensor<1, dim> direction;
                direction[0] = i;
                direction[1] = j;
                direction[2] = k;
                result.push_back(direction / direction.norm());
              }
      return result;
    }



    void
    sort_nodes(std::vector<unsigned int> &list)
    {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  } // namespace



  PartedSurfaces::PartedSurfaces(const Contact &contact, const NodeMap &nodes)
    : contact(contact)
    , nodes(nodes)
  {
    int other = contact.n_pairs() == 0;
    for (unsigned int p = 0; p < contact.n_pairs() && other == 0; ++p)
      {
        const ContactPair &pair = contact.pair(p);
        // Rows of other pairs have gaps to something else than facets where they are now.
        if (!pair.master() || pair.small_sliding() || pair.tied() ||
            !pair.pairing().keeps_nodes_out() ||
            pair.parameters().master_normal == MasterNormal::smoothed)
          {
            other = 1;
            break;
          }
        Sides sides;
        for (const Surface *const surface : {&pair.slave(), pair.master()})
          for (const Face &face : surface->owned_faces())
            {
              if (face.degree != 1 || surface->exact_surface(face) != nullptr)
                other = 1;
              for (unsigned int m = 0; m < face.n_nodes(); ++m)
                (surface == &pair.slave() ? sides.slave : sides.master)
                  .push_back(nodes.local(dim * face.nodes[m]));
            }
        sort_nodes(sides.slave);
        sort_nodes(sides.master);
        pairs.push_back(std::move(sides));
      }
    possible = Utilities::MPI::max(other, nodes.communicator()) == 0;
    if (!possible)
      pairs.clear();
  }



  // Of each direction the most, and the least with the other sign.
  std::vector<double>
  PartedSurfaces::extents(const NodeField                   &u,
                          const std::vector<unsigned int>   &list,
                          const std::vector<Tensor<1, dim>> &directions) const
  {
    std::vector<double> result(2 * directions.size(), std::numeric_limits<double>::lowest());
    for (const unsigned int node : list)
      {
        const Tensor<1, dim> x = nodes.positions()[node] + u[node];
        for (std::size_t d = 0; d < directions.size(); ++d)
          {
            const double along = x * directions[d];
            result[2 * d]      = std::max(result[2 * d], along);
            result[2 * d + 1]  = std::max(result[2 * d + 1], -along);
          }
      }
    return result;
  }



  double
  PartedSurfaces::gap_of(const Sides &pair,
                         const double least_slave,
                         const double most_master,
                         const double least_master)
  {
    // By so much slower than any two nodes come together.
    return (least_slave - most_master - pair.outside * std::max(0., most_master - least_master)) /
           (1. + pair.outside);
  }



  double
  PartedSurfaces::part(const NodeField &u)
  {
    if (!possible)
      return 0.;
    static const std::vector<Tensor<1, dim>> directions = directions_of_cube();
    const std::size_t                        n          = 2 * directions.size();
    // Of each pair what is outside of faces, and the extents of both sides.
    std::vector<double> all;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        const ContactPair &pair = contact.pair(p);
        double             most = 0.;
        for (std::size_t k = 0; k < pair.rows().size(); ++k)
          if (const ContactRow &row = pair.rows()[k]; row.has_partner)
            {
              double outside = 0.;
              for (const StencilEntry &entry : row.stencil)
                outside += std::max(0., -entry.weight);
              // Surfaces that have passed through each other have planes between them, too.
              most =
                std::max(most,
                         row.gap < 0. || pair.overlap(k) != 0. ? std::numeric_limits<double>::max()
                                                               : outside);
            }
        all.push_back(most);
        for (const auto *list : {&pairs[p].slave, &pairs[p].master})
          {
            const std::vector<double> found = extents(u, *list, directions);
            all.insert(all.end(), found.begin(), found.end());
          }
      }
    Utilities::MPI::max(std::vector<double>(all), nodes.communicator(), all);
    double result = std::numeric_limits<double>::max();
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        const double *const values = &all[p * (1 + 2 * n)], *const slave = values + 1,
                            *const master = slave + n;
        Sides                     &pair   = pairs[p];
        if (values[0] == std::numeric_limits<double>::max())
          return 0.;
        pair.outside = values[0];
        double best  = std::numeric_limits<double>::lowest();
        for (std::size_t d = 0; d < directions.size(); ++d)
          for (unsigned int sign = 0; sign < 2; ++sign)
            if (const double gap = gap_of(
                  pair, -slave[2 * d + 1 - sign], master[2 * d + sign], -master[2 * d + 1 - sign]);
                gap > best)
              {
                best        = gap;
                pair.normal = (sign == 0 ? 1. : -1.) * directions[d];
              }
        result = std::min(result, best);
      }
    return result;
  }



  double
  PartedSurfaces::gap(const NodeField &u) const
  {
    std::vector<double> all;
    for (const Sides &pair : pairs)
      for (const auto *list : {&pair.slave, &pair.master})
        {
          const std::vector<double> found = extents(u, *list, {pair.normal});
          all.insert(all.end(), found.begin(), found.end());
        }
    Utilities::MPI::max(std::vector<double>(all), nodes.communicator(), all);
    double result = std::numeric_limits<double>::max();
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        const double *const values = &all[4 * p];
        result = std::min(result, gap_of(pairs[p], -values[1], values[2], -values[3]));
      }
    return result;
  }
} // namespace Touchstone
