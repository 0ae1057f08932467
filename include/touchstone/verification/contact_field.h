// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_verification_contact_field_h
#define touchstone_verification_contact_field_h

#include <touchstone/verification/reference_solution.h>

#include <functional>

namespace Touchstone
{
  /**
   * @brief The contact traction as the field that it is: nodal tractions, interpolated over the
   * slave faces as displacements are.
   *
   * A norm of the field counts what a sum over nodes does not see: the distance of the interpolant
   * from the exact traction between the nodes, above all in cells that the edge of the contact
   * crosses.
   */
  class ContactField
  {
  public:
    /** @brief Whether @p input has what the field needs: bodies and boundaries. */
    static bool
    available(const ReferenceInput &input);

    /** @param pair Its slave surface is taken. Collective. */
    ContactField(const ReferenceInput &input, unsigned int pair);

    /** @brief The relative distance of the field from the exact one: root of int |error(x, t)|^2
     * over int |exact(x)|^2, no unit; NaN if there is nothing to compare. Collective.
     * @param component What of the traction t at x is compared, force per area.
     * @param exact     Its exact value at x, in the reference state. */
    double
    relative_error(const std::function<double(const dealii::Point<dim> &,
                                              const dealii::Tensor<1, dim> &)> &component,
                   const std::function<double(const dealii::Point<dim> &)>     &exact) const;

  private:
    const Solid         &solid;
    const PairBoundaries boundaries;
    /** Nodal tractions, with ghosts. */
    Vector traction;
  };
} // namespace Touchstone

#endif
