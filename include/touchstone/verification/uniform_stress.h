// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_verification_uniform_stress_h
#define touchstone_verification_uniform_stress_h

#include <touchstone/verification/reference_solution.h>

namespace Touchstone
{
  /**
   * @brief One stress everywhere: the patch test.
   *
   * The displacement in body b is eps_b (x - x0) + c_b: the bodies are stacked
   * along the axis of the largest normal stress, free to widen sideways, and c_b
   * is such that they stay in touch. x0 is the point that does not move.
   */
  class UniformStress : public ReferenceSolution
  {
  public:
    explicit UniformStress(const Scene &scene);

    ReferenceComparison
    compare(const ReferenceInput &input) const override;

  private:
    dealii::SymmetricTensor<2, dim> stress;
    dealii::Tensor<1, dim>          origin;
    /** Contact pressure; 0 if it is not compared. */
    double       pressure;
    unsigned int pair;
    /** Axis along which the bodies are stacked. */
    unsigned int axis;
    /** Strain of each body. */
    std::vector<dealii::SymmetricTensor<2, dim>> strain;

    /** @brief Displacement c_b of each body along the axis, length. Collective. */
    std::vector<double>
    body_shifts(const ReferenceInput &input) const;

    /** @brief Largest nodal error over the largest nodal displacement; no unit.
     * Collective. */
    double
    displacement_error(const ReferenceInput &input) const;
  };
} // namespace Touchstone

#endif
