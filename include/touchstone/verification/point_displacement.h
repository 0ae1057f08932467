// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_verification_point_displacement_h
#define touchstone_verification_point_displacement_h

#include <touchstone/verification/reference_solution.h>

#include <array>
#include <string>

namespace Touchstone
{
  /** @brief The known displacement of one point, e.g. of a beam's tip, compared
   * with that of the nearest node. Components that are not given are free. */
  class PointDisplacement : public ReferenceSolution
  {
  public:
    explicit PointDisplacement(const Scene &scene);

    void
    check_mesh(const Solid &solid) const override;

    ReferenceComparison
    compare(const ReferenceInput &input) const override;

  private:
    const std::string      values;
    dealii::Point<dim>     point;
    dealii::Tensor<1, dim> exact;
    std::array<bool, dim>  given;
  };
} // namespace Touchstone

#endif
