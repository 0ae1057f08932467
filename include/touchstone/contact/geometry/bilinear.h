// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_bilinear_h
#define touchstone_contact_geometry_bilinear_h

#include <array>

namespace Touchstone
{
  /**
   * @brief A bilinear map c_0 + c_1 xi_1 + c_2 xi_2 + c_3 xi_1 xi_2 of the face coordinates,
   * which takes a third of the operations of shape functions.
   * @tparam n Components of its values.
   */
  template <unsigned int n>
  struct Bilinear
  {
    std::array<double, n> c[4];

    Bilinear() = default;

    /** @param corner (m, d) -> component d at the node m. */
    template <typename Corner>
    explicit Bilinear(const Corner &corner)
    {
      for (unsigned int d = 0; d < n; ++d)
        {
          const double a = corner(0, d), b = corner(1, d), e = corner(2, d), f = corner(3, d);
          c[0][d] = 0.25 * (a + b + e + f);
          c[1][d] = 0.25 * (b - a + f - e);
          c[2][d] = 0.25 * (e - a + f - b);
          c[3][d] = 0.25 * (a - b + f - e);
        }
    }

    /** @brief Value @p x and derivatives @p t at @p xi, components by [d] and [a][d]. */
    template <typename Value, typename Derivatives>
    void
    evaluate(const std::array<double, 2> &xi, Value &x, Derivatives &t) const
    {
      for (unsigned int d = 0; d < n; ++d)
        {
          t[0][d] = c[1][d] + c[3][d] * xi[1];
          t[1][d] = c[2][d] + c[3][d] * xi[0];
          x[d]    = c[0][d] + c[2][d] * xi[1] + t[0][d] * xi[0];
        }
    }

    /** @brief Value @p x alone. */
    template <typename Value>
    void
    evaluate(const std::array<double, 2> &xi, Value &x) const
    {
      for (unsigned int d = 0; d < n; ++d)
        x[d] = c[0][d] + c[2][d] * xi[1] + (c[1][d] + c[3][d] * xi[1]) * xi[0];
    }
  };
} // namespace Touchstone

#endif
