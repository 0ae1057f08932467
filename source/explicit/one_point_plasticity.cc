// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/lanes.h>
#include <touchstone/explicit/one_point_plasticity.h>

// Finite-strain von Mises plasticity for eight cells at once (doc/explicit.md, section 5).
namespace Touchstone
{
  namespace
  {
    /** Symmetric tensors: 11, 22, 33, 23, 13, 12. */
    struct Symmetric
    {
      Lanes c[6];
    };

    /** The product of two that commute, which is symmetric. */
    __attribute__((always_inline)) inline Symmetric
    product(const Symmetric &a, const Symmetric &b)
    {
      return {{a.c[0] * b.c[0] + a.c[5] * b.c[5] + a.c[4] * b.c[4],
               a.c[5] * b.c[5] + a.c[1] * b.c[1] + a.c[3] * b.c[3],
               a.c[4] * b.c[4] + a.c[3] * b.c[3] + a.c[2] * b.c[2],
               a.c[5] * b.c[4] + a.c[1] * b.c[3] + a.c[3] * b.c[2],
               a.c[0] * b.c[4] + a.c[5] * b.c[3] + a.c[4] * b.c[2],
               a.c[0] * b.c[5] + a.c[5] * b.c[1] + a.c[4] * b.c[3]}};
    }

    __attribute__((always_inline)) inline Symmetric
    inverse(const Symmetric &a)
    {
      Symmetric   r{{a.c[1] * a.c[2] - a.c[3] * a.c[3],
                     a.c[0] * a.c[2] - a.c[4] * a.c[4],
                     a.c[0] * a.c[1] - a.c[5] * a.c[5],
                     a.c[4] * a.c[5] - a.c[0] * a.c[3],
                     a.c[3] * a.c[5] - a.c[1] * a.c[4],
                     a.c[3] * a.c[4] - a.c[2] * a.c[5]}};
      const Lanes scale = 1. / (a.c[0] * r.c[0] + a.c[5] * r.c[5] + a.c[4] * r.c[4]);
      for (Lanes &component : r.c)
        component *= scale;
      return r;
    }

    __attribute__((always_inline)) inline Lanes
    square_norm(const Symmetric &a)
    {
      return a.c[0] * a.c[0] + a.c[1] * a.c[1] + a.c[2] * a.c[2] +
             2. * (a.c[3] * a.c[3] + a.c[4] * a.c[4] + a.c[5] * a.c[5]);
    }

    /** C = A B, [3i+j]. */
    __attribute__((always_inline)) inline void
    multiply(const Lanes (&A)[9], const Lanes (&B)[9], Lanes (&C)[9])
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          C[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
    }

    __attribute__((always_inline)) inline void
    multiply(const Symmetric &S, const Lanes (&B)[9], Lanes (&C)[9])
    {
      const Lanes A[9] = {S.c[0], S.c[5], S.c[4], S.c[5], S.c[1], S.c[3], S.c[4], S.c[3], S.c[2]};
      multiply(A, B, C);
    }

    /** Half of the logarithm of b, for |b - I| of 0.1 or less: with Z = (b-I)(b+I)^{-1} it is
     * Z + Z^3/3 + Z^5/5 + Z^7/7 up to Z^9/9. */
    __attribute__((always_inline)) inline Symmetric
    half_logarithm(const Symmetric &b)
    {
      Symmetric less(b), more(b);
      for (unsigned int k = 0; k < 3; ++k)
        {
          less.c[k] -= 1.;
          more.c[k] += 1.;
        }
      const Symmetric Z = product(less, inverse(more)), Z2 = product(Z, Z);
      Symmetric       sum;
      for (unsigned int k = 0; k < 6; ++k)
        sum.c[k] = (1. / 7.) * Z2.c[k] + (k < 3 ? 1. / 5. : 0.);
      sum = product(sum, Z2);
      for (unsigned int k = 0; k < 3; ++k)
        sum.c[k] += 1. / 3.;
      sum = product(sum, Z2);
      for (unsigned int k = 0; k < 3; ++k)
        sum.c[k] += 1.;
      return product(sum, Z);
    }

