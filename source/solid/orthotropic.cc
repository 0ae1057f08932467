// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/solid/material_law.h>
#include <touchstone/solid/material_parameters.h>
#include <touchstone/solid/own_moduli.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * @brief Linear elasticity with three planes of symmetry, for small strain: wood, layers of
     * fibres, rolled sheet.
     *
     * In the axes of the material strain_11 = s_11/E1 - nu12 s_22/E1 - nu13 s_33/E1 and so on, and
     * 2 strain_12 = s_12/G12. Lekhnitskii (1963), Theory of Elasticity of an Anisotropic Elastic
     * Body, section 6.
     */
    class Orthotropic : public SmallStrainLaw
    {
    public:
      struct Parameters : public OwnModuli
      {
        Tensor<1, dim> young{{1., 1., 1.}}, shear{{0.5, 0.5, 0.5}}, poisson;
        Tensor<1, dim> first{{1., 0., 0.}}, second{{0., 1., 0.}};

        void
        declare(ParameterHandler &prm) override
        {
          prm.add_parameter("Young moduli",
                            young,
                            "E1, E2, E3, positive. Required. [force per area]",
                            *Patterns::Tools::Convert<Tensor<1, dim>>::to_pattern(),
                            /*has_to_be_set=*/true);
          prm.add_parameter("Shear moduli",
                            shear,
                            "G12, G13, G23, positive. Required. [force per area]",
                            *Patterns::Tools::Convert<Tensor<1, dim>>::to_pattern(),
                            /*has_to_be_set=*/true);
          prm.add_parameter("Poisson ratios",
                            poisson,
                            "nu12, nu13, nu23: of a stress in the first direction named, the "
                            "shortening in the second one over the stretching in the first. [no "
                            "unit]");
          prm.add_parameter("First direction",
                            first,
                            "Direction 1 of the material, of any length, the same in the whole "
                            "body. [no unit]");
          prm.add_parameter("Second direction",
                            second,
                            "Direction 2, at a right angle to it; direction 3 is at right angles "
                            "to both. [no unit]");
        }

        void
        check(const std::string &section) const override
        {
          for (const auto &[key, values] :
               {std::make_pair("Young moduli", &young), std::make_pair("Shear moduli", &shear)})
            for (unsigned int i = 0; i < dim; ++i)
              if (!((*values)[i] > 0.))
                throw InputError(section,
                                 key,
                                 Patterns::Tools::to_string((*values)[i]),
                                 "must be positive",
                                 "give three positive moduli");
          // The leading minors of the compliance, scaled to ones on the diagonal: those of one
          // row are positive.
          const double a = poisson[0] * poisson[0] * young[1] / young[0],
                       b = poisson[1] * poisson[1] * young[2] / young[0],
                       c = poisson[2] * poisson[2] * young[2] / young[1],
                       d = 2. * poisson[0] * poisson[1] * poisson[2] * young[2] / young[0];
          if (!(1. - a > 0. && 1. - b > 0. && 1. - c > 0. && 1. - a - b - c - d > 0.))
            throw InputError(
              section,
              "Poisson ratios",
              Patterns::Tools::to_string(poisson),
              "with these 'Young moduli' some strain would have negative energy",
              "the squares nu12^2, nu13^2 and nu23^2 must be less than E1/E2, E1/E3 "
              "and E2/E3, and 1 more than nu12^2 E2/E1 + nu13^2 E3/E1 + nu23^2 E3/E2 "
              "+ 2 nu12 nu13 nu23 E3/E1; look whether they are those of the other "
              "direction, nu21 = nu12 E2/E1");
          for (const auto &[key, direction] : {std::make_pair("First direction", &first),
                                               std::make_pair("Second direction", &second)})
            if (!(direction->norm() > 0.) || !std::isfinite(direction->norm()))
              throw InputError(section,
                               key,
                               Patterns::Tools::to_string(*direction),
                               "is no direction",
                               "give three numbers that are not all zero");
          if (!(std::abs(first * second) <= 1e-6 * first.norm() * second.norm()))
            throw InputError(section,
                             "Second direction",
                             Patterns::Tools::to_string(second),
                             "is not at a right angle to 'First direction'",
                             "give the direction at a right angle, to six digits");
        }

        bool
        keeps_poisson_ratio() const override
        {
          return false;
        }

        double
        initial_shear_modulus() const override
        {
          // Isotropic with nu = 0: E = 2 G.
          return std::max(
            {0.5 * young[0], 0.5 * young[1], 0.5 * young[2], shear[0], shear[1], shear[2]});
        }
      };

      Orthotropic(const Parameters &own, const MaterialParameters &)
      {
        SymmetricTensor<2, dim> compliance;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            compliance[i][j] = (i == j ? 1. : -own.poisson[i + j - 1]) / own.young[i];
        const SymmetricTensor<2, dim> stiffness = invert(compliance);

        Tensor<1, dim> axis[dim] = {own.first / own.first.norm(), own.second};
        axis[1] -= (axis[1] * axis[0]) * axis[0];
        axis[1] /= axis[1].norm();
        axis[2] = cross_product_3d(axis[0], axis[1]);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              C += stiffness[i][j] * outer_product(symmetrize(outer_product(axis[i], axis[i])),
                                                   symmetrize(outer_product(axis[j], axis[j])));
              const auto shear = symmetrize(outer_product(axis[i], axis[j]));
              // Both orders of i and j: s_12 = 2 G12 strain_12.
              if (i != j)
                C += 2. * own.shear[i + j - 1] * outer_product(shear, shear);
            }
      }

      void
      respond(const MaterialInput &input,
              const Demand         demand,
              MaterialResponse    &response,
              double *) const override
      {
        const SymmetricTensor<2, dim> strain = symmetrize(input.deformation);
        const SymmetricTensor<2, dim> stress = C * strain;
        response.energy = response.elastic_energy = 0.5 * (stress * strain);
        response.stress                           = stress;
        if (demand == Demand::tangent)
          response.tangent = Tensor<4, dim>(C);
      }

    private:
      SymmetricTensor<4, dim> C;
    };

    const SmallStrainRegistry::Entry<Orthotropic>
      orthotropic_entry("orthotropic",
                        "linear elastic with three planes of symmetry, for small strain and small "
                        "rotations.");
  } // namespace
} // namespace Touchstone
