// SPDX-License-Identifier: LGPL-2.1-or-later
// A friction law to start from. Copy to source/contact/NAME.cc, fill in what is
// marked TODO, build: 'set Behaviour = NAME' selects it, and nothing else need
// be edited.

#include <touchstone/base/input_error.h>
#include <touchstone/contact/friction/friction_law.h>

namespace Touchstone
{
  namespace
  {
    /** TODO: the law as a formula, and where it comes from. */
    class MyFrictionLaw : public FrictionLaw
    {
    public:
      void
      declare(dealii::ParameterHandler &prm) override
      {
        // TODO: the keys of the subsection "Friction", with their unit.
        prm.add_parameter("Coefficient",
                          coefficient,
                          "Coefficient of friction, at least zero. Required. [no unit]",
                          dealii::Patterns::Double(),
                          /*has_to_be_set=*/true);
      }

      void
      check(const std::string &section) const override
      {
        // TODO: each value that makes no sense, with what to do about it.
        if (coefficient < 0.)
          throw InputError(section,
                           "Coefficient",
                           dealii::Patterns::Tools::to_string(coefficient),
                           "must not be negative",
                           "give the coefficient of friction, e.g. 0.2");
      }

      FrictionLimit
      limit(const FrictionInput &input) const override
      {
        // TODO: the radius L of the cone, a force, from the normal force, the area
        // (pressure = force / area), the length of the slip path up to the end of the step,
        // the slip rate, the time, and whether the node slips. The second number is
        // dL / d(normal force); dL / d(area), dL / d(path) and dL / d(rate) would follow: a
        // wrong one costs iterations, not accuracy.
        return {coefficient * input.normal_force, coefficient};
      }

    private:
      double coefficient = 0.;
    };

    // TODO: the name that scenes use, and a sentence for the reference of keys.
    const FrictionLawRegistry::Entry<MyFrictionLaw>
      my_friction_law("my friction law", "a constant coefficient, to start from.");
  } // namespace
} // namespace Touchstone
