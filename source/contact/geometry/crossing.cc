// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/crossing.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  // Newton's method in the three unknowns xi_1, xi_2 and time for start + time (end - start) =
  // x(xi, time), where the nodes of the face move linearly from their committed to their present
  // positions (doc/theory.md 4, "Passing through"). The start in the middle of the face and of the
  // step finds the crossing of a face that is hardly warped in very few iterations.
  std::optional<Crossing>
  crossing(const Point<dim>      &start,
           const Point<dim>      &end,
           const Face            &face,
           const AnalyticSurface *exact)
  {
    Face       moving = face;
    const auto move   = [&](const double time) {
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        moving.displacement[m] = (1. - time) * face.committed[m] + time * face.displacement[m];
    };

    std::array<double, 2> xi{{0., 0.}};
    double                time = 0.5;
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        move(time);
        const FacePoint  point = evaluate(moving, exact, xi);
        const FaceShapes shapes(face.degree, xi);
        // Velocity of the node relative to the point of the face, per unit of time, i.e. per step.
        Tensor<1, dim> velocity = end - start;
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          velocity -= shapes.value[m] * (face.displacement[m] - face.committed[m]);
        const Tensor<1, dim> r     = start + time * (end - start) - point.x;
        const Tensor<1, dim> cross = cross_product_3d(point.tangents[0], point.tangents[1]);
        // The tangents t_1, t_2 and their product "cross" (outward) are the basis
        // in which the linear system is solved; "area" is the surface Jacobian and "size" a length
        // of the face.
        const double rate = velocity * cross, area = cross.norm(), size = std::sqrt(area);
        // No motion relative to the face, or motion parallel to it: no time of crossing.
        if (std::abs(rate) <= 1e-10 * area * size)
          return {};
        // t_1 dxi_1 + t_2 dxi_2 - v dtime = r
        // The product with "cross" eliminates both dxi; the dual basis of the tangents, t_2 x cross
        // / area^2 and cross x t_1 / area^2, gives these.
        const double dtime  = -(r * cross) / rate;
        const double dxi[2] = {(r + dtime * velocity) * cross_product_3d(point.tangents[1], cross) /
                                 (area * area),
                               (r + dtime * velocity) * cross_product_3d(cross, point.tangents[0]) /
                                 (area * area)};
        time += dtime;
        for (unsigned int a = 0; a < 2; ++a)
          // Held near the face, where the map of a warped face can be trusted.
          xi[a] = std::clamp(xi[a] + dxi[a], -2., 2.);
        // Still far beside the face after several iterations: there is no crossing of this face.
        if (iteration >= 4 && (std::abs(xi[0]) == 2. || std::abs(xi[1]) == 2.))
          return {};
        if (std::abs(dtime) + std::abs(dxi[0]) + std::abs(dxi[1]) > 1e-10)
          continue;
        // A node that touches the face at the start of the step, up to round-off in or out, enters
        // at a time that is a little negative: a length over the normal velocity. Without the
        // allowance such a node would be lost.
        const double touching = Tolerances::touches_at_start * area * size / std::abs(rate);
        if (std::max(std::abs(xi[0]), std::abs(xi[1])) > 1. + Tolerances::face_coordinate ||
            time < -touching || time > 1.)
          return {};
        return Crossing{time, rate < 0.};
      }
    return {};
  }
} // namespace Touchstone
