// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/contact/friction/friction_law.h>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    /** |t| <= mu lambda, with mu_s while sticking and mu while slipping. */
    class Coulomb : public FrictionLaw
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        prm.add_parameter("Coefficient",
                          coefficient,
                          "Coefficient of friction, at least zero. Required. [no unit]",
                          Patterns::Double(),
                          /*has_to_be_set=*/true);
        prm.add_parameter("Static coefficient",
                          static_coefficient,
                          "Coefficient for nodes that stick, at least 'Coefficient'; 0 takes "
                          "the same. [no unit]",
                          Patterns::Double());
      }

      void
      check(const std::string &section) const override
      {
        if (coefficient < 0.)
          throw InputError(section,
                           "Coefficient",
                           Patterns::Tools::to_string(coefficient),
                           "must not be negative",
                           "give the coefficient of friction, e.g. 0.2");
        if (static_coefficient != 0. && static_coefficient < coefficient)
          throw InputError(section,
                           "Static coefficient",
                           Patterns::Tools::to_string(static_coefficient),
                           "must not be smaller than 'Coefficient', which holds during slip",
                           "remove the key to use the same coefficient for both");
      }

      FrictionLimit
      limit(const FrictionInput &input) const override
      {
        // The higher coefficient holds while the node sticks, that of slip from then on,
        // doc/theory.md 6.1, equation (15); the key 0 stands for no distinction.
        const double mu =
          input.sliding || static_coefficient == 0. ? coefficient : static_coefficient;
        // Limit and its derivative with respect to the normal force.
        return {mu * input.normal_force, mu};
      }

    private:
      double coefficient = 0., static_coefficient = 0.;
    };

    const FrictionLawRegistry::Entry<Coulomb>
      coulomb_entry("coulomb",
                    "the tangential force is at most a coefficient times the normal force.");
  } // namespace
} // namespace Touchstone
