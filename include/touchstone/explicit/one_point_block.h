// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_one_point_block_h
#define touchstone_explicit_one_point_block_h

#include <touchstone/explicit/n_lanes.h>
#include <touchstone/explicit/node_map.h>

namespace Touchstone
{
  /** @brief Local nodes of eight cells. */
  struct BlockNodes
  {
    unsigned int of_cells[n_lanes][NodeMap::nodes_per_cell];
  };

  /**
   * @brief Geometry of eight undeformed one-point cells and the stiffness of their hourglass
   * control.
   *
   * Values at the nodes are written by their sums with the signs of seven modes: those of the
   * linear functions xi, eta, zeta and of the hourglass modes xi eta, eta zeta, zeta xi, xi eta
   * zeta; that with the sign 1 is the mean. A block is made anew from positions whenever it is
   * needed, which takes less time than to read it, and no memory (doc/explicit.md, section 5).
   */
  struct OnePointBlock
  {
    static constexpr unsigned int n_cells = n_lanes, n_nodes = NodeMap::nodes_per_cell, n_modes = 4,
                                  n_sums = dim + n_modes;

    /** The mean gradients of the shapes over the undeformed cell are sums over the modes but the
     * last of its sign at the node times these, [3m+i]. */
    double slopes[dim * (n_sums - 1)][n_cells];
    /** Sums of the positions: four times the mean edges, and hourglass modes; [3m+i]. */
    double positions[dim * n_sums][n_cells];
    double volume[n_cells];
    /** Of the control of the hourglass modes, along each edge: stiffness of bending and of warping,
     * over the square of the sum of positions, force per length cubed. */
    double bending[dim][n_cells], warping[dim][n_cells];
    /** Or its viscosity, force times time per length. */
    double dampers[n_modes][n_cells];

    /** @brief What a body says of its control of hourglass modes. */
    struct Control
    {
      /** Young's modulus and shear modulus times the coefficient; zero: none. */
      double young = 0., shear = 0.;
      /** Instead of springs: part of critical damping, and the density. */
      double damping = 0., density = 0.;
    };

    /** @brief Compute all from the positions of local nodes, [3n+i]. */
    void
    reinit(const BlockNodes &nodes, const double *positions, const Control &control);

    /** @brief Sign of mode @p m at node @p a. */
    static constexpr int
    sign(const unsigned int m, const unsigned int a)
    {
      const int x = a & 1 ? 1 : -1, y = a & 2 ? 1 : -1, z = a & 4 ? 1 : -1;
      return m == 0   ? x
             : m == 1 ? y
             : m == 2 ? z
             : m == 3 ? x * y
             : m == 4 ? y * z
             : m == 5 ? z * x
                      : x * y * z;
    }
    /** @brief Mean gradient of the shape of node @p a of the cell @p lane, component @p i. */
    double
    gradient(const unsigned int a, const unsigned int i, const unsigned int lane) const
    {
      double sum = 0.;
      for (unsigned int m = 0; m < n_sums - 1; ++m)
        sum += sign(m, a) * slopes[dim * m + i][lane];
      return sum;
    }
    /** @brief Hourglass mode @p m without what it has of linear functions, at node @p a. */
    double
    mode(const unsigned int m, const unsigned int a, const unsigned int lane) const
    {
      double sum = sign(dim + m, a);
      for (unsigned int i = 0; i < dim; ++i)
        sum -= positions[dim * (dim + m) + i][lane] * gradient(a, i, lane);
      return sum;
    }

    /** @brief Whether hourglass mode @p m along edge @p i is a warping, across both of its own
     * edges. */
    static constexpr bool
    warps(const unsigned int m, const unsigned int i)
    {
      return m < dim && i == (m + 2) % dim;
    }
    /** @brief The stiffness of bending of hourglass mode @p m relative to that in #bending. */
    static constexpr double
    part(const unsigned int m)
    {
      return m < dim ? 1. : 1. / 3.;
    }
  };
} // namespace Touchstone

#endif
