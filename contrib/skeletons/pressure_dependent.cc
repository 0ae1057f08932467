// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/contact/friction/friction_law.h>

#include <cmath>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    /**
     * |t| <= mu(p) lambda with a coefficient that changes with the pressure
     * p = lambda / A, as that of PTFE on steel does in sliding bearings:
     *
     *   mu(p) = mu_0 - (mu_0 - mu_1) tanh(p / p_0).
     *
     * Tsopelas, Constantinou, Kim and Okamoto (1996), Earthquake Engng Struct.
     * Dyn. 25, 65-78.
     */
    class PressureDependent : public FrictionLaw
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        prm.add_parameter("Coefficient",
                          mu_0,
                          "Coefficient of friction at low pressure. Required. [no unit]",
                          Patterns::Double(),
                          /*has_to_be_set=*/true);
        prm.add_parameter("Coefficient at high pressure",
                          mu_1,
                          "Coefficient that it tends to as the pressure grows. Required. "
                          "[no unit]",
                          Patterns::Double(),
                          /*has_to_be_set=*/true);
        prm.add_parameter("Reference pressure",
                          p_0,
                          "Pressure at which three quarters of the change have happened, "
                          "greater than zero. Required. [force per area]",
                          Patterns::Double(),
                          /*has_to_be_set=*/true);
      }

      void
      check(const std::string &section) const override
      {
        for (const auto &[key, value] : {std::make_pair("Coefficient", mu_0),
                                         std::make_pair("Coefficient at high pressure", mu_1)})
          if (value < 0.)
            throw InputError(section,
                             key,
                             Patterns::Tools::to_string(value),
                             "must not be negative",
                             "give a coefficient of friction, e.g. 0.1");
        if (!(p_0 > 0.))
          throw InputError(section,
                           "Reference pressure",
                           Patterns::Tools::to_string(p_0),
                           "must be positive",
                           "give a pressure; 'coulomb' has a constant coefficient");
      }

      FrictionLimit
      limit(const FrictionInput &input) const override
      {
        const double p      = input.normal_force / input.area;
        const double tanh   = std::tanh(p / p_0);
        const double mu     = mu_0 - (mu_0 - mu_1) * tanh;
        const double dmu_dp = -(mu_0 - mu_1) * (1. - tanh * tanh) / p_0;
        // L = mu(lambda / A) lambda, dL / dlambda = mu + p mu', dL / dA = -p^2 mu'.
        return {mu * input.normal_force, mu + p * dmu_dp, -p * p * dmu_dp};
      }

    private:
      double mu_0 = 0., mu_1 = 0., p_0 = 0.;
    };

    const FrictionLawRegistry::Entry<PressureDependent>
      pressure_dependent("pressure dependent",
                         "the coefficient goes from one value to another as the pressure grows.");
  } // namespace
} // namespace Touchstone
