// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/body_parameters.h>
#include <touchstone/solid/hyperelastic_law.h>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * @brief W = lambda/2 (tr E)^2 + mu E : E with the Green-Lagrange strain
     * E = (F^T F - I) / 2.
     *
     * For large rotations and displacements with small strain: it softens in
     * compression and does not resist being squeezed to nothing. Holzapfel
     * (2000), Nonlinear Solid Mechanics, section 6.5.
     */
    class StVenantKirchhoff : public HyperelasticLaw
    {
    public:
      explicit StVenantKirchhoff(const MaterialParameters &material)
        : mu(material.shear_modulus())
        , lambda(material.bulk_modulus() - 2. / 3. * mu)
      {
      }

      double
      energy(const Tensor<2, dim> &F) const override
      {
        const Tensor<2, dim> E = strain(F);
        return 0.5 * lambda * trace(E) * trace(E) + mu * E.norm_square();
      }

      Tensor<2, dim>
      stress(const Tensor<2, dim> &F) const override
      {
        return F * second_stress(F);
      }

      Tensor<4, dim>
      tangent(const Tensor<2, dim> &F) const override
      {
        // P = F S: material part F C F from the derivative of S, isotropic elasticity in E, and
        // the geometric part S.
        const Tensor<2, dim> S = second_stress(F);
        const Tensor<2, dim> b = F * transpose(F);
        Tensor<4, dim>       A;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              for (unsigned int k = 0; k < dim; ++k)
                for (unsigned int l = 0; l < dim; ++l)
                  A[i][j][k][l] = lambda * F[i][j] * F[k][l] + mu * F[i][l] * F[k][j];
              for (unsigned int k = 0; k < dim; ++k)
                {
                  A[i][j][k][j] += mu * b[i][k];
                  A[i][j][i][k] += S[j][k];
                }
            }
        return A;
      }

    private:
      const double mu, lambda;

      static Tensor<2, dim>
      strain(const Tensor<2, dim> &F)
      {
        Tensor<2, dim> E = 0.5 * (transpose(F) * F);
        for (unsigned int d = 0; d < dim; ++d)
          E[d][d] -= 0.5;
        return E;
      }

      Tensor<2, dim>
      second_stress(const Tensor<2, dim> &F) const
      {
        const Tensor<2, dim> E = strain(F);
        Tensor<2, dim>       S = 2. * mu * E;
        for (unsigned int d = 0; d < dim; ++d)
          S[d][d] += lambda * trace(E);
        return S;
      }
    };

    const HyperelasticRegistry::Entry<StVenantKirchhoff> st_venant_kirchhoff_entry(
      "St. Venant-Kirchhoff",
      "for large rotations with small strain: lambda/2 (tr E)^2 + mu E:E with the "
      "Green-Lagrange strain E.");
  } // namespace
} // namespace Touchstone
