// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/gauss_kernels.h>
#include <touchstone/explicit/lanes.h>

// Deformation and forces of hexahedra with 2x2x2 points, eight cells at a time (doc/explicit.md,
// section 5): the formulas of FiniteStrainKernel.
namespace Touchstone
{
  namespace
  {
    /** Shapes of a line at its two Gauss points. */
    constexpr double near_end = 0.78867513459481288, far_end = 0.21132486540518712;

    /** Values at the points of a line from those at its ends. It is symmetric: forces at the ends
     * from those at the points go the same way. */
    __attribute__((always_inline)) inline void
    from_edges(Lanes &a, Lanes &b)
    {
      const Lanes first = near_end * a + far_end * b;
      b                 = far_end * a + near_end * b;
      a                 = first;
    }

    /** Bits of the corner, or the point, that @p k is of the four around a line in direction d. */
    constexpr unsigned int
    edge_end(const unsigned int d, const unsigned int k)
    {
      return ((k & 1) << ((d + 1) % 3)) | ((k >> 1) << ((d + 2) % 3));
    }

    /** At the four pairs of points along direction d values from those of the four edges, or the
     * other way round. */
    __attribute__((always_inline)) inline void
    from_edges(Lanes (&edges)[4])
    {
      from_edges(edges[0], edges[1]);
      from_edges(edges[2], edges[3]);
      from_edges(edges[0], edges[2]);
      from_edges(edges[1], edges[3]);
    }
  } // namespace



  TOUCHSTONE_VECTORISED void
  GaussKernels::deform(const GaussBlock &block,
                       const double     *field,
                       const bool        f_bar,
                       Points           &points)
  {
    // Derivatives by the coordinates of the unit cell: differences along edges, of which those in
    // direction d do not depend on the place along d.
    Lanes derivative[dim][dim][4];
    for (unsigned int i = 0; i < dim; ++i)
      {
        Lanes x[GaussBlock::n_nodes];
        for (unsigned int a = 0; a < GaussBlock::n_nodes; ++a)
          {
            double values[GaussBlock::n_cells];
            for (unsigned int c = 0; c < GaussBlock::n_cells; ++c)
              values[c] = field[dim * block.nodes[c][a] + i];
            x[a] = load(values);
          }
        for (unsigned int d = 0; d < dim; ++d)
          {
            for (unsigned int k = 0; k < 4; ++k)
              derivative[i][d][k] = x[edge_end(d, k) | (1U << d)] - x[edge_end(d, k)];
            from_edges(derivative[i][d]);
          }
      }
    Lanes volume = {}, present = {}, smallest, J[GaussBlock::n_points];
    for (unsigned int q = 0; q < GaussBlock::n_points; ++q)
      {
        Lanes F[dim * dim], H[dim * dim];
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              Lanes sum = {};
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const unsigned int k =
                    ((q >> ((d + 1) % dim)) & 1) | (((q >> ((d + 2) % dim)) & 1) << 1);
                  sum += derivative[i][d][k] * load(block.inverse[q][dim * d + j]);
                }
              store(sum, points.gradient[q][dim * i + j]);
              F[dim * i + j] = i == j ? sum + 1. : sum;
            }
        cofactors(F, H);
        J[q]               = F[0] * H[0] + F[1] * H[1] + F[2] * H[2];
        const Lanes weight = load(block.weight[q]);
        volume += weight;
        present += weight * J[q];
        smallest = q == 0 ? J[q] : (J[q] < smallest ? J[q] : smallest);
      }
    // Not a number at any point: nor is the sum.
    const Lanes zero = {};
    store(present == present ? smallest : zero, points.smallest);
    if (!f_bar)
      return;
    const Lanes mean = present / volume;
    store(mean, points.mean);
    for (unsigned int q = 0; q < GaussBlock::n_points; ++q)
      {
        const Lanes alpha = inverse_cube_root(J[q] / mean);
        store(alpha, points.alpha[q]);
        for (unsigned int k = 0; k < dim * dim; ++k)
          {
            const Lanes H = load(points.gradient[q][k]);
            store(k % (dim + 1) == 0 ? alpha * H + (alpha - 1.) : alpha * H, points.gradient[q][k]);
          }
      }
  }



  TOUCHSTONE_VECTORISED void
  GaussKernels::set_forces(const GaussBlock &block,
                           const Points     &points,
                           const bool        f_bar,
                           double (*force)[GaussBlock::n_cells])
  {
    // What multiplies the derivative of the mean dilatation, and the pressure of each point
    // (doc/theory.md 2.2): P : Fbar / 3.
    Lanes volume = {}, pressure = {}, third[GaussBlock::n_points];
    if (f_bar)
      for (unsigned int q = 0; q < GaussBlock::n_points; ++q)
        {
          Lanes sum = {};
          for (unsigned int k = 0; k < dim * dim; ++k)
            sum +=
              load(points.stress[q][k]) *
              (k % (dim + 1) == 0 ? load(points.gradient[q][k]) + 1. : load(points.gradient[q][k]));
          third[q] = (1. / 3.) * sum;
          volume += load(block.weight[q]);
          pressure += load(block.weight[q]) * third[q];
        }
    Lanes edges[dim][dim][4] = {};
    for (unsigned int q = 0; q < GaussBlock::n_points; ++q)
      {
        const Lanes weight = load(block.weight[q]);
        Lanes       S[dim * dim];
        if (f_bar)
          {
            // alpha P + H (pressure J / (V J_mean) - third) with H = F^{-T} = alpha cof(Fbar) /
            // J_mean and J = J_mean / alpha^3.
            Lanes       F[dim * dim], H[dim * dim];
            const Lanes alpha = load(points.alpha[q]), factor = weight * alpha;
            for (unsigned int k = 0; k < dim * dim; ++k)
              F[k] =
                k % (dim + 1) == 0 ? load(points.gradient[q][k]) + 1. : load(points.gradient[q][k]);
            cofactors(F, H);
            const Lanes share =
              (pressure / (volume * alpha * alpha * alpha) - third[q]) / load(points.mean);
            for (unsigned int k = 0; k < dim * dim; ++k)
              S[k] = factor * (load(points.stress[q][k]) + share * H[k]);
          }
        else
          for (unsigned int k = 0; k < dim * dim; ++k)
            S[k] = weight * load(points.stress[q][k]);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int k =
              ((q >> ((d + 1) % dim)) & 1) | (((q >> ((d + 2) % dim)) & 1) << 1);
            for (unsigned int i = 0; i < dim; ++i)
              edges[i][d][k] += S[dim * i] * load(block.inverse[q][dim * d]) +
                                S[dim * i + 1] * load(block.inverse[q][dim * d + 1]) +
                                S[dim * i + 2] * load(block.inverse[q][dim * d + 2]);
          }
      }
    for (unsigned int i = 0; i < dim; ++i)
      {
        Lanes f[GaussBlock::n_nodes] = {};
        for (unsigned int d = 0; d < dim; ++d)
          {
            from_edges(edges[i][d]);
            for (unsigned int k = 0; k < 4; ++k)
              {
                f[edge_end(d, k) | (1U << d)] += edges[i][d][k];
                f[edge_end(d, k)] -= edges[i][d][k];
              }
          }
        for (unsigned int a = 0; a < GaussBlock::n_nodes; ++a)
          store(f[a], force[dim * a + i]);
      }
  }
} // namespace Touchstone
