// SPDX-License-Identifier: LGPL-2.1-or-later
// A hyperelastic law of two constants that gives nothing but its energy. Copy to
// source/solid/NAME.cc and change what is marked TODO: 'set Law = NAME' selects it, and
// nothing else need be edited.

#include <touchstone/base/input_error.h>
#include <touchstone/solid/energy_law.h>
#include <touchstone/solid/material_parameters.h>

#include <cmath>

namespace Touchstone
{
  namespace
  {
    /**
     * TODO: the law as a formula, and where it comes from: here
     *
     *   W = c_1 (J^{-2/3} I_1 - 3) + c_2 (J^{-4/3} I_2 - 3) + kappa/2 ((J^2 - 1)/2 - ln J)
     *
     * with the invariants I_1 = tr C, I_2 = ((tr C)^2 - tr C^2) / 2. Mooney (1940), J. Appl.
     * Phys. 11, 582-592. Young's modulus and Poisson's ratio are those of the undeformed
     * state, mu = 2 (c_1 + c_2).
     */
    class MooneyRivlin : public EnergyLaw<MooneyRivlin>
    {
    public:
      // TODO: keys of its own, with their units.
      struct Parameters : public PluginParameters
      {
        double share = 0.2;

        void
        declare(dealii::ParameterHandler &prm) override
        {
          prm.add_parameter("Second share",
                            share,
                            "c_2 / (c_1 + c_2), from 0 (neo-Hookean) to 1; rubber has 0.1 to "
                            "0.3. [no unit]");
        }

        void
        check(const std::string &section) const override
        {
          // TODO: each value that makes no sense, with what to do about it.
          if (!(share >= 0. && share <= 1.))
            throw InputError(section,
                             "Second share",
                             dealii::Patterns::Tools::to_string(share),
                             "must be from 0 to 1",
                             "give c_2 / (c_1 + c_2) of the two constants");
        }
      };

      MooneyRivlin(const Parameters &own, const MaterialParameters &material)
        : c_1(0.5 * (1. - own.share) * material.shear_modulus())
        , c_2(0.5 * own.share * material.shear_modulus())
        , kappa(material.bulk_modulus())
      {
      }

      // TODO: the energy. Number is a double or carries derivatives.
      template <class Number>
      Number
      density(const SymmetricMatrix<Number> &C) const
      {
        using std::log;
        using std::pow;
        const Number I_1 = trace(C), I_2 = 0.5 * (I_1 * I_1 - trace_of_square(C));
        const Number square = determinant(C); // J^2
        const Number scale  = pow(square, -1. / 3.);
        return c_1 * (scale * I_1 - 3.) + c_2 * (scale * scale * I_2 - 3.) +
               0.25 * kappa * (square - 1. - log(square));
      }

    private:
      const double c_1, c_2, kappa;
    };

    // TODO: the name that scenes use, and a sentence for the reference of keys.
    const HyperelasticRegistry::Entry<MooneyRivlin>
      mooney_rivlin("my Mooney-Rivlin", "for rubber at large strain, linear in both invariants.");
  } // namespace
} // namespace Touchstone
