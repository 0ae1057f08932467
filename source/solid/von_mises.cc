// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/body_parameters.h>
#include <touchstone/solid/von_mises.h>

#include <cmath>

// Return mapping of von Mises plasticity with isotropic and kinematic hardening by the backward
// Euler method (doc/materials.md, "Equations"). It serves small strain and, with the logarithmic
// strain, finite strain; the laws in von_mises_laws.cc add history and kinematics.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Yield is exceeded if it is by more than this part of the yield stress: the state at
     * the end of a step lies on the yield surface but for round-off. */
    constexpr double yield_tolerance = 1e-10;
    /** The scalar equation is solved to this part of its terms: round-off. */
    constexpr double root_tolerance = 2e-16;
    const double     root_3_2       = std::sqrt(1.5);
  } // namespace



  VonMises::VonMises(const MaterialParameters &material)
    : mu(material.shear_modulus())
    , kappa(material.bulk_modulus())
    , hardening(material.hardening)
    , modulus(material.kinematic_modulus)
    , recovery(material.kinematic_recovery)
    , elastic(2. * mu * deviator_tensor<dim>() +
              kappa * outer_product(unit_symmetric_tensor<dim>(), unit_symmetric_tensor<dim>()))
  {
  }



  /** Solve the scalar equation g = 0 for the increment of the equivalent plastic strain by
   * Newton's method inside a bracket. Newton's method alone can diverge for hardening curves with
   * kinks or saturation; the bracket halves then, so that a step of any size is answered. Returns
   * false for a law that gives no finite numbers. */
  bool
  VonMises::solve(const SymmetricTensor<2, dim> &trial_stress,
                  const double                   plastic_strain,
                  const SymmetricTensor<2, dim> &back_stress,
                  double                        &increment,
                  double                        &slope) const
  {
    // g(x) = sqrt(3/2) |s - theta X| - (3 mu + C theta) x - k(p + x) with
    // theta = 1 / (1 + gamma x). g decreases, for |X| is bounded by its saturation; it is
    // positive at 0 and negative at the upper end of the bracket.
    double low  = 0.;
    double high = root_3_2 * (trial_stress.norm() + back_stress.norm()) / (3. * mu);
    increment   = 0.;
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
      {
        const double                  theta    = 1. / (1. + recovery * increment);
        const SymmetricTensor<2, dim> relative = trial_stress - theta * back_stress;
        const double                  norm     = relative.norm();
        const YieldStress             yield    = hardening->at(plastic_strain + increment);
        const double g = root_3_2 * norm - (3. * mu + modulus * theta) * increment - yield.value;
        slope          = -3. * mu - modulus * theta * theta - yield.slope;
        if (norm > 0.)
          slope += root_3_2 * recovery * theta * theta * (relative * back_stress) / norm;
        if (!std::isfinite(g) || !std::isfinite(slope))
          return false;
        if (std::abs(g) <= root_tolerance * (yield.value + root_3_2 * trial_stress.norm()))
          return true;
        (g > 0. ? low : high) = increment;
        double next           = slope < 0. ? increment - g / slope : high;
        if (!(next > low && next < high))
          next = 0.5 * (low + high);
        if (next == low || next == high || std::abs(next - increment) <= 1e-16 * increment)
          return true; // to the last digit
        increment = next;
      }
    return false;
  }



  ReturnMapping
  VonMises::respond(const SymmetricTensor<2, dim> &trial,
                    const double                   plastic_strain,
                    const SymmetricTensor<2, dim> &back_stress,
                    const bool                     with_tangent) const
  {
    const SymmetricTensor<2, dim> identity     = unit_symmetric_tensor<dim>();
    const SymmetricTensor<2, dim> trial_stress = 2. * mu * deviator(trial);
    const double                  pressure     = kappa * trace(trial);

    ReturnMapping result;
    result.solved         = true;
    result.increment      = 0.;
    result.plastic_strain = plastic_strain;
    result.elastic_strain = trial;
    result.back_stress    = back_stress;
    result.plastic_work   = 0.;
    result.stress         = trial_stress + pressure * identity;

    // Elastic predictor: the step is elastic if the trial stress is inside the yield surface of
    // the last step.
    const YieldStress before  = hardening->at(plastic_strain);
    const double      excess  = root_3_2 * (trial_stress - back_stress).norm() - before.value;
    const bool        plastic = !(excess <= yield_tolerance * before.value); // also if NaN
    double            slope   = 0.;
    if (plastic)
      {
        result.solved = solve(trial_stress, plastic_strain, back_stress, result.increment, slope);
        // Plastic corrector. Stress and back stress both change along s - theta X_n, so that this
        // is the direction of their difference at the end of the step, too, and one scalar
        // equation for its length remains.
        const double                  x         = result.increment;
        const double                  theta     = 1. / (1. + recovery * x);
        const SymmetricTensor<2, dim> relative  = trial_stress - theta * back_stress;
        const double                  norm      = relative.norm();
        const SymmetricTensor<2, dim> direction = relative / norm;

        result.plastic_strain    = plastic_strain + x;
        result.plastic_increment = root_3_2 * x * direction;
        result.elastic_strain -= result.plastic_increment;
        result.stress -= 2. * mu * result.plastic_increment;
        result.back_stress = theta * (back_stress + 2. / 3. * modulus * result.plastic_increment);
        // Exact for proportional flow without recovery of the back stress.
        result.plastic_work = hardening->at(result.plastic_strain).work - before.work +
                              0.5 * ((back_stress + result.back_stress) * result.plastic_increment);

        // The consistent tangent, the derivative of this algorithm by the trial strain: the
        // change of direction (beta), and the change of the increment, dx = -(dg/dtrial)/slope.
        // Recovery of the back stress changes the direction by the increment, too, which makes
        // the tangent unsymmetric.
        if (with_tangent)
          {
            const double beta              = 2. * mu * root_3_2 * x / norm;
            result.tangent                 = elastic - 2. * mu * beta * deviator_tensor<dim>();
            SymmetricTensor<2, dim> change = direction;
            if (recovery > 0.)
              change += x / norm * recovery * theta * theta *
                        (back_stress - (direction * back_stress) * direction);
            result.tangent +=
              outer_product(2. * mu * beta * direction + 6. * mu * mu / slope * change, direction);
          }
      }
    else if (with_tangent)
      result.tangent = elastic;

    result.elastic_energy = 0.5 * (result.stress * result.elastic_strain);
    return result;
  }
} // namespace Touchstone
