// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/facing_part.h>
#include <touchstone/contact/pairing/opposite_point.h>

#include <algorithm>
#include <cmath>

// Which points of two exact surfaces are compared where averaged rows measure the gap
// (doc/theory.md 3.3). If they were shifted to each other along the surfaces, the distance of two
// surfaces that coincide would be that of a chord from its arc.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int max_opposite_steps = 20;

    /** A step of Newton's method, in face coordinates, that is linear up to round-off: position
     * and tangents need not be evaluated again. */
    constexpr double linear_step = 1e-8;

    /** Coordinates that belong to a point on a face or beside it. */
    constexpr double largest_coordinate = 2.;

    /** Exact surfaces alone are worth it. Facets have no other points than those that were
     * intersected, and a patch strays from the surface it stands for by more than the error. */
    bool
    has_opposite_points(const FaceGeometry &slave, const FaceGeometry &master)
    {
      return master.exact_surface() != nullptr && !slave.smooth();
    }

    /** The two directions b_a with d xi_a = b_a . R for the condition t_a dxi_a = R + ds zeta:
     * Cramer's rule without the part along zeta. */
    std::array<Tensor<1, dim>, 2>
    inverse_directions(const FacePoint &point, const Tensor<1, dim> &plane)
    {
      const double determinant = cross_product_3d(point.tangents[0], point.tangents[1]) * plane;
      return {{cross_product_3d(point.tangents[1], plane) / determinant,
               cross_product_3d(plane, point.tangents[0]) / determinant}};
    }
  } // namespace



  bool
  find_opposite_point(const FaceGeometry    &slave,
                      const Point<dim>      &x,
                      const FaceGeometry    &master,
                      const Tensor<1, dim>  &plane,
                      std::array<double, 2> &xi,
                      FacePoint             &point)
  {
    point = master.evaluate(xi);
    if (!has_opposite_points(slave, master))
      return true;
    for (unsigned int iteration = 0; iteration < max_opposite_steps; ++iteration)
      {
        // x_m + t_a dxi_a = x + s zeta for any s.
        const auto   b      = inverse_directions(point, plane);
        const double d[2]   = {b[0] * (x - point.x), b[1] * (x - point.x)};
        const double length = std::max(std::abs(d[0]), std::abs(d[1]));
        for (unsigned int a = 0; a < 2; ++a)
          xi[a] += d[a];
        if (length < linear_step)
          {
            point.x += d[0] * point.tangents[0] + d[1] * point.tangents[1];
            return true;
          }
        // Also false if not a number, where the surface is seen edge-on.
        if (!(std::abs(xi[0]) < largest_coordinate && std::abs(xi[1]) < largest_coordinate))
          return false;
        point = master.evaluate(xi);
      }
    return false;
  }



  template <unsigned int n>
  bool
  differentiate_opposite_point(const FaceGeometry        &slave,
                               const FacePosition        &on_slave,
                               const FaceDifferentiator  &master_face,
                               OverlapPointDerivative<n> &point)
  {
    const FaceGeometry  &master = master_face.geometry;
    const Tensor<1, dim> plane  = plane_normal(slave.face());
    FacePoint            on_master;
    if (!find_opposite_point(slave, on_slave.point.x, master, plane, point.master, on_master))
      return false;
    if (!has_opposite_points(slave, master))
      return true;
    // x_m - x_s = s zeta: t_a dxi_a = dx_s - dx_m|_xi + s dzeta + ds zeta, and b_a is perpendicular
    // to zeta.
    const auto   b         = inverse_directions(on_master, plane);
    const double s         = (on_master.x - on_slave.point.x) * plane;
    const auto   by_slave  = plane_normal_derivatives(slave.face());
    const auto   by_master = master_face.position(point.master).x_position;
    for (unsigned int a = 0; a < 2; ++a)
      {
        const double along[2] = {b[a] * on_slave.point.tangents[0],
                                 b[a] * on_slave.point.tangents[1]};
        for (unsigned int v = 0; v < OverlapPointDerivative<n>::n_variables; ++v)
          point.d_master[a][v] = along[0] * point.d_slave[0][v] + along[1] * point.d_slave[1][v];
        for (unsigned int m = 0; m < n; ++m)
          {
            const Tensor<1, dim> of_slave  = b[a] * (on_slave.x_position[m] + s * by_slave[m]),
                                 of_master = b[a] * by_master[m];
            for (unsigned int e = 0; e < dim; ++e)
              {
                point.d_master[a][dim * m + e] += of_slave[e];
                point.d_master[a][dim * (n + m) + e] -= of_master[e];
              }
          }
      }
    return true;
  }



  template bool
  differentiate_opposite_point<4>(const FaceGeometry &,
                                  const FacePosition &,
                                  const FaceDifferentiator &,
                                  OverlapPointDerivative<4> &);
  template bool
  differentiate_opposite_point<9>(const FaceGeometry &,
                                  const FacePosition &,
                                  const FaceDifferentiator &,
                                  OverlapPointDerivative<9> &);
} // namespace Touchstone
