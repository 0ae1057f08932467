// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/line_and_face.h>

#include <algorithm>
#include <cmath>

// A line and a face (doc/theory.md 3.4). Seen along the line, the corners of a face are those of a
// plane quadrilateral, and the coordinates of the point are the roots of a quadratic equation.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int max_steps_on_line = 20;

    /** A step of Newton's method, in face coordinates, after which the surface is linear up to
     * round-off. */
    constexpr double last_step_on_line = 1e-8;

    /** Coordinates of a point on the face, or beside it. */
    constexpr double far_beside_face = 3.;

    /** A plane vector. */
    using Plane = std::array<double, 2>;

    double
    cross(const Plane &a, const Plane &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    /** Two unit vectors that are a right-handed frame with @p n. */
    std::array<Tensor<1, dim>, 2>
    frame_across(const Tensor<1, dim> &n)
    {
      unsigned int smallest = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(n[d]) < std::abs(n[smallest]))
          smallest = d;
      Tensor<1, dim> axis;
      axis[smallest]       = 1.;
      Tensor<1, dim> first = cross_product_3d(n, axis);
      first /= first.norm();
      return {{first, cross_product_3d(n, first)}};
    }

    /** The coordinates at which a + b xi_1 + c xi_2 + d xi_1 xi_2 = 0 with a negative Jacobian
     * determinant. At the two roots the determinants are those of opposite sign, as they are the
     * slopes of the quadratic function of xi_2 there. */
    std::optional<std::array<double, 2>>
    front_root(const Plane &a, const Plane &b, const Plane &c, const Plane &d)
    {
      const double square = cross(c, d), linear = cross(a, d) + cross(c, b), constant = cross(a, b);
      const double discriminant = linear * linear - 4. * square * constant;
      if (!(discriminant > 0.))
        return {};
      const double slope = std::sqrt(discriminant);
      // Of the two forms of the root the one without cancellation.
      const double eta = linear > 0.    ? -2. * constant / (linear + slope)
                         : square != 0. ? (slope - linear) / (2. * square)
                                        : 2. * far_beside_face;
      const Plane  at{{a[0] + c[0] * eta, a[1] + c[1] * eta}},
        along{{b[0] + d[0] * eta, b[1] + d[1] * eta}};
      const double length = along[0] * along[0] + along[1] * along[1];
      const double xi     = -(at[0] * along[0] + at[1] * along[1]) / length;
      // Also if not a number: the face is seen edge-on.
      if (!(std::abs(xi) < far_beside_face && std::abs(eta) < far_beside_face))
        return {};
      return std::array<double, 2>{{xi, eta}};
    }
  } // namespace



  BeyondEdges::BeyondEdges(const Face &face, const std::array<double, 2> &xi)
    : inner(-1.)
    , outer(-1.)
  {
    // Bits of Face::outer_edges: xi_1 = -1, xi_1 = 1, xi_2 = -1, xi_2 = 1.
    for (unsigned int e = 0; e < 4; ++e)
      {
        const double beyond = 0.5 * ((e % 2 == 0 ? -1. : 1.) * xi[e / 2] - 1.);
        double      &most   = (face.outer_edges & (1u << e)) ? outer : inner;
        most                = std::max(most, beyond);
      }
  }



  std::optional<LineOnFace>
  meet_from_outside(const Point<dim> &x, const Tensor<1, dim> &n, const FaceGeometry &geometry)
  {
    const Face        &face   = geometry.face();
    const unsigned int p      = face.degree;
    const unsigned int ends[] = {0, p, (p + 1) * p, (p + 1) * (p + 1) - 1};
    const auto         across = frame_across(n);
    Plane              corners[4];
    for (unsigned int i = 0; i < 4; ++i)
      {
        const Tensor<1, dim> from = face.position(ends[i]) - x;
        corners[i]                = {{from * across[0], from * across[1]}};
      }
    const Bilinear<2> seen(
      [&](const unsigned int m, const unsigned int d) { return corners[m][d]; });
    const auto root = front_root(seen.c[0], seen.c[1], seen.c[2], seen.c[3]);
    if (!root)
      return {};
    LineOnFace result;
    result.xi        = *root;
    result.point     = geometry.evaluate(result.xi);
    const bool plane = p == 1 && !geometry.smooth() && geometry.exact_surface() == nullptr;
    bool       found = plane;
    for (unsigned int step = 0; !found && step < max_steps_on_line; ++step)
      {
        // x_m + t_a dxi_a = x + l n for any l: Cramer's rule without the part along n.
        const auto          &t           = result.point.tangents;
        const double         determinant = cross_product_3d(t[0], t[1]) * n;
        const Tensor<1, dim> left        = x - result.point.x;
        const double         d[2]        = {cross_product_3d(t[1], n) * left / determinant,
                                            cross_product_3d(n, t[0]) * left / determinant};
        for (unsigned int a = 0; a < 2; ++a)
          result.xi[a] += d[a];
        if (!(std::abs(result.xi[0]) < far_beside_face && std::abs(result.xi[1]) < far_beside_face))
          return {};
        found        = std::max(std::abs(d[0]), std::abs(d[1])) < last_step_on_line;
        result.point = geometry.evaluate(result.xi);
      }
    if (!found || !(cross_product_3d(result.point.tangents[0], result.point.tangents[1]) * n < 0.))
      return {};
    result.along = (result.point.x - x) * n;
    return result;
  }
} // namespace Touchstone
