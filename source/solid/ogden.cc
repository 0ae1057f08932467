// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/solid/cauchy_green_law.h>
#include <touchstone/solid/material_parameters.h>
#include <touchstone/solid/own_moduli.h>
#include <touchstone/solid/principal_axes.h>
#include <touchstone/solid/volume_energy.h>

#include <cmath>
#include <vector>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** x^r [a,b], the divided difference, accurate for neighbours and equal for a = b to the
     * derivative. */
    double
    power_difference(const double a, const double b, const double r)
    {
      const double x = (b - a) / a;
      return std::pow(a, r - 1.) * (x == 0. ? r : std::expm1(r * std::log1p(x)) / x);
    }

    /**
     * @brief W = sum_p mu_p / alpha_p (l1^alpha_p + l2^alpha_p + l3^alpha_p - 3) + U(J) with the
     * principal stretches l_a of J^{-1/3} F.
     *
     * With m = alpha/2 the sum of powers is I^{-m/3} tr C^m, I = det C, and C^{m-1}, of which the
     * stress consists, has divided differences for its derivative in the frame of the eigenvectors
     * (as LogarithmicStrain). Ogden (1972), Proc. R. Soc. Lond. A 326; mu_p alpha_p > 0 for each
     * term, which makes W polyconvex for |alpha_p| >= 1 and stable in shear for all.
     */
    class Ogden : public CauchyGreenLaw
    {
    public:
      struct Parameters : public OwnModuli
      {
        std::vector<double> moduli{1.}, exponents{2.};

        void
        declare(ParameterHandler &prm) override
        {
          const Patterns::List numbers(Patterns::Double(), 1, 3);
          prm.add_parameter("Moduli",
                            moduli,
                            "mu_p of one to three terms, of the sign of their exponents; the shear "
                            "modulus is the sum of mu_p alpha_p / 2. Required. [force per area]",
                            numbers,
                            /*has_to_be_set=*/true);
          prm.add_parameter("Exponents",
                            exponents,
                            "alpha_p, as many. Required. [no unit]",
                            numbers,
                            /*has_to_be_set=*/true);
        }

        void
        check(const std::string &section) const override
        {
          if (moduli.size() != exponents.size())
            throw InputError(section,
                             "Exponents",
                             Patterns::Tools::to_string(exponents),
                             "there are " + std::to_string(exponents.size()) + " of them, but " +
                               std::to_string(moduli.size()) + " in 'Moduli'",
                             "give one exponent for each modulus");
          for (unsigned int p = 0; p < moduli.size(); ++p)
            if (!(moduli[p] * exponents[p] > 0.))
              throw InputError(section,
                               "Moduli",
                               Patterns::Tools::to_string(moduli[p]),
                               "times its exponent " + Patterns::Tools::to_string(exponents[p]) +
                                 " must be positive, or the material is not stable",
                               "give modulus and exponent of a term the same sign");
        }

        double
        initial_shear_modulus() const override
        {
          double sum = 0.;
          for (unsigned int p = 0; p < std::min(moduli.size(), exponents.size()); ++p)
            sum += 0.5 * moduli[p] * exponents[p];
          return sum;
        }
      };

      Ogden(const Parameters &own, const MaterialParameters &material)
        : moduli(own.moduli)
        , exponents(own.exponents)
        , kappa(material.bulk_modulus())
      {
      }

    protected:
      double
      value(const SymmetricTensor<2, dim> &C) const override
      {
        const auto   c   = eigenvalues(C);
        const double I   = determinant(C);
        double       sum = volume_energy(kappa, I);
        for (unsigned int p = 0; p < moduli.size(); ++p)
          for (const double one : c)
            sum += moduli[p] / exponents[p] *
                   std::expm1(0.5 * exponents[p] * std::log(one / std::cbrt(I)));
        return sum;
      }

      EnergyDerivatives
      differentiate(const SymmetricTensor<2, dim> &C, const bool with_second) const override
      {
        EnergyDerivatives              W;
        const PrincipalAxes            principal(C);
        const std::array<double, dim> &c    = principal.value;
        const Tensor<2, dim>           axes = transpose(principal.axes);
        const double                   I    = c[0] * c[1] * c[2];
        // In the frame: first derivatives are diagonal; the second ones are products of diagonals
        // and what exchanges two directions.
        double first[dim], second[dim][dim], exchange[dim][dim];
        for (unsigned int a = 0; a < dim; ++a)
          {
            const double x = c[a];
            first[a]       = 0.25 * kappa * (I - 1.) / x;
            for (unsigned int b = 0; b < dim; ++b)
              {
                const double y = c[b];
                second[a][b]   = 0.25 * kappa * I / (x * y);
                exchange[a][b] = -0.25 * kappa * (I - 1.) / (x * y);
              }
          }
        for (unsigned int p = 0; p < moduli.size(); ++p)
          {
            // k (I^{-m/3} tr C^m - 3), differentiated by C.
            const double m = 0.5 * exponents[p],
                         k = moduli[p] / exponents[p] * std::pow(I, -m / 3.);
            double sum     = 0.;
            for (const double x : c)
              sum += std::pow(x, m);
            for (unsigned int a = 0; a < dim; ++a)
              {
                const double x = c[a], own = std::pow(x, m - 1.);
                first[a] += k * m * (own - sum / (3. * x));
                for (unsigned int b = 0; b < dim; ++b)
                  {
                    const double y = c[b], other = std::pow(y, m - 1.);
                    second[a][b] += k * m * m * (sum / (9. * x * y) - (own / y + other / x) / 3.);
                    exchange[a][b] += k * m * (power_difference(x, y, m - 1.) + sum / (3. * x * y));
                  }
              }
          }
        for (unsigned int a = 0; a < dim; ++a)
          {
            const auto Na = symmetrize(outer_product(axes[a], axes[a]));
            W.first += first[a] * Na;
            for (unsigned int b = 0; with_second && b < dim; ++b)
              {
                const auto Nb  = symmetrize(outer_product(axes[b], axes[b]));
                const auto Nab = symmetrize(outer_product(axes[a], axes[b]));
                W.second +=
                  second[a][b] * outer_product(Na, Nb) + exchange[a][b] * outer_product(Nab, Nab);
              }
          }
        W.value = value(C);
        return W;
      }

    private:
      const std::vector<double> moduli, exponents;
      const double              kappa;
    };

    const HyperelasticRegistry::Entry<Ogden>
      ogden_entry("Ogden",
                  "for rubber at large strain, in principal stretches l_a of constant volume: sum "
                  "mu_p/alpha_p (l1^alpha_p + l2^alpha_p + l3^alpha_p - 3) + kappa/2 ((J^2-1)/2 - "
                  "ln J), with kappa from 'Poisson ratio'.");
  } // namespace
} // namespace Touchstone
