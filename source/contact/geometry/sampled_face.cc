// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/sampled_face.h>

#include <algorithm>

namespace Touchstone
{
  using namespace dealii;

  SampledFace::SampledFace(const Face &face, const AnalyticSurface *exact)
    : MeasuredFace(face, exact)
  {
    sampled.reserve(samples.size() * samples.size());
    for (const double a : samples)
      for (const double b : samples)
        {
          const Xi        xi    = {{a, b}};
          const FacePoint point = evaluate(face, exact, xi);
          sampled.push_back({xi, point.x, point.normal()});
          radius = std::max(radius, from_axis(point.x));
          tilt   = std::max(tilt, cross_product_3d(sampled.back().normal, axis()).norm());
        }
  }



  // A point at the distance d from its foot lies d n beside it. Between the samples faces of degree
  // 2 and exact surfaces reach a little further than at them, and their normals turn a little more.
  bool
  SampledFace::beside(const Point<dim> &x, const double most) const
  {
    constexpr double margin = 1.1;
    return from_axis(x) > margin * (radius + most * tilt);
  }
} // namespace Touchstone
