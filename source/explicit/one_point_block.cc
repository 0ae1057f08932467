// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/one_point_sums.h>

// The geometry of one-point cells, eight at a time (doc/explicit.md, section 5).
namespace Touchstone
{
  namespace
  {
    __attribute__((always_inline)) inline Lanes
    smaller(const Lanes &a, const Lanes &b)
    {
      return a < b ? a : b;
    }

    __attribute__((always_inline)) inline Lanes
    larger(const Lanes &a, const Lanes &b)
    {
      return a > b ? a : b;
    }
  } // namespace



  TOUCHSTONE_VECTORISED void
  OnePointBlock::reinit(const BlockNodes &nodes, const double *const field, const Control &control)
  {
    Vectors x[n_sums], derivatives[n_sums - 1];
    Lanes   sums[dim][n_sums];
    set_sums(nodes, field, sums);
    for (unsigned int m = 0; m < n_sums; ++m)
      for (unsigned int i = 0; i < dim; ++i)
        {
          x[m].c[i] = sums[i][m];
          store(sums[i][m], positions[dim * m + i]);
        }
    const Lanes V = volume_derivatives(x, derivatives), scale = 0.125 / V;
    store(V, volume);
    for (unsigned int m = 0; m < n_sums - 1; ++m)
      for (unsigned int i = 0; i < dim; ++i)
        store(scale * derivatives[m].c[i], slopes[dim * m + i]);
    // Exact for bending of a box: the normal strains of the modes with the modulus of bars. What is
    // left, warping, has the stiffness of the twist of a plate. Edges are a fourth of the sums.
    Lanes square[dim], inverse[dim], bend[dim];
    for (unsigned int i = 0; i < dim; ++i)
      {
        square[i]  = dot(x[i], x[i]);
        inverse[i] = 1. / square[i];
        bend[i]    = (control.young / 3.) * V * inverse[i];
        store(bend[i] * inverse[i], bending[i]);
      }
    const Lanes shortest = smaller(smaller(square[0], square[1]), square[2]),
                longest  = larger(larger(square[0], square[1]), square[2]),
                warp     = (4. / 3. * control.shear) * V * shortest / (longest * longest);
    for (unsigned int i = 0; i < dim; ++i)
      store(warp * inverse[i], warping[i]);
    if (control.damping == 0.)
      return;
    // The part of critical damping of the softest direction, 8 c / mass = 2 xi omega.
    const Lanes mass = control.density * V / double(n_nodes);
    for (unsigned int m = 0; m < n_modes; ++m)
      {
        Lanes softest = warps(m, 0) ? warp : part(m) * bend[0];
        for (unsigned int i = 1; i < dim; ++i)
          softest = smaller(softest, warps(m, i) ? warp : part(m) * bend[i]);
        store(0.25 * control.damping * square_root(double(n_nodes) * softest * mass), dampers[m]);
      }
  }
} // namespace Touchstone
