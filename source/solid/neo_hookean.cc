// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/body_parameters.h>
#include <touchstone/solid/hyperelastic_law.h>

#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * @brief W = mu/2 (J^{-2/3} tr C - 3) + kappa/2 ((J^2 - 1)/2 - ln J).
     *
     * The energies of shape and of volume are separate: J^{-2/3} C has the
     * determinant 1. Simo and Hughes (1998), Computational Inelasticity, section
     * 9.2.
     */
    class NeoHookean : public HyperelasticLaw
    {
    public:
      explicit NeoHookean(const MaterialParameters &material)
        : mu(material.shear_modulus())
        , kappa(material.bulk_modulus())
      {
      }

      double
      energy(const Tensor<2, dim> &F) const override
      {
        const double J = determinant(F);
        return 0.5 * mu * (F.norm_square() / std::cbrt(J * J) - dim) +
               0.5 * kappa * (0.5 * (J * J - 1.) - std::log(J));
      }

      Tensor<2, dim>
      stress(const Tensor<2, dim> &F) const override
      {
        const double         J = determinant(F);
        const double         m = mu / std::cbrt(J * J);
        const Tensor<2, dim> H = transpose(invert(F));
        return m * F + (0.5 * kappa * (J * J - 1.) - m / 3. * F.norm_square()) * H;
      }

      Tensor<4, dim>
      tangent(const Tensor<2, dim> &F) const override
      {
        // With H = F^{-T}: dJ = J H : dF and dH_iJ = -H_iL H_kJ dF_kL.
        const double         J        = determinant(F);
        const double         m        = mu / std::cbrt(J * J);
        const double         trace    = F.norm_square();
        const Tensor<2, dim> H        = transpose(invert(F));
        const double         product  = 2. / 9. * m * trace + kappa * J * J;
        const double         exchange = m / 3. * trace - 0.5 * kappa * (J * J - 1.);
        Tensor<4, dim>       A;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              for (unsigned int k = 0; k < dim; ++k)
                for (unsigned int l = 0; l < dim; ++l)
                  A[i][j][k][l] = product * H[i][j] * H[k][l] + exchange * H[i][l] * H[k][j] -
                                  2. / 3. * m * (F[i][j] * H[k][l] + H[i][j] * F[k][l]);
              A[i][j][i][j] += m;
            }
        return A;
      }

    private:
      const double mu, kappa;
    };

    const HyperelasticRegistry::Entry<NeoHookean>
      neo_hookean_entry("neo-Hookean",
                        "for large strain, the energies of shape and volume separate: "
                        "mu/2 (J^(-2/3) tr C - 3) + kappa/2 ((J^2-1)/2 - ln J).");
  } // namespace
} // namespace Touchstone