    /** exp(-A) for |A| of 0.02 or less, by its series up to A^6. */
    __attribute__((always_inline)) inline Symmetric
    exponential_of_minus(const Symmetric &A)
    {
      Symmetric sum;
      for (unsigned int k = 0; k < 6; ++k)
        sum.c[k] = A.c[k] * (-1. / 6.) + (k < 3 ? 1. : 0.);
      for (unsigned int order = 5; order > 0; --order)
        {
          sum = product(sum, A);
          for (unsigned int k = 0; k < 6; ++k)
            sum.c[k] = sum.c[k] * (-1. / order) + (k < 3 ? 1. : 0.);
        }
      return sum;
    }
  } // namespace



  TOUCHSTONE_VECTORISED
  void
  von_mises_cycle(const VonMisesConstants &constants,
                  const double (*gradient)[n_lanes],
                  double (*state)[n_lanes],
                  double (*stress)[n_lanes],
                  double *beyond)
  {
    // State: equivalent plastic strain, plastic work, inverse of F_p.
    Lanes F[9], inverse_plastic[9], F_e[9], H[9];
    for (unsigned int k = 0; k < 9; ++k)
      {
        F[k]               = load(gradient[k]) + (k % 4 == 0 ? 1. : 0.);
        inverse_plastic[k] = load(state[2 + k]);
      }
    multiply(F, inverse_plastic, F_e);
    cofactors(F, H);
    const Lanes J = F[0] * H[0] + F[1] * H[1] + F[2] * H[2];
    Symmetric   b;
    const auto  row = [&](const unsigned int i, const unsigned int j) __attribute__((always_inline))
    {
      return F_e[3 * i] * F_e[3 * j] + F_e[3 * i + 1] * F_e[3 * j + 1] +
             F_e[3 * i + 2] * F_e[3 * j + 2];
    };
    b.c[0] = row(0, 0);
    b.c[1] = row(1, 1);
    b.c[2] = row(2, 2);
    b.c[3] = row(1, 2);
    b.c[4] = row(0, 2);
    b.c[5] = row(0, 1);
    Symmetric distance(b);
    for (unsigned int k = 0; k < 3; ++k)
      distance.c[k] -= 1.;

    // Trial stress, the yield condition and its return, all coaxial with b.
    Symmetric   s        = half_logarithm(b);
    const Lanes dilation = s.c[0] + s.c[1] + s.c[2];
    for (unsigned int k = 0; k < 6; ++k)
      s.c[k] = 2. * constants.mu * (k < 3 ? s.c[k] - (1. / 3.) * dilation : s.c[k]);
    const Lanes strain = load(state[0]), equivalent = square_root(1.5 * square_norm(s)),
                yield     = constants.yield_stress + constants.hardening * strain,
                excess    = equivalent - yield;
    const Lanes zero      = {};
    const auto  flows     = excess > 1e-12 * yield;
    const Lanes increment = flows ? excess / (3. * constants.mu + constants.hardening) : zero;
    const Lanes direction = flows ? 1.5 * increment / equivalent : zero;
    Symmetric   flow;
    for (unsigned int k = 0; k < 6; ++k)
      flow.c[k] = direction * s.c[k];

    // Where the series are not exact the law itself is asked: so for numbers that are none.
    const Lanes large = square_norm(distance), fast = square_norm(flow), one = zero + 1.;
    const auto  precise = (large < 0.01) & (fast < 0.0004) & (J > 0.);
    store(precise ? zero : one, beyond);

    Symmetric tau;
    for (unsigned int k = 0; k < 6; ++k)
      tau.c[k] =
        s.c[k] - 2. * constants.mu * flow.c[k] + (k < 3 ? constants.kappa * dilation : zero);
    Lanes P[9];
    multiply(tau, H, P);
    for (unsigned int k = 0; k < 9; ++k)
      store(P[k] / J, stress[k]);

    // F_p^{-1} = F^{-1} exp(-flow) F_e.
    Lanes turned[9], back[9];
    multiply(exponential_of_minus(flow), F_e, turned);
    const Lanes transposed[9] = {H[0], H[3], H[6], H[1], H[4], H[7], H[2], H[5], H[8]};
    multiply(transposed, turned, back);
    const auto changes = precise & flows;
    for (unsigned int k = 0; k < 9; ++k)
      store(changes ? back[k] / J : inverse_plastic[k], state[2 + k]);
    store(changes ? strain + increment : strain, state[0]);
    const Lanes work = load(state[1]);
    store(changes ? work + (yield + 0.5 * constants.hardening * increment) * increment : work,
          state[1]);
  }
} // namespace Touchstone
