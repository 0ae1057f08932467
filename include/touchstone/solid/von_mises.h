// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_von_mises_h
#define touchstone_solid_von_mises_h

#include <touchstone/base/types.h>
#include <touchstone/solid/hardening_law.h>

#include <deal.II/base/symmetric_tensor.h>

#include <memory>

namespace Touchstone
{
  struct MaterialParameters;

  /** @brief A step of plastic flow at a point. */
  struct ReturnMapping
  {
    /** Stress, its elastic strain, and the derivative of the stress by the trial strain. */
    dealii::SymmetricTensor<2, dim> stress, elastic_strain, plastic_increment, back_stress;
    dealii::SymmetricTensor<4, dim> tangent;
    /** Equivalent plastic strain at the end, and its increment. */
    double plastic_strain, increment;
    /** Energies per volume: elastic, and the plastic work of the step. */
    double elastic_energy, plastic_work;
    /** False if the increment was not found. */
    bool solved;
  };

  /**
   * @brief Von Mises (J2) plasticity with associated flow, isotropic hardening, and
   * kinematic hardening of Armstrong and Frederick, integrated by the backward Euler method.
   *
   *   f = sqrt(3/2) |dev sigma - X| - k(p) <= 0,   d eps_p = sqrt(3/2) dp n,
   *   dX = 2/3 C d eps_p - gamma X dp,
   *
   * where n is the direction of dev sigma - X, p the equivalent plastic strain and k the
   * yield stress. The increment of p is the root of one scalar equation, sought by Newton's
   * method inside a bracket. de Souza Neto, Peric and Owen (2008), Computational Methods for
   * Plasticity, sections 7.3 and 7.6; Armstrong and Frederick (1966), CEGB report RD/B/N731.
   *
   * The tangent is consistent; with gamma > 0 it is unsymmetric.
   */
  class VonMises
  {
  public:
    explicit VonMises(const MaterialParameters &material);

    bool
    kinematic() const
    {
      return modulus > 0.;
    }

    bool
    symmetric() const
    {
      return modulus == 0. || recovery == 0.;
    }

    /**
     * @brief The end of a step.
     * @param trial          Elastic strain if all of the step were elastic.
     * @param plastic_strain Equivalent plastic strain at the beginning, @p back_stress X
     *                       there (deviatoric).
     */
    ReturnMapping
    respond(const dealii::SymmetricTensor<2, dim> &trial,
            double                                 plastic_strain,
            const dealii::SymmetricTensor<2, dim> &back_stress,
            bool                                   with_tangent) const;

  private:
    const double                        mu, kappa;
    const std::shared_ptr<HardeningLaw> hardening;
    /** C and gamma of the back stress. */
    const double modulus, recovery;
    /** The derivative of the stress by the strain where nothing flows. */
    const dealii::SymmetricTensor<4, dim> elastic;

    /** The root of the yield condition in the increment of the plastic strain. */
    bool
    solve(const dealii::SymmetricTensor<2, dim> &trial_stress,
          double                                 plastic_strain,
          const dealii::SymmetricTensor<2, dim> &back_stress,
          double                                &increment,
          double                                &slope) const;
  };
} // namespace Touchstone

#endif
