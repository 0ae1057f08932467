// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/one_point_kernels.h>
#include <touchstone/explicit/one_point_sums.h>

// Kinematics, elastic stresses and forces of one-point cells, eight at a time (doc/explicit.md,
// section 5).
namespace Touchstone
{
  namespace
  {
    constexpr unsigned int lane_count = OnePointBlock::n_cells, n_corners = OnePointBlock::n_nodes,
                           mode_count = OnePointBlock::n_modes, sum_count = OnePointBlock::n_sums;

    /** F and its cofactors by the displacement gradient. */
    __attribute__((always_inline)) inline void
    deformation(const double (*gradient)[lane_count], Lanes (&F)[dim * dim], Lanes (&H)[dim * dim])
    {
      for (unsigned int k = 0; k < dim * dim; ++k)
        {
          F[k] = load(gradient[k]);
          if (k % (dim + 1) == 0)
            F[k] += 1.;
        }
      cofactors(F, H);
    }
  } // namespace



  TOUCHSTONE_VECTORISED void
  OnePointKernels::set_gradients(const BlockNodes    &nodes,
                                 const OnePointBlock &block,
                                 const double        *field,
                                 double (*sums)[lane_count],
                                 double (*gradient)[lane_count])
  {
    Lanes x[dim][sum_count];
    set_sums(nodes, field, x);
    for (unsigned int i = 0; i < dim; ++i)
      {
        for (unsigned int m = 0; m < sum_count; ++m)
          store(x[i][m], sums[dim * m + i]);
        for (unsigned int j = 0; j < dim; ++j)
          {
            Lanes sum = x[i][0] * load(block.slopes[j]);
            for (unsigned int m = 1; m < sum_count - 1; ++m)
              sum += x[i][m] * load(block.slopes[dim * m + j]);
            store(sum, gradient[dim * i + j]);
          }
      }
  }

  /** Forces of stress and hourglass control on the nodes, [3a+i], of eight cells. */
  TOUCHSTONE_VECTORISED void
  OnePointKernels::set_forces(const OnePointBlock &block,
                              const double (*sums)[lane_count],
                              const double (*gradient)[lane_count],
                              const double (*stress)[lane_count],
                              const Hourglass control,
                              double (*force)[lane_count])
  {
    const Lanes volume = load(block.volume);
    // Amplitudes of the modes, from which what constant strain and rotation contribute is taken.
    Lanes              q[dim][mode_count] = {}, P[dim][dim];
    const unsigned int n_controlled       = control == Hourglass::none ? 0 : mode_count;
    for (unsigned int i = 0; i < dim; ++i)
      {
        for (unsigned int m = 0; m < n_controlled; ++m)
          {
            q[i][m] = load(sums[dim * (dim + m) + i]);
            for (unsigned int j = 0; j < dim; ++j)
              q[i][m] -= load(block.positions[dim * (dim + m) + j]) * load(gradient[dim * i + j]);
          }
        for (unsigned int j = 0; j < dim; ++j)
          P[i][j] = volume * load(stress[dim * i + j]);
      }
    for (unsigned int m = 0; m < n_controlled; ++m)
      {
        if (control == Hourglass::damped)
          {
            for (unsigned int i = 0; i < dim; ++i)
              q[i][m] *= load(block.dampers[m]);
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
            const Lanes e0    = load(block.positions[dim * i]),
                        e1    = load(block.positions[dim * i + 1]),
                        e2    = load(block.positions[dim * i + 2]),
                        along = (OnePointBlock::warps(m, i)
                                   ? load(block.warping[i])
                                   : OnePointBlock::part(m) * load(block.bending[i])) *
                                (e0 * y[0] + e1 * y[1] + e2 * y[2]);
            w[0] += along * e0;
            w[1] += along * e1;
            w[2] += along * e2;
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
            P[i][j] -= load(block.positions[dim * (dim + m) + j]) * q[i][m];
        Lanes of_modes[sum_count], f[n_corners];
        for (unsigned int m = 0; m < sum_count; ++m)
          {
            of_modes[m] = m < dim ? Lanes{} : q[i][m - dim];
            for (unsigned int j = 0; j < dim && m < sum_count - 1; ++j)
              of_modes[m] += P[i][j] * load(block.slopes[dim * m + j]);
          }
        set_nodal_values(of_modes, f);
        for (unsigned int a = 0; a < n_corners; ++a)
          store(f[a], force[dim * a + i]);
      }
  }



  TOUCHSTONE_VECTORISED void
  OnePointKernels::set_volume_rates(const double (*rates)[lane_count],
                                    const double (*gradient)[lane_count],
                                    double *rate,
                                    double (*derivatives)[lane_count])
  {
    Lanes F[dim * dim], H[dim * dim] = {}, J = {}, sum = {};
    for (unsigned int i = 0; i < dim; ++i)
      H[(dim + 1) * i] += 1.;
    J += 1.;
    if (gradient != nullptr)
      {
        deformation(gradient, F, H);
        J = F[0] * H[0] + F[1] * H[1] + F[2] * H[2];
      }
    for (unsigned int k = 0; k < dim * dim; ++k)
      {
        sum += H[k] * load(rates[k]);
        store(H[k], derivatives[k]);
      }
    store(sum / J, rate);
  }



  TOUCHSTONE_VECTORISED void
  OnePointKernels::set_viscous_stress(const Viscosity &viscosity,
                                      const double    *periods,
                                      const double    *rate,
                                      double (*derivatives)[lane_count])
  {
    const Lanes r = load(rate), pressure = viscosity(r, load(periods)) * r;
    for (unsigned int k = 0; k < dim * dim; ++k)
      store(pressure * load(derivatives[k]), derivatives[k]);
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
    Lanes F[dim * dim], H[dim * dim], norm = {};
    deformation(gradient, F, H);
    for (const Lanes &component : F)
      norm += component * component;
    const Lanes det = F[0] * H[0] + F[1] * H[1] + F[2] * H[2];
    store(det, J);
    const Lanes root = inverse_cube_root(det), m = mu * root * root,
                p = (0.5 * kappa * (det * det - 1.) - m * (1. / 3.) * norm) / det;
    for (unsigned int k = 0; k < dim * dim; ++k)
      store(m * F[k] + p * H[k], stress[k]);
  }
} // namespace Touchstone
