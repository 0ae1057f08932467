// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/surface_speeds.h>

#include <algorithm>
#include <cmath>
#include <limits>

// The box of the velocities of each contact surface: a weighted mean of its nodes has a velocity in
// that box, and no two points move relative to each other by more than its diagonal.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Upper bounds, and negative lower ones: so that maxima over ranks serve both. */
    struct Bounds
    {
      double values[2 * dim];

      Bounds()
      {
        std::fill(values, values + 2 * dim, std::numeric_limits<double>::lowest());
      }

      void
      add(const Tensor<1, dim> &v)
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            values[d]       = std::max(values[d], v[d]);
            values[dim + d] = std::max(values[dim + d], -v[d]);
          }
      }

      void
      add(const Bounds &other)
      {
        for (unsigned int i = 0; i < 2 * dim; ++i)
          values[i] = std::max(values[i], other.values[i]);
      }

      double
      diagonal() const
      {
        double square = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          square += (values[d] + values[dim + d]) * (values[d] + values[dim + d]);
        return std::sqrt(square);
      }
    };

    /** The bounds of a surface and the highest square of a speed there. */
    void
    measure_nodes(const std::vector<unsigned int> &list,
                  const NodeField                 &v,
                  Bounds                          &bounds,
                  double                          &square)
    {
      for (const unsigned int node : list)
        {
          bounds.add(v[node]);
          square = std::max(square, v[node].norm_square());
        }
    }
  } // namespace



  SurfaceSpeeds::SurfaceSpeeds(const Contact &contact, const NodeMap &nodes)
    : nodes(nodes)
  {
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair = contact.pair(p);
        if (!pair.master())
          {
            for (const ContactRow &row : pair.rows())
              others.push_back(nodes.local(dim * row.slave));
            continue;
          }
        for (const Surface *const surface : {&pair.slave(), pair.master()})
          {
            std::vector<unsigned int> list;
            for (const Face &face : surface->owned_faces())
              // Points within cells move with the nodes behind the faces, too.
              for (unsigned int m = 0;
                   m < (pair.pairing().keeps_nodes_out() ? face.n_nodes() : 2 * Face::behind);
                   ++m)
                list.push_back(nodes.local(dim * face.nodes[m]));
            std::sort(list.begin(), list.end());
            list.erase(std::unique(list.begin(), list.end()), list.end());
            sides.push_back(std::move(list));
          }
      }
  }



  void
  SurfaceSpeeds::measure(const NodeField &before,
                         const NodeField &v,
                         Speeds          &of_before,
                         Speeds          &of_v) const
  {
    const NodeField *const fields[]  = {&before, &v};
    Speeds *const          results[] = {&of_before, &of_v};
    const std::size_t      n         = sides.size();
    // Bounds of all sides for either field, and behind them the squares of the highest speeds.
    std::vector<Bounds> bounds(2 * n);
    std::vector<double> all(2 * n * 2 * dim + 2, 0.);
    for (unsigned int f = 0; f < 2; ++f)
      {
        double square = 0.;
        Bounds unused;
        for (std::size_t side = 0; side < n; ++side)
          measure_nodes(sides[side], *fields[f], bounds[f * n + side], square);
        measure_nodes(others, *fields[f], unused, square);
        all[2 * n * 2 * dim + f] = square;
      }
    for (std::size_t i = 0; i < 2 * n; ++i)
      std::copy_n(bounds[i].values, 2 * dim, &all[i * 2 * dim]);
    Utilities::MPI::max(std::vector<double>(all), nodes.communicator(), all);
    for (std::size_t i = 0; i < 2 * n; ++i)
      std::copy_n(&all[i * 2 * dim], 2 * dim, bounds[i].values);
    for (unsigned int f = 0; f < 2; ++f)
      {
        Speeds &result = *results[f];
        result         = Speeds();
        result.highest = std::sqrt(all[2 * n * 2 * dim + f]);
        for (std::size_t side = 0; side < n; side += 2)
          {
            Bounds &one = bounds[f * n + side], &other = bounds[f * n + side + 1];
            result.within = std::max({result.within, one.diagonal(), other.diagonal()});
            one.add(other);
            result.apart = std::max(result.apart, one.diagonal());
          }
      }
  }
} // namespace Touchstone
