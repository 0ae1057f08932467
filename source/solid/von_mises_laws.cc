// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/vectorised.h>
#include <touchstone/solid/body_parameters.h>
#include <touchstone/solid/logarithmic_strain.h>
#include <touchstone/solid/material_law.h>
#include <touchstone/solid/von_mises.h>

#include <algorithm>
#include <array>
#include <cmath>

// The two registered von Mises laws, small and finite strain: they keep the history of a point in
// a flat array of numbers, prepare the trial elastic strain, call VonMises for the return
// mapping, and transform stress and tangent to what the kernels ask for.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_independent = SymmetricTensor<2, dim>::n_independent_components;

    SymmetricTensor<2, dim>
    read(const double *values)
    {
      SymmetricTensor<2, dim> result;
      for (unsigned int c = 0; c < n_independent; ++c)
        result.access_raw_entry(c) = values[c];
      return result;
    }

    void
    write(const SymmetricTensor<2, dim> &tensor, double *values)
    {
      for (unsigned int c = 0; c < n_independent; ++c)
        values[c] = tensor.access_raw_entry(c);
    }

    /** The state: equivalent plastic strain and plastic work per reference volume, the
     * numbers of the law, and the back stress if there is one. */
    constexpr unsigned int at_strain = 0, at_work = 1, own = 2;

    /** Nine numbers and what fills vectors of four. */
    constexpr unsigned int width = 12;

    /** result += C^T L C with the columns C of the components of a tensor, 3i+j. */
    TOUCHSTONE_VECTORISED void
    add_congruence(const double (&change)[n_independent][width],
                   const double (&moduli)[n_independent][n_independent],
                   double (&result)[dim * dim][width])
    {
      for (unsigned int m = 0; m < n_independent; ++m)
        {
          double row[width] = {};
          for (unsigned int n = 0; n < n_independent; ++n)
            for (unsigned int s = 0; s < width; ++s)
              row[s] += moduli[m][n] * change[n][s];
          for (unsigned int r = 0; r < dim * dim; ++r)
            for (unsigned int s = 0; s < width; ++s)
              result[r][s] += change[m][r] * row[s];
        }
    }

    /** Copy energies and the scalar history. */
    void
    keep(const ReturnMapping &point,
         const double        *committed,
         MaterialResponse    &response,
         double              *present)
    {
      response.solved         = point.solved;
      response.energy         = point.elastic_energy + point.plastic_work;
      response.elastic_energy = point.elastic_energy;
      present[at_strain]      = point.plastic_strain;
      present[at_work]        = committed[at_work] + point.plastic_work;
    }



    /** What both laws have in common: the scalar history. */
    template <class Law>
    class PlasticLaw : public Law
    {
    public:
      double
      dissipation(const double *state) const override
      {
        return state[at_work];
      }

      bool
      plastic() const override
      {
        return true;
      }

      double
      plastic_strain(const double *state) const override
      {
        return state[at_strain];
      }
    };



    /** State: plastic strain tensor. */
    class SmallStrainVonMises : public PlasticLaw<SmallStrainLaw>
    {
    public:
      explicit SmallStrainVonMises(const MaterialParameters &material)
        : von_mises(material)
      {
      }

      unsigned int
      n_state() const override
      {
        return own + n_independent * (von_mises.kinematic() ? 2 : 1);
      }

      void
      start(double *state) const override
      {
        std::fill(state, state + n_state(), 0.);
      }

      bool
      symmetric() const override
      {
        return von_mises.symmetric();
      }

      void
      respond(const MaterialInput &input,
              const Demand         demand,
              MaterialResponse    &response,
              double              *present) const override
      {
        const double                 *committed = input.committed;
        const SymmetricTensor<2, dim> strain    = symmetrize(input.deformation);
        const SymmetricTensor<2, dim> plastic   = read(committed + own);
        SymmetricTensor<2, dim>       back_stress;
        if (von_mises.kinematic())
          back_stress = read(committed + own + n_independent);
        const ReturnMapping point = von_mises.respond(strain - plastic,
                                                      committed[at_strain],
                                                      back_stress,
                                                      demand == Demand::tangent);
        keep(point, committed, response, present);
        write(plastic + point.plastic_increment, present + own);
        if (von_mises.kinematic())
          write(point.back_stress, present + own + n_independent);
        response.stress = point.stress;
        if (demand == Demand::tangent)
          response.tangent = Tensor<4, dim>(point.tangent);
      }

    private:
      const VonMises von_mises;
    };



    /**
     * @brief Multiplicative plasticity F = F_e F_p in logarithmic elastic strain.
     *
     * State: the inverse of F_p, det F_p = 1. With the trial elastic deformation
     * F_e = F F_p^{-1} (F_p of the last step) and E = 1/2 ln F_e^T F_e the step is the
     * return mapping of small strain with E for the trial strain, and F_p follows by the
     * exponential map: without kinematic hardening this is the algorithm in principal
     * strains of Simo (1992), Comput. Methods Appl. Mech. Engng 99; de Souza Neto, Peric
     * and Owen (2008), chapter 14. The back stress lives in the intermediate configuration,
     * as in Eterovic and Bathe (1990), Int. J. Numer. Meth. Engng 30, so the law is
     * objective; that the plastic spin vanishes and elastic strains are small is their
     * assumption for kinematic hardening.
     *
     * The stress is the derivative of the energy of the step by F, T : dE/dF with T the
     * stress conjugate to E, so the tangent is symmetric wherever the return mapping is.
     */
    class FiniteStrainVonMises : public PlasticLaw<FiniteStrainLaw>
    {
    public:
      explicit FiniteStrainVonMises(const MaterialParameters &material)
        : von_mises(material)
      {
      }

      unsigned int
      n_state() const override
      {
        return own + dim * dim + (von_mises.kinematic() ? n_independent : 0);
      }

      void
      start(double *state) const override
      {
        std::fill(state, state + n_state(), 0.);
        for (unsigned int d = 0; d < dim; ++d)
          state[own + dim * d + d] = 1.;
      }

      void
      restore(double *state) const override
      {
        Tensor<2, dim> inverse = plastic_inverse(state);
        inverse /= std::cbrt(determinant(inverse));
        write_inverse(inverse, state);
      }

      bool
      symmetric() const override
      {
        return von_mises.symmetric();
      }

      void
      respond(const MaterialInput &input,
              const Demand         demand,
              MaterialResponse    &response,
              double              *present) const override
      {
        // All is done in the frame of the eigenvectors of C_e, in which the trial strain is
        // diagonal and the derivatives of the logarithm are products of components.
        const double           *committed = input.committed;
        const Tensor<2, dim>    inverse   = plastic_inverse(committed);
        const Tensor<2, dim>    F_e       = input.deformation * inverse;
        const LogarithmicStrain logarithm(symmetrize(transpose(F_e) * F_e));
        const Tensor<2, dim>   &axes = logarithm.axes();
        SymmetricTensor<2, dim> back_stress;
        if (von_mises.kinematic())
          back_stress = symmetrize(transpose(axes) *
                                   (Tensor<2, dim>(read(committed + own + dim * dim)) * axes));
        const ReturnMapping point = von_mises.respond(logarithm.strain(),
                                                      committed[at_strain],
                                                      back_stress,
                                                      demand == Demand::tangent);
        keep(point, committed, response, present);
        // F_p^{-1}, from the frame to the reference configuration.
        const Tensor<2, dim> pulled = inverse * axes;
        // F_e at the end is R exp(E_e) with the rotation R of the trial, so that the elastic
        // strain, evaluated anew after the step, is that of the return mapping. Where both
        // strains are coaxial this is the exponential map, exp(dE_p) F_p.
        if (point.increment > 0.)
          {
            const std::array<double, dim> stretch = logarithm.inverse_stretch();
            Tensor<2, dim>                trial   = pulled;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int a = 0; a < dim; ++a)
                trial[i][a] *= stretch[a];
            write_inverse(trial * Tensor<2, dim>(exponential(point.elastic_strain)) *
                            transpose(axes),
                          present);
          }
        else
          write_inverse(inverse, present);
        if (von_mises.kinematic())
          write(symmetrize(axes * Tensor<2, dim>(point.back_stress) * transpose(axes)),
                present + own + dim * dim);
        if (demand == Demand::energy)
          return;

        // P = F_e S F_p^{-T} with S = 2 DE T.
        const Tensor<2, dim> pushed = F_e * axes;
        const Tensor<2, dim> S(logarithm.conjugate_stress(point.stress));
        response.stress = pushed * S * transpose(pulled);
        if (demand == Demand::tangent)
          set_tangent(pushed,
                      pulled,
                      pulled * S * transpose(pulled),
                      logarithm.conjugate_tangent(point.stress, point.tangent),
                      response.tangent);
      }

    private:
      const VonMises von_mises;

      /** A_iJkL = delta_ik S_JL + f_ia p_Jb L_abcd f_kc p_Ld with f = F_e and p = F_p^{-1} from the
       * frame of the eigenvectors, S in the reference configuration and L the derivative of the
       * stress conjugate to C_e / 2. */
      static void
      set_tangent(const Tensor<2, dim>          &f,
                  const Tensor<2, dim>          &p,
                  const Tensor<2, dim>          &S,
                  const SymmetricTensor<4, dim> &L,
                  Tensor<4, dim>                &A)
      {
        // The change of C_e / 2 with F, both orders of a pair of indices together; by columns, as
        // add_congruence() wants it, which adds to numbers beyond the nine as well.
        constexpr unsigned int n_pairs                = n_independent;
        double                 change[n_pairs][width] = {}, result[dim * dim][width] = {};
        double                 moduli[n_pairs][n_pairs];
        for (unsigned int m = 0; m < n_pairs; ++m)
          {
            const TableIndices<2> pair = SymmetricTensor<2, dim>::unrolled_to_component_indices(m);
            const unsigned int    a = pair[0], b = pair[1];
            for (unsigned int n = 0; n < n_pairs; ++n)
              {
                const TableIndices<2> other =
                  SymmetricTensor<2, dim>::unrolled_to_component_indices(n);
                moduli[m][n] = L[a][b][other[0]][other[1]];
              }
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int J = 0; J < dim; ++J)
                change[m][dim * i + J] =
                  a == b ? f[i][a] * p[J][a] : f[i][a] * p[J][b] + f[i][b] * p[J][a];
          }
        add_congruence(change, moduli, result);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int J = 0; J < dim; ++J)
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int l = 0; l < dim; ++l)
                A[i][J][k][l] = result[dim * i + J][dim * k + l] + (i == k ? S[J][l] : 0.);
      }

      static Tensor<2, dim>
      plastic_inverse(const double *state)
      {
        Tensor<2, dim> result;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            result[i][j] = state[own + dim * i + j];
        return result;
      }

      static void
      write_inverse(const Tensor<2, dim> &inverse, double *state)
      {
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            state[own + dim * i + j] = inverse[i][j];
      }
    };

    const SmallStrainRegistry::Entry<SmallStrainVonMises>
      small("small-strain von Mises",
            "elastoplastic for small strain and small rotations, J2 flow with hardening.");
    const FiniteStrainRegistry::Entry<FiniteStrainVonMises>
      finite("finite-strain von Mises",
             "elastoplastic for large strain, multiplicative, J2 flow with hardening in "
             "logarithmic elastic strain.");
  } // namespace
} // namespace Touchstone
