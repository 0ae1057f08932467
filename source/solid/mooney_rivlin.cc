// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/solid/energy_law.h>
#include <touchstone/solid/material_parameters.h>
#include <touchstone/solid/own_moduli.h>
#include <touchstone/solid/volume_energy.h>

#include <cmath>

namespace Touchstone
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    /**
     * @brief W = C10 (I1 - 3) + C01 (I2 - 3) + U(J) with the invariants I1 = J^{-2/3} tr C and
     * I2 = J^{-4/3} (tr^2 C - tr C^2) / 2.
     *
     * Mooney (1940), J. Appl. Phys. 11; Rivlin (1948), Phil. Trans. R. Soc. A 241. Both constants
     * must be at least zero: with a negative one there are deformations at which the material is
     * not stable.
     */
    class MooneyRivlin : public EnergyLaw<MooneyRivlin>
    {
    public:
      struct Parameters : public OwnModuli
      {
        double c10 = 1., c01 = 0.;

        void
        declare(dealii::ParameterHandler &prm) override
        {
          prm.add_parameter("C10",
                            c10,
                            "Constant of the first invariant, at least zero. Required. [force per "
                            "area]",
                            Patterns::Double(),
                            /*has_to_be_set=*/true);
          prm.add_parameter("C01",
                            c01,
                            "Constant of the second invariant, at least zero. The shear modulus is "
                            "2 (C10 + C01). [force per area]",
                            Patterns::Double());
        }

        void
        check(const std::string &section) const override
        {
          for (const auto &[key, value] : {std::make_pair("C10", c10), std::make_pair("C01", c01)})
            if (!(value >= 0.))
              throw InputError(section,
                               key,
                               Patterns::Tools::to_string(value),
                               "must not be negative: the material would not be stable at all "
                               "deformations",
                               "fit the constants with this bound, or take the law 'Ogden'");
          if (!(c10 + c01 > 0.))
            throw InputError(section,
                             "C10",
                             Patterns::Tools::to_string(c10),
                             "'C10' and 'C01' are both zero: the material has no stiffness",
                             "give a positive constant");
        }

        double
        initial_shear_modulus() const override
        {
          return 2. * (c10 + c01);
        }
      };

      MooneyRivlin(const Parameters &own, const MaterialParameters &material)
        : c10(own.c10)
        , c01(own.c01)
        , kappa(material.bulk_modulus())
      {
      }

      template <class Number>
      Number
      density(const SymmetricMatrix<Number> &C) const
      {
        using std::cbrt;
        const Number I = determinant(C), root = cbrt(I), first = trace(C);
        const Number second = 0.5 * (first * first - trace_of_square(C));
        return c10 * (first / root - 3.) + c01 * (second / (root * root) - 3.) +
               volume_energy(kappa, I);
      }

    private:
      const double c10, c01, kappa;
    };

    const HyperelasticRegistry::Entry<MooneyRivlin>
      mooney_rivlin_entry("Mooney-Rivlin",
                          "for rubber at large strain: C10 (I1 - 3) + C01 (I2 - 3) + kappa/2 "
                          "((J^2-1)/2 - ln J), with kappa from 'Poisson ratio'.");
  } // namespace
} // namespace Touchstone
