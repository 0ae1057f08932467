// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_one_point_sums_h
#define touchstone_explicit_one_point_sums_h

#include <touchstone/explicit/lanes.h>
#include <touchstone/explicit/one_point_block.h>

namespace Touchstone
{
  /** @brief A field of local nodes, [3n+i], at node @p a of eight cells. */
  __attribute__((always_inline)) inline void
  gather(const BlockNodes &nodes, const double *field, const unsigned int a, Lanes (&values)[dim])
  {
    const double *of_cells[n_lanes];
    for (unsigned int c = 0; c < n_lanes; ++c)
      of_cells[c] = field + dim * nodes.of_cells[c][a];
    gather(of_cells, values);
  }

  /** @brief Sums over the nodes of eight cells, with the signs of the modes of OnePointBlock, of
   * the components of a field of local nodes, [3n+i]. */
  __attribute__((always_inline)) inline void
  set_sums(const BlockNodes &nodes, const double *field, Lanes (&sums)[dim][OnePointBlock::n_sums])
  {
    Lanes x[OnePointBlock::n_nodes][dim];
    for (unsigned int a = 0; a < OnePointBlock::n_nodes; ++a)
      gather(nodes, field, a, x[a]);
    for (unsigned int i = 0; i < dim; ++i)
      {
        // Sums and differences along xi, then of those along eta and zeta.
        Lanes d[4], s[4];
        for (unsigned int k = 0; k < 4; ++k)
          {
            d[k] = x[2 * k + 1][i] - x[2 * k][i];
            s[k] = x[2 * k + 1][i] + x[2 * k][i];
          }
        const Lanes d_low = d[0] + d[1], d_high = d[2] + d[3], e_low = d[1] - d[0],
                    e_high = d[3] - d[2], t_low = s[1] - s[0], t_high = s[3] - s[2];
        sums[i][0] = d_low + d_high;
        sums[i][1] = t_low + t_high;
        sums[i][2] = (s[2] + s[3]) - (s[0] + s[1]);
        sums[i][3] = e_low + e_high;
        sums[i][4] = t_high - t_low;
        sums[i][5] = d_high - d_low;
        sums[i][6] = e_high - e_low;
      }
  }

  /** @brief A vector of each cell. */
  struct Vectors
  {
    Lanes c[dim];
  };

  __attribute__((always_inline)) inline Vectors
  cross(const Vectors &a, const Vectors &b)
  {
    return {{a.c[1] * b.c[2] - a.c[2] * b.c[1],
             a.c[2] * b.c[0] - a.c[0] * b.c[2],
             a.c[0] * b.c[1] - a.c[1] * b.c[0]}};
  }

  __attribute__((always_inline)) inline Lanes
  dot(const Vectors &a, const Vectors &b)
  {
    return a.c[0] * b.c[0] + a.c[1] * b.c[1] + a.c[2] * b.c[2];
  }

  /** @brief The derivatives of the volume by the sums of positions, exact: the volume is the
   * integral of the determinant of trilinear functions, of whose products few have a mean that is
   * not zero. The last mode does not change it. @return the volume. */
  __attribute__((always_inline)) inline Lanes
  volume_derivatives(const Vectors (&x)[OnePointBlock::n_sums],
                     Vectors (&derivatives)[OnePointBlock::n_sums - 1])
  {
    Lanes volume = {};
    for (unsigned int i = 0; i < dim; ++i)
      {
        // Of the linear mode i and, with the same edge j, of the hourglass mode i j.
        const unsigned int j = (i + 1) % dim, k = (i + 2) % dim;
        const Vectors      edges = cross(x[j], x[k]), bends = cross(x[dim + i], x[dim + k]),
                      first = cross(x[j], x[dim + j]), second = cross(x[i], x[dim + k]);
        for (unsigned int d = 0; d < dim; ++d)
          {
            derivatives[i].c[d]       = 0.125 * edges.c[d] + (1. / 24.) * bends.c[d];
            derivatives[dim + i].c[d] = (1. / 24.) * (first.c[d] - second.c[d]);
          }
        volume += dot(derivatives[i], x[i]) + dot(derivatives[dim + i], x[dim + i]);
      }
    return (1. / 24.) * volume;
  }

  /** @brief The values at the nodes that are sums over the modes times their signs. */
  __attribute__((always_inline)) inline void
  set_nodal_values(const Lanes (&modes)[OnePointBlock::n_sums],
                   Lanes (&values)[OnePointBlock::n_nodes])
  {
    for (unsigned int eta = 0; eta < 2; ++eta)
      {
        // Along xi and constant, of parts that are even and odd in zeta.
        const Lanes even_slope = eta == 1 ? modes[0] + modes[3] : modes[0] - modes[3],
                    odd_slope  = eta == 1 ? modes[5] + modes[6] : modes[5] - modes[6],
                    odd        = eta == 1 ? modes[2] + modes[4] : modes[2] - modes[4];
        for (unsigned int xi = 0; xi < 2; ++xi)
          {
            const Lanes slope        = xi == 1 ? even_slope : -even_slope,
                        e            = eta == 1 ? slope + modes[1] : slope - modes[1],
                        o            = xi == 1 ? odd + odd_slope : odd - odd_slope;
            values[xi + 2 * eta]     = e - o;
            values[xi + 2 * eta + 4] = e + o;
          }
      }
  }
} // namespace Touchstone

#endif
