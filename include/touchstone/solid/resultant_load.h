// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_resultant_load_h
#define touchstone_solid_resultant_load_h

#include <touchstone/base/formula.h>
#include <touchstone/solid/solid.h>

#include <array>
#include <memory>

namespace Touchstone
{
  /**
   * @brief A force at a point and a moment, carried to a boundary by tractions that leave it free
   * to deform.
   *
   * The traction on the reference area is the one that is linear in the position,
   *
   *   f = F / A + (J^{-1} M_c) x (x - c),   M_c = M + (p - c) x F,
   *
   * with area A, centroid c and inertia J = int (r^2 I - r r) dA of the boundary: it has the force
   * F and about the point p the moment M, and of all such tractions the least mean square. It is a
   * dead load.
   */
  class ResultantLoad
  {
  public:
    /** Force and moment by component; null for none. Functions of the time. */
    using Functions = std::array<std::shared_ptr<const Formula>, 2 * dim>;

    /** @param point Where the force acts; null: the centroid. Collective. */
    ResultantLoad(const Solid              &solid,
                  const BoundaryIds        &boundary,
                  const Functions          &functions,
                  const dealii::Point<dim> *point);

    const Functions &
    functions() const
    {
      return values;
    }

    /** @brief The traction of a unit of component @p k, per area and per area and length. */
    dealii::Tensor<1, dim>
    traction_of_unit(unsigned int k, const dealii::Point<dim> &x) const;

    /** @brief The traction at the reference position @p x and time @p t, force per area. */
    dealii::Tensor<1, dim>
    traction(const dealii::Point<dim> &x, double t) const;

  private:
    const Functions        values;
    double                 area = 0.;
    dealii::Point<dim>     centroid, point;
    dealii::Tensor<2, dim> inverse_inertia;
  };
} // namespace Touchstone

#endif
