// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/crossing.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

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
        Tensor<1, dim>   velocity = end - start;
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          velocity -= shapes.value[m] * (face.displacement[m] - face.committed[m]);
        const Tensor<1, dim> r     = start + time * (end - start) - point.x;
        const Tensor<1, dim> cross = cross_product_3d(point.tangents[0], point.tangents[1]);
        const double         rate = velocity * cross, area = cross.norm(), size = std::sqrt(area);
        // Along the face, or not at all.
        if (std::abs(rate) <= 1e-10 * area * size)
          return {};
        // t_1 dxi_1 + t_2 dxi_2 - v dtime = r
        const double dtime  = -(r * cross) / rate;
        const double dxi[2] = {(r + dtime * velocity) * cross_product_3d(point.tangents[1], cross) /
                                 (area * area),
                               (r + dtime * velocity) * cross_product_3d(cross, point.tangents[0]) /
                                 (area * area)};
        time += dtime;
        for (unsigned int a = 0; a < 2; ++a)
          xi[a] = std::clamp(xi[a] + dxi[a], -2., 2.);
        // Far beside the face after so many iterations: it will not come back to it.
        if (iteration >= 4 && (std::abs(xi[0]) == 2. || std::abs(xi[1]) == 2.))
          return {};
        if (std::abs(dtime) + std::abs(dxi[0]) + std::abs(dxi[1]) > 1e-10)
          continue;
        const double touching = Tolerances::touches_at_start * area * size / std::abs(rate);
        if (std::max(std::abs(xi[0]), std::abs(xi[1])) > 1. + Tolerances::face_coordinate ||
            time < -touching || time > 1.)
          return {};
        return Crossing{time, rate < 0.};
      }
    return {};
  }
} // namespace Touchstone
