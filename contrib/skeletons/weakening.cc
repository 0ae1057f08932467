// SPDX-License-Identifier: LGPL-2.1-or-later
// A friction law that depends on slip, slip rate and time. Copy to source/contact/friction/
// NAME.cc and change what is marked TODO: 'set Behaviour = NAME' selects it, and nothing else
// need be edited.

#include <touchstone/base/input_error.h>
#include <touchstone/contact/friction/friction_law.h>

#include <cmath>

namespace Touchstone
{
  namespace
  {
    /**
     * TODO: the law as a formula, and where it comes from: here a coefficient that falls with
     * the slip path s and the slip rate v, and whose static part grows with the time t,
     *
     *   mu = mu_d + (mu_s (1 + b ln(1 + t/T)) - mu_d) exp(-s/D) / (1 + v/V).
     *
     * Slip weakening: Ida (1972), J. Geophys. Res. 77, 3796-3805; rate and ageing: Dieterich
     * (1979), J. Geophys. Res. 84, 2161-2168.
     */
    class Weakening : public FrictionLaw
    {
    public:
      void
      declare(dealii::ParameterHandler &prm) override
      {
        // TODO: the keys of the subsection "Friction", with their units.
        prm.add_parameter("Static coefficient", mu_s, "mu_s, at least mu_d. [no unit]");
        prm.add_parameter("Dynamic coefficient", mu_d, "mu_d, at least zero. [no unit]");
        prm.add_parameter("Slip distance", D, "D, over which it falls, positive. [length]");
        prm.add_parameter("Slip rate", V, "V, at which it has halved, positive. [length / time]");
        prm.add_parameter("Ageing", b, "b, at least zero; 0 for none. [no unit]");
        prm.add_parameter("Ageing time", T, "T, positive. [time]");
      }

      void
      check(const std::string &section) const override
      {
        // TODO: each value that makes no sense, with what to do about it.
        if (!(mu_d >= 0. && mu_s >= mu_d && b >= 0.))
          throw InputError(section,
                           "Static coefficient",
                           dealii::Patterns::Tools::to_string(mu_s),
                           "must not be less than 'Dynamic coefficient', and none be negative",
                           "this law only weakens");
        if (!(D > 0. && V > 0. && T > 0.))
          throw InputError(section,
                           "Slip distance",
                           dealii::Patterns::Tools::to_string(D),
                           "must be positive, as 'Slip rate' and 'Ageing time'",
                           "large values switch the effects off");
      }

      FrictionLimit
      limit(const FrictionInput &input) const override
      {
        // TODO: the radius of the cone at the end of the step, with its derivatives.
        const double  fall  = std::exp(-input.slip_length / D) / (1. + input.slip_rate / V);
        const double  extra = mu_s * (1. + b * std::log1p(input.time / T)) - mu_d;
        FrictionLimit result;
        result.slope      = mu_d + extra * fall;
        result.force      = result.slope * input.normal_force;
        result.slip_slope = -extra * fall / D * input.normal_force;
        result.rate_slope = -extra * fall / (V + input.slip_rate) * input.normal_force;
        return result;
      }

    private:
      double mu_s = 0.6, mu_d = 0.2, D = 1., V = 1e300, b = 0., T = 1.;
    };

    // TODO: the name that scenes use, and a sentence for the reference of keys.
    const FrictionLawRegistry::Entry<Weakening>
      weakening("weakening", "the coefficient falls with slip and slip rate, and grows with age.");
  } // namespace
} // namespace Touchstone
