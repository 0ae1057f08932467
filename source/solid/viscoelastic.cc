// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/solid/material_law.h>
#include <touchstone/solid/material_parameters.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

// Linear viscoelasticity (doc/materials.md, "Viscoelasticity").
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_components = SymmetricTensor<2, dim>::n_independent_components;

    /** Integrals over a step of length h of one Maxwell element, x = h / tau. */
    struct Relaxation
    {
      /** exp(-x); the response to a unit ramp at its end, (1 - exp(-x)) / x; and means over the
       * step of the square of exp(-t/tau), of its product with that response, and of the square of
       * the response. */
      double decay, ramp, own, mixed, driven;

      explicit Relaxation(const double x)
        : decay(std::exp(-x))
        , ramp(x > 0. ? -std::expm1(-x) / x : 1.)
        , own(x > 0. ? -0.5 * std::expm1(-2. * x) / x : 1.)
        , mixed(0.5 * ramp * ramp)
      {
        // (x - 2 (1 - e^-x) + (1 - e^-2x) / 2) / x^3 cancels for small x: there, the series.
        if (x > 0.5)
          driven = (x + 2. * std::expm1(-x) - 0.5 * std::expm1(-2. * x)) / (x * x * x);
        else
          {
            double power = -1. / 6., two = 4.;
            driven = 0.;
            for (unsigned int n = 3; n < 24; ++n)
              {
                driven += power * (2. - two);
                power *= -x / (n + 1.);
                two *= 2.;
              }
          }
      }
    };

    /**
     * @brief Generalised Maxwell solid for small strain: shear and bulk modulus relax by
     *
     *   G(t) = G0 (1 - sum_i g_i (1 - exp(-t / tau_i))),  K(t) with k_i in the same way.
     *
     * The stresses of the elements follow the strain exactly if that is linear within the step, for
     * steps of any size. Taylor, Pister and Goudreau (1970), Int. J. Numer. Meth. Engng 2; Simo and
     * Hughes (1998), Computational Inelasticity, section 10.3.
     *
     * State: dissipated energy, strain, and for each element its deviatoric stress and pressure as
     * one tensor.
     */
    class Viscoelastic : public SmallStrainLaw
    {
    public:
      struct Parameters : public PluginParameters
      {
        std::vector<double> times{1.}, shear{0.}, bulk;

        void
        declare(ParameterHandler &prm) override
        {
          const Patterns::List numbers(Patterns::Double(), 1, 100);
          prm.add_parameter("Relaxation times",
                            times,
                            "tau_i of the terms of the Prony series, positive. Required. [time]",
                            numbers,
                            /*has_to_be_set=*/true);
          prm.add_parameter("Shear ratios",
                            shear,
                            "g_i: the part of the shear modulus that relaxes with tau_i, at least "
                            "0 and less than 1 in all. 'Young modulus' and 'Poisson ratio' are "
                            "those before anything relaxes. Required. [no unit]",
                            numbers,
                            /*has_to_be_set=*/true);
          prm.add_parameter("Bulk ratios",
                            bulk,
                            "k_i: the same of the bulk modulus; empty: it does not relax. [no "
                            "unit]",
                            Patterns::List(Patterns::Double(), 0, 100));
        }

        void
        check(const std::string &section) const override
        {
          for (const double tau : times)
            if (!(tau > 0.) || !std::isfinite(tau))
              throw InputError(section,
                               "Relaxation times",
                               Patterns::Tools::to_string(tau),
                               "must be positive",
                               "give the times after which 1/e of each term is left");
          for (const auto &[key, ratios] :
               {std::make_pair("Shear ratios", &shear), std::make_pair("Bulk ratios", &bulk)})
            {
              if (ratios->size() != times.size() && !(ratios == &bulk && bulk.empty()))
                throw InputError(section,
                                 key,
                                 Patterns::Tools::to_string(*ratios),
                                 "there are " + std::to_string(ratios->size()) + " of them, but " +
                                   std::to_string(times.size()) + " in 'Relaxation times'",
                                 "give one number for each time; 0 for none");
              for (const double ratio : *ratios)
                if (!(ratio >= 0.))
                  throw InputError(section,
                                   key,
                                   Patterns::Tools::to_string(ratio),
                                   "must not be negative: the material would give energy away",
                                   "fit the series with this bound");
              if (!(std::accumulate(ratios->begin(), ratios->end(), 0.) < 1.))
                throw InputError(section,
                                 key,
                                 Patterns::Tools::to_string(*ratios),
                                 "are 1 or more in all: nothing would be left of the stiffness",
                                 "give ratios whose sum is less than 1");
            }
        }
      };

      Viscoelastic(const Parameters &own, const MaterialParameters &material)
        : own(own)
        , mu(material.shear_modulus())
        , kappa(material.bulk_modulus())
      {
        this->own.bulk.resize(own.times.size());
        this->own.shear.resize(own.times.size());
      }

      unsigned int
      n_state() const override
      {
        return 1 + n_components * (1 + own.times.size());
      }

      void
      start(double *state) const override
      {
        std::fill(state, state + n_state(), 0.);
      }

      double
      dissipation(const double *state) const override
      {
        return state[0];
      }

      void
      respond(const MaterialInput &input,
              const Demand         demand,
              MaterialResponse    &response,
              double              *present) const override
      {
        const SymmetricTensor<2, dim> strain = symmetrize(input.deformation);
        const double                 *before = input.committed;
        const SymmetricTensor<2, dim> change = strain - tensor(before + 1);
        write(strain, present + 1);

        double g = 1., k = 1., dissipated = 0.;
        for (unsigned int i = 0; i < own.times.size(); ++i)
          {
            g -= own.shear[i];
            k -= own.bulk[i];
          }
        // What is not relaxed in the end, then each element by its stress at the last step.
        SymmetricTensor<2, dim> stress = elastic(g, k, strain);
        double                  energy = 0.5 * (stress * strain), potential = energy;
        for (unsigned int i = 0; i < own.times.size(); ++i)
          {
            const double                  tau = own.times[i];
            const Relaxation              step(input.step_length / tau);
            const SymmetricTensor<2, dim> old    = tensor(before + 1 + n_components * (i + 1));
            const SymmetricTensor<2, dim> driven = elastic(own.shear[i], own.bulk[i], change);
            const SymmetricTensor<2, dim> now    = step.decay * old + step.ramp * driven;
            write(now, present + 1 + n_components * (i + 1));
            stress += now;
            potential += step.decay * (old * change) + 0.5 * step.ramp * (driven * change);
            energy += stored(i, now, now);
            dissipated +=
              2. * input.step_length / tau *
              (step.own * stored(i, old, old) + 2. * step.mixed * stored(i, old, driven) +
               step.driven * stored(i, driven, driven));
            g += step.ramp * own.shear[i];
            k += step.ramp * own.bulk[i];
          }
        present[0]              = before[0] + dissipated;
        response.energy         = potential;
        response.elastic_energy = energy;
        response.stress         = stress;
        if (demand == Demand::tangent)
          response.tangent = Tensor<4, dim>(
            (k * kappa - 2. / 3. * g * mu) *
              outer_product(unit_symmetric_tensor<dim>(), unit_symmetric_tensor<dim>()) +
            2. * g * mu * identity_tensor<dim>());
      }

    private:
      Parameters   own;
      const double mu, kappa;

      /** Stress of the parts @p g and @p k of the moduli. */
      SymmetricTensor<2, dim>
      elastic(const double g, const double k, const SymmetricTensor<2, dim> &strain) const
      {
        return 2. * g * mu * deviator(strain) +
               k * kappa * trace(strain) * unit_symmetric_tensor<dim>();
      }

      /** Half the product of stress @p a of element @p i with the elastic strain of its stress
       * @p b. */
      double
      stored(const unsigned int             i,
             const SymmetricTensor<2, dim> &a,
             const SymmetricTensor<2, dim> &b) const
      {
        double sum = 0.;
        if (own.shear[i] > 0.)
          sum += deviator(a) * deviator(b) / (4. * own.shear[i] * mu);
        if (own.bulk[i] > 0.)
          sum += trace(a) * trace(b) / (18. * own.bulk[i] * kappa);
        return sum;
      }

      static SymmetricTensor<2, dim>
      tensor(const double *values)
      {
        SymmetricTensor<2, dim> result;
        for (unsigned int c = 0; c < n_components; ++c)
          result.access_raw_entry(c) = values[c];
        return result;
      }

      static void
      write(const SymmetricTensor<2, dim> &tensor, double *values)
      {
        for (unsigned int c = 0; c < n_components; ++c)
          values[c] = tensor.access_raw_entry(c);
      }
    };

    const SmallStrainRegistry::Entry<Viscoelastic>
      viscoelastic_entry("viscoelastic",
                         "linear viscoelastic for small strain and small rotations: moduli that "
                         "relax in time by a Prony series.");
  } // namespace
} // namespace Touchstone
