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
     * @brief W = -mu/2 Jm ln(1 - (I1 - 3) / Jm) + U(J) with I1 = J^{-2/3} tr C < 3 + Jm.
     *
     * The chains of the rubber are stretched out at I1 = 3 + Jm, where the stress has no bound; W
     * is not defined beyond. Gent (1996), Rubber Chem. Technol. 69.
     */
    class Gent : public EnergyLaw<Gent>
    {
    public:
      struct Parameters : public OwnModuli
      {
        double modulus = 1., locking = 10.;

        void
        declare(dealii::ParameterHandler &prm) override
        {
          prm.add_parameter("Shear modulus",
                            modulus,
                            "Shear modulus of the undeformed state, positive. Required. [force per "
                            "area]",
                            Patterns::Double(),
                            /*has_to_be_set=*/true);
          prm.add_parameter("Locking stretch",
                            locking,
                            "The stretch in uniaxial tension at constant volume that the material "
                            "cannot reach, greater than 1. Required. [no unit]",
                            Patterns::Double(),
                            /*has_to_be_set=*/true);
        }

        void
        check(const std::string &section) const override
        {
          if (!(modulus > 0.))
            throw InputError(section,
                             "Shear modulus",
                             Patterns::Tools::to_string(modulus),
                             "must be positive",
                             "give the slope of the curve of shear stress over shear at its start");
          if (!(locking > 1.) || !std::isfinite(locking))
            throw InputError(section,
                             "Locking stretch",
                             Patterns::Tools::to_string(locking),
                             "must be greater than 1",
                             "give the stretch at which the curve of uniaxial tension becomes "
                             "vertical, or take the law 'neo-Hookean', which has none");
        }

        double
        initial_shear_modulus() const override
        {
          return modulus;
        }
      };

      Gent(const Parameters &own, const MaterialParameters &material)
        : mu(own.modulus)
        , limit(own.locking * own.locking + 2. / own.locking - 3.)
        , kappa(material.bulk_modulus())
      {
      }

      bool
      admits(const dealii::Tensor<2, dim> &F) const override
      {
        const double J = dealii::determinant(F);
        return F.norm_square() / std::cbrt(J * J) - 3. < limit;
      }

      template <class Number>
      Number
      density(const SymmetricMatrix<Number> &C) const
      {
        using std::cbrt;
        using std::log;
        const Number I = determinant(C);
        const Number x = (trace(C) / cbrt(I) - 3.) / limit;
        return -0.5 * mu * limit * log(1. - x) + volume_energy(kappa, I);
      }

    private:
      /** Shear modulus, Jm, and kappa. */
      const double mu, limit, kappa;
    };

    const HyperelasticRegistry::Entry<Gent>
      gent_entry("Gent",
                 "for rubber whose chains are stretched out at a locking stretch: -mu/2 Jm ln(1 - "
                 "(I1 - 3)/Jm) + kappa/2 ((J^2-1)/2 - ln J), with kappa from 'Poisson ratio'.");
  } // namespace
} // namespace Touchstone
