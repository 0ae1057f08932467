// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/lanes.h>
#include <touchstone/explicit/one_point_kernels.h>

// Kinematics, elastic stresses and forces of one-point cells, eight at a time (doc/explicit.md,
// section 5).
namespace Touchstone
{
  namespace
  {
    constexpr unsigned int lane_count = OnePointBlock::n_cells, n_corners = OnePointBlock::n_nodes,
                           mode_count = OnePointBlock::n_modes;

    /** Component @p i of the nodes of all cells. */
    __attribute__((always_inline)) inline void
    component(const double (*field)[lane_count], const unsigned int i, Lanes (&x)[n_corners])
    {
      for (unsigned int a = 0; a < n_corners; ++a)
        x[a] = load(field[dim * a + i]);
    }

    /** The sums of the hourglass modes over the nodes. */
    __attribute__((always_inline)) inline void
    hourglass_sums(const Lanes (&x)[n_corners], Lanes (&q)[mode_count])
    {
      // Sums and differences along xi, then of those along eta and zeta.
      const Lanes d0 = x[1] - x[0], d1 = x[3] - x[2], d2 = x[5] - x[4], d3 = x[7] - x[6],
                  s0 = x[1] + x[0], s1 = x[3] + x[2], s2 = x[5] + x[4], s3 = x[7] + x[6];
      q[0] = (d1 - d0) + (d3 - d2);
      q[1] = (s3 - s2) - (s1 - s0);
      q[2] = (d2 + d3) - (d0 + d1);
      q[3] = (d3 - d2) - (d1 - d0);
    }
  } // namespace



  void
  OnePointKernels::gather(const OnePointBlock &block,
                          const double        *field,
                          double (*values)[lane_count])
  {
    for (unsigned int c = 0; c < lane_count; ++c)
      for (unsigned int a = 0; a < n_corners; ++a)
        {
          const double *const node = field + dim * block.nodes[c][a];
          for (unsigned int i = 0; i < dim; ++i)
            values[dim * a + i][c] = node[i];
        }
  }



  /** Displacement gradients, [3i+j], of eight cells. */
  TOUCHSTONE_VECTORISED void
  OnePointKernels::set_gradients(const OnePointBlock &block,
                                 const double (*u)[lane_count],
                                 double (*gradient)[lane_count])
  {
    for (unsigned int i = 0; i < dim; ++i)
      {
        Lanes x[n_corners];
        component(u, i, x);
        for (unsigned int j = 0; j < dim; ++j)
          {
            Lanes sum = x[0] * load(block.gradients[j]);
            for (unsigned int a = 1; a < n_corners; ++a)
              sum += x[a] * load(block.gradients[dim * a + j]);
            store(sum, gradient[dim * i + j]);
          }
      }
  }

  /** Forces of stress and hourglass control on the nodes, [3a+i], of eight cells. */
  TOUCHSTONE_VECTORISED void
  OnePointKernels::set_forces(const OnePointBlock &block,
                              const double (*u)[lane_count],
                              const double (*gradient)[lane_count],
                              const double (*stress)[lane_count],
                              const Hourglass control,
                              double (*force)[lane_count])
  {
    const Lanes volume = load(block.volume);
    // Amplitudes of the modes, from which what constant strain and rotation contribute is taken.
    Lanes              q[dim][mode_count], P[dim][dim];
    const unsigned int n_controlled = control == Hourglass::none ? 0 : mode_count;
    for (unsigned int i = 0; i < dim; ++i)
      {
        if (control != Hourglass::none)
          {
            Lanes x[n_corners];
            component(u, i, x);
            hourglass_sums(x, q[i]);
          }
        for (unsigned int m = 0; m < n_controlled; ++m)
          for (unsigned int j = 0; j < dim; ++j)
            q[i][m] -= load(block.warp[dim * m + j]) * load(gradient[dim * i + j]);
        for (unsigned int j = 0; j < dim; ++j)
          P[i][j] = volume * load(stress[dim * i + j]);
      }
    for (unsigned int m = 0; m < n_controlled; ++m)
      {
        if (control == Hourglass::damped)
          {
            for (unsigned int i = 0; i < dim; ++i)
              q[i][m] *= load(block.control[m]);
            continue;
          }
        // y = F^T q, and w = sum_i k_i (e_i . y) e_i.
        const bool turns = control == Hourglass::convected;
        Lanes      y[dim], w[dim] = {};
        for (unsigned int j = 0; j < dim; ++j)
          {
            y[j] = q[j][m];
            for (unsigned int i = 0; i < dim && turns; ++i)
              y[j] += load(gradient[dim * i + j]) * q[i][m];
          }
        for (unsigned int i = 0; i < dim; ++i)
          {
            const Lanes along =
              OnePointBlock::part(m) * load(block.control[OnePointBlock::warps(m, i) ? dim : i]) *
              (load(block.edges[dim * i]) * y[0] + load(block.edges[dim * i + 1]) * y[1] +
               load(block.edges[dim * i + 2]) * y[2]);
            for (unsigned int j = 0; j < dim; ++j)
              w[j] += along * load(block.edges[dim * i + j]);
          }
        // The derivatives of the energy 1/2 y . w by F and by q.
        Lanes f[dim];
        for (unsigned int i = 0; i < dim; ++i)
          {
            f[i] = w[i];
            for (unsigned int j = 0; j < dim && turns; ++j)
              {
                f[i] += load(gradient[dim * i + j]) * w[j];
                P[i][j] += q[i][m] * w[j];
              }
          }
        for (unsigned int i = 0; i < dim; ++i)
          q[i][m] = f[i];
      }
    for (unsigned int i = 0; i < dim; ++i)
      {
        for (unsigned int m = 0; m < n_controlled; ++m)
          for (unsigned int j = 0; j < dim; ++j)
            P[i][j] -= load(block.warp[dim * m + j]) * q[i][m];
        for (unsigned int a = 0; a < n_corners; ++a)
          {
            Lanes f = P[i][0] * load(block.gradients[dim * a]) +
                      P[i][1] * load(block.gradients[dim * a + 1]) +
                      P[i][2] * load(block.gradients[dim * a + 2]);
            for (unsigned int m = 0; m < n_controlled; ++m)
              f = hourglass_sign(m, a) > 0 ? f + q[i][m] : f - q[i][m];
            store(f, force[dim * a + i]);
          }
      }
  }



