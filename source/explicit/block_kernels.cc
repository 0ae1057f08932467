// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/block_kernels.h>
#include <touchstone/explicit/one_point_sums.h>

// Shapes of cells and their changes, eight cells at a time (doc/explicit.md, section 4).
namespace Touchstone
{
  namespace
  {
    constexpr unsigned int sum_count = OnePointBlock::n_sums, corner_count = OnePointBlock::n_nodes;

    /** The sums of the present positions. */
    __attribute__((always_inline)) inline void
    set_positions(const BlockNodes &nodes,
                  const double     *positions,
                  const double     *u,
                  Vectors (&x)[sum_count])
    {
      Lanes sums[dim][sum_count], motion[dim][sum_count] = {};
      set_sums(nodes, positions, sums);
      if (u != nullptr)
        set_sums(nodes, u, motion);
      for (unsigned int m = 0; m < sum_count; ++m)
        for (unsigned int i = 0; i < dim; ++i)
          x[m].c[i] = sums[i][m] + motion[i][m];
    }
  } // namespace



  TOUCHSTONE_VECTORISED void
  BlockKernels::set_volume_rates(const BlockNodes &nodes,
                                 const double     *positions,
                                 const double     *u,
                                 const double     *v,
                                 double           *rate,
                                 Derivatives      &derivatives)
  {
    Vectors x[sum_count], by_sums[sum_count - 1];
    Lanes   speeds[dim][sum_count], sum = {}, zero = {};
    set_positions(nodes, positions, u, x);
    const Lanes volume = volume_derivatives(x, by_sums);
    set_sums(nodes, v, speeds);
    for (unsigned int m = 0; m < sum_count - 1; ++m)
      for (unsigned int i = 0; i < dim; ++i)
        {
          sum += by_sums[m].c[i] * speeds[i][m];
          store(by_sums[m].c[i], derivatives[dim * m + i]);
        }
    // The mean of a mode is an eighth of its sum.
    store(volume > 0. ? 0.125 * sum / volume : zero, rate);
  }



  TOUCHSTONE_VECTORISED void
  BlockKernels::set_viscous_forces(const Viscosity   &viscosity,
                                   const double      *periods,
                                   const double      *rate,
                                   const Derivatives &derivatives,
                                   double (*force)[n_lanes])
  {
    const Lanes r = load(rate), pressure = 0.125 * (viscosity(r, load(periods)) * r);
    for (unsigned int i = 0; i < dim; ++i)
      {
        Lanes modes[sum_count] = {}, f[corner_count];
        for (unsigned int m = 0; m < sum_count - 1; ++m)
          modes[m] = pressure * load(derivatives[dim * m + i]);
        set_nodal_values(modes, f);
        for (unsigned int a = 0; a < corner_count; ++a)
          store(f[a], force[dim * a + i]);
      }
  }



  TOUCHSTONE_VECTORISED void
  BlockKernels::set_mobilities(const BlockNodes &nodes,
                               const double     *positions,
                               const double     *u,
                               const double (*masses)[n_lanes],
                               double *volume,
                               double (*mobility)[n_lanes])
  {
    Vectors x[sum_count], by_sums[sum_count - 1];
    set_positions(nodes, positions, u, x);
    store(volume_derivatives(x, by_sums), volume);
    Lanes b[dim][corner_count];
    for (unsigned int i = 0; i < dim; ++i)
      {
        Lanes modes[sum_count] = {};
        for (unsigned int m = 0; m < sum_count - 1; ++m)
          modes[m] = 0.125 * by_sums[m].c[i];
        set_nodal_values(modes, b[i]);
      }
    Lanes sum[2 * dim] = {};
    for (unsigned int a = 0; a < corner_count; ++a)
      {
        const Lanes inverse = 1. / load(masses[a]), x0 = inverse * b[0][a], x1 = inverse * b[1][a];
        sum[0] += x0 * b[0][a];
        sum[1] += x1 * b[1][a];
        sum[2] += inverse * b[2][a] * b[2][a];
        sum[3] += x1 * b[2][a];
        sum[4] += x0 * b[2][a];
        sum[5] += x0 * b[1][a];
      }
    for (unsigned int k = 0; k < 2 * dim; ++k)
      store(sum[k], mobility[k]);
  }



  TOUCHSTONE_VECTORISED void
  BlockKernels::set_nodal_volumes(const BlockNodes &nodes,
                                  const double     *positions,
                                  double (*volumes)[n_lanes])
  {
    // Gauss's rule of two points is exact. With the coordinates -1 to 1 a shape is an eighth of the
    // sum of the modes times their signs at its node, and a mode at a point is its sign there times
    // a power of the coordinate: sums of the determinants with these signs give all integrals.
    constexpr double g = 0.577350269189625764509149;
    Vectors          x[sum_count];
    set_positions(nodes, positions, nullptr, x);
    Lanes modes[sum_count] = {}, mean = {};
    for (unsigned int q = 0; q < corner_count; ++q)
      {
        Vectors J[dim];
        for (unsigned int d = 0; d < dim; ++d)
          {
            // Mode d is linear, dim + d and dim + f the products with the next and with the last
            // coordinate, and the last one that of all.
            const unsigned int e = (d + 1) % dim, f = (d + 2) % dim;
            const double       y = OnePointBlock::sign(e, q) * g, z = OnePointBlock::sign(f, q) * g;
            for (unsigned int i = 0; i < dim; ++i)
              J[d].c[i] =
                x[d].c[i] + y * x[dim + d].c[i] + z * x[dim + f].c[i] + (y * z) * x[2 * dim].c[i];
          }
        const Lanes determinant = dot(J[0], cross(J[1], J[2]));
        mean += determinant;
        for (unsigned int m = 0; m < sum_count; ++m)
          modes[m] += double(OnePointBlock::sign(m, q)) * determinant;
      }
    // Derivatives are an eighth of the sums, so determinants 1/512.
    constexpr double scale = 1. / (8. * 512.);
    for (unsigned int m = 0; m < sum_count; ++m)
      modes[m] *= scale * (m < dim ? g : m < 2 * dim ? g * g : g * g * g);
    Lanes values[corner_count];
    set_nodal_values(modes, values);
    for (unsigned int a = 0; a < corner_count; ++a)
      store(scale * mean + values[a], volumes[a]);
  }



  TOUCHSTONE_VECTORISED void
  BlockKernels::set_edge_rates(const BlockNodes &nodes,
                               const double     *positions,
                               const double     *u,
                               const double     *v,
                               double           *square)
  {
    Lanes x[corner_count][dim], speeds[corner_count][dim];
    for (unsigned int a = 0; a < corner_count; ++a)
      {
        Lanes motion[dim];
        gather(nodes, positions, a, x[a]);
        gather(nodes, u, a, motion);
        gather(nodes, v, a, speeds[a]);
        for (unsigned int i = 0; i < dim; ++i)
          x[a][i] += motion[i];
      }
    Lanes largest = {};
    for (unsigned int a = 0; a < corner_count; ++a)
      for (unsigned int d = 0; d < dim; ++d)
        if (const unsigned int e = a | (1U << d); e != a)
          {
            Lanes change = {}, length = {};
            for (unsigned int i = 0; i < dim; ++i)
              {
                change += (speeds[e][i] - speeds[a][i]) * (speeds[e][i] - speeds[a][i]);
                length += (x[e][i] - x[a][i]) * (x[e][i] - x[a][i]);
              }
            const Lanes rate = change / length;
            largest          = rate > largest ? rate : largest;
          }
    store(largest, square);
  }
} // namespace Touchstone
