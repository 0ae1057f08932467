// SPDX-License-Identifier: LGPL-2.1-or-later
// A law with history that is not plasticity. Copy to source/solid/NAME.cc and change what is
// marked TODO: 'set Law = NAME' selects it, and nothing else need be edited.

#include <touchstone/base/input_error.h>
#include <touchstone/solid/material_law.h>
#include <touchstone/solid/material_parameters.h>

#include <algorithm>

namespace Touchstone
{
  namespace
  {
    using dealii::SymmetricTensor;

    /**
     * TODO: the law as formulas, and where it comes from: here the standard linear solid, a
     * spring beside a Maxwell element in shear, at small strain. With e = dev eps,
     *
     *   sigma = kappa tr eps I + 2 (1 - r) mu e + 2 r mu (e - a),   da/dt = (e - a) / tau,
     *
     * the part r of the shear modulus relaxes. Backward Euler in time:
     * a = a_n + dt/tau (e - a). Simo and Hughes (1998), Computational Inelasticity, chapter 10.
     */
    class Maxwell : public SmallStrainLaw
    {
    public:
      // TODO: keys of its own, with their units.
      struct Parameters : public PluginParameters
      {
        double tau = 1., share = 0.5;

        void
        declare(dealii::ParameterHandler &prm) override
        {
          prm.add_parameter("Relaxation time", tau, "Time constant tau, positive. [time]");
          prm.add_parameter("Relaxing share",
                            share,
                            "Part r of the shear modulus that relaxes, from 0 to 1. [no unit]");
        }

        void
        check(const std::string &section) const override
        {
          // TODO: each value that makes no sense, with what to do about it.
          if (!(tau > 0.))
            throw InputError(section,
                             "Relaxation time",
                             dealii::Patterns::Tools::to_string(tau),
                             "must be positive",
                             "give the time in which the stress falls by a factor of e");
          if (!(share >= 0. && share < 1.))
            throw InputError(section,
                             "Relaxing share",
                             dealii::Patterns::Tools::to_string(share),
                             "must be at least 0 and less than 1",
                             "what does not relax holds the shape of the body");
        }
      };

      Maxwell(const Parameters &own, const MaterialParameters &material)
        : tau(own.tau)
        , share(own.share)
        , mu(material.shear_modulus())
        , kappa(material.bulk_modulus())
      {
      }

      // TODO: how many numbers the history has, here a (six) and the dissipated energy; all
      // start from 0.
      unsigned int
      n_state() const override
      {
        return n + 1;
      }

      void
      start(double *state) const override
      {
        std::fill(state, state + n_state(), 0.);
      }

      double
      dissipation(const double *state) const override
      {
        return state[n];
      }

      void
      respond(const MaterialInput &input,
              const Demand         demand,
              MaterialResponse    &response,
              double              *present) const override
      {
        const SymmetricTensor<2, dim> strain = dealii::symmetrize(input.deformation);
        SymmetricTensor<2, dim>       old;
        for (unsigned int c = 0; c < n; ++c)
          old.access_raw_entry(c) = input.committed[c];
        // Where no time passes there is no flow.
        const double                  x      = input.step_length / tau;
        const SymmetricTensor<2, dim> e      = dealii::deviator(strain);
        const SymmetricTensor<2, dim> change = x / (1. + x) * (e - old);
        const SymmetricTensor<2, dim> a      = old + change;
        const double                  flow   = x > 0. ? share * mu / x * (change * change) : 0.;
        for (unsigned int c = 0; c < n; ++c)
          present[c] = a.access_raw_entry(c);
        present[n] = input.committed[n] + 2. * flow;

        const double dilatation = trace(strain);
        response.elastic_energy = 0.5 * kappa * dilatation * dilatation +
                                  (1. - share) * mu * (e * e) + share * mu * ((e - a) * (e - a));
        // The stress is the derivative of this.
        response.energy = response.elastic_energy + flow;
        response.stress = kappa * dilatation * dealii::unit_symmetric_tensor<dim>() +
                          2. * mu * ((1. - share) * e + share * (e - a));
        if (demand == Demand::tangent)
          response.tangent = dealii::Tensor<4, dim>(
            kappa * outer_product(dealii::unit_symmetric_tensor<dim>(),
                                  dealii::unit_symmetric_tensor<dim>()) +
            2. * mu * (1. - share + share / (1. + x)) * dealii::deviator_tensor<dim>());
      }

    private:
      static constexpr unsigned int n = SymmetricTensor<2, dim>::n_independent_components;
      const double                  tau, share, mu, kappa;
    };

    // TODO: the name that scenes use, and a sentence for the reference of keys.
    const SmallStrainRegistry::Entry<Maxwell>
      maxwell("Maxwell", "viscoelastic for small strain, a part of the shear modulus relaxes.");
  } // namespace
} // namespace Touchstone
