// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_vector3_h
#define touchstone_contact_geometry_vector3_h

#include <touchstone/base/types.h>

#include <array>

namespace Touchstone
{
  /** @brief Three components of any kind of number. deal.II's Tensor does not go with
   * numbers that carry derivatives (Sacado), whose products are expression
   * templates. */
  template <typename Number>
  using Vector3 = std::array<Number, dim>;

  /** @brief Scalar product. */
  template <typename Number>
  Number
  dot(const Vector3<Number> &a, const Vector3<Number> &b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  /** @brief Vector product. */
  template <typename Number>
  Vector3<Number>
  cross(const Vector3<Number> &a, const Vector3<Number> &b)
  {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  }
} // namespace Touchstone

#endif
