// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/lanes.h>
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

    /** The bounds of the nodes of a list, and the highest square of a speed there, as of earlier
     * lists; @p v [3n+i]. */
    TOUCHSTONE_VECTORISED void
    measure_nodes(const std::vector<unsigned int> &list,
                  const double                    *v,
                  double (&bounds)[2 * dim],
                  double &square)
    {
      if (list.empty())
        return;
      Lanes extreme[2 * dim], fastest = {};
      for (Lanes &e : extreme)
        e = Lanes{} + std::numeric_limits<double>::lowest();
      for (std::size_t first = 0; first < list.size(); first += n_lanes)
        {
          const double *x[n_lanes];
          for (unsigned int c = 0; c < n_lanes; ++c)
            x[c] = v + dim * list[std::min(first + c, list.size() - 1)];
          Lanes of_nodes[dim], sum = {};
          gather(x, of_nodes);
          for (unsigned int d = 0; d < dim; ++d)
            {
              const Lanes one = of_nodes[d], other = -one;
              extreme[d]       = one > extreme[d] ? one : extreme[d];
              extreme[dim + d] = other > extreme[dim + d] ? other : extreme[dim + d];
              sum += one * one;
            }
          fastest = sum > fastest ? sum : fastest;
        }
      for (unsigned int c = 0; c < n_lanes; ++c)
        {
          for (unsigned int i = 0; i < 2 * dim; ++i)
            bounds[i] = std::max(bounds[i], extreme[i][c]);
          square = std::max(square, fastest[c]);
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
              {
                for (unsigned int m = 0; m < face.n_nodes(); ++m)
                  list.push_back(nodes.local(dim * face.nodes[m]));
                // Points within cells move with the nodes behind the faces, too.
                if (!pair.pairing().keeps_nodes_out())
                  for (const Index node : face.nodes_behind)
                    list.push_back(nodes.local(dim * node));
              }
            std::sort(list.begin(), list.end());
            list.erase(std::unique(list.begin(), list.end()), list.end());
            sides.push_back(std::move(list));
          }
      }
  }



  void
  SurfaceSpeeds::measure(const std::vector<Measured> &fields) const
  {
    const std::size_t n = sides.size(), n_fields = fields.size();
    // Bounds of all sides for each field, and behind them the squares of the highest speeds.
    std::vector<Bounds> bounds(n_fields * n);
    std::vector<double> all(n_fields * (n * 2 * dim + 1), 0.);
    double *const       squares = &all[n_fields * n * 2 * dim];
    for (std::size_t f = 0; f < n_fields; ++f)
      {
        const double *const v = reinterpret_cast<const double *>(fields[f].first->data());
        Bounds              unused;
        for (std::size_t side = 0; side < n; ++side)
          measure_nodes(sides[side], v, bounds[f * n + side].values, squares[f]);
        measure_nodes(others, v, unused.values, squares[f]);
      }
    for (std::size_t i = 0; i < n_fields * n; ++i)
      std::copy_n(bounds[i].values, 2 * dim, &all[i * 2 * dim]);
    Utilities::MPI::max(std::vector<double>(all), nodes.communicator(), all);
    for (std::size_t i = 0; i < n_fields * n; ++i)
      std::copy_n(&all[i * 2 * dim], 2 * dim, bounds[i].values);
    for (std::size_t f = 0; f < n_fields; ++f)
      {
        Speeds &result = *fields[f].second;
        result         = Speeds();
        result.highest = std::sqrt(squares[f]);
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