  TOUCHSTONE_VECTORISED void
  OnePointKernels::set_viscous_forces(const OnePointBlock &block,
                                      const double (*velocity)[lane_count],
                                      const double (*gradient)[lane_count],
                                      const Viscosity &viscosity,
                                      const double    *periods,
                                      double (*force)[lane_count])
  {
    // Nodes move the volume by J F^{-T} b_a, of the undeformed volume.
    Lanes by_nodes[dim * n_corners], J = {}, rate = {};
    J += 1.;
    if (gradient == nullptr)
      for (unsigned int k = 0; k < dim * n_corners; ++k)
        by_nodes[k] = load(block.gradients[k]);
    else
      {
        Lanes F[dim * dim], H[dim * dim];
        for (unsigned int k = 0; k < dim * dim; ++k)
          {
            F[k] = load(gradient[k]);
            if (k % (dim + 1) == 0)
              F[k] += 1.;
          }
        cofactors(F, H);
        J = F[0] * H[0] + F[1] * H[1] + F[2] * H[2];
        for (unsigned int a = 0; a < n_corners; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            by_nodes[dim * a + i] = H[dim * i] * load(block.gradients[dim * a]) +
                                    H[dim * i + 1] * load(block.gradients[dim * a + 1]) +
                                    H[dim * i + 2] * load(block.gradients[dim * a + 2]);
      }
    for (unsigned int k = 0; k < dim * n_corners; ++k)
      rate += by_nodes[k] * load(velocity[k]);
    rate /= J;
    const Lanes pressure = load(block.volume) * (viscosity(rate, load(periods)) * rate);
    for (unsigned int k = 0; k < dim * n_corners; ++k)
      store(pressure * by_nodes[k], force[k]);
  }



  TOUCHSTONE_VECTORISED void
  OnePointKernels::linear_elastic(const double lambda,
                                  const double mu,
                                  const double (*gradient)[lane_count],
                                  double (*stress)[lane_count])
  {
    const Lanes volumetric = lambda * (load(gradient[0]) + load(gradient[4]) + load(gradient[8]));
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          Lanes s = mu * (load(gradient[dim * i + j]) + load(gradient[dim * j + i]));
          if (i == j)
            s += volumetric;
          store(s, stress[dim * i + j]);
        }
  }

  /** First Piola-Kirchhoff stress, see neo_hookean.cc; @p J gets the determinants. */
  TOUCHSTONE_VECTORISED void
  OnePointKernels::neo_hookean(const double kappa,
                               const double mu,
                               const double (*gradient)[lane_count],
                               double (*stress)[lane_count],
                               double *J)
  {
    Lanes F[dim * dim], norm = {};
    for (unsigned int k = 0; k < dim * dim; ++k)
      {
        F[k] = load(gradient[k]);
        if (k % (dim + 1) == 0)
          F[k] += 1.;
        norm += F[k] * F[k];
      }
    Lanes H[dim * dim];
    cofactors(F, H);
    const Lanes det = F[0] * H[0] + F[1] * H[1] + F[2] * H[2];
    store(det, J);
    const Lanes root = inverse_cube_root(det), m = mu * root * root,
                p = (0.5 * kappa * (det * det - 1.) - m * (1. / 3.) * norm) / det;
    for (unsigned int k = 0; k < dim * dim; ++k)
      store(m * F[k] + p * H[k], stress[k]);
  }
} // namespace Touchstone
