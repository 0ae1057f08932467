// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_geometry.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** 50 steps are many more than any face has needed; each halving is the last resort. */
    constexpr unsigned int max_steps = 50;

    /** Steps of the projected Newton method for the closest point on a face, in xi. */
    class ClosestPoint
    {
    public:
      ClosestPoint(const Point<dim>            &x,
                   const FaceGeometry          &geometry,
                   const std::array<double, 2> &xi)
        : x(x)
        , geometry(geometry)
        , xi(xi)
        , point(geometry.evaluate(xi))
        , r(x - point.x)
      {
      }

      /** @return whether it converged. */
      bool
      solve()
      {
        for (unsigned int iteration = 0; iteration < max_steps; ++iteration)
          {
            double step[2] = {0., 0.};
            if (!newton_step(step))
              return false;
            const double change = take(step);
            if (change < 1e-13)
              return true;
            if (iteration + 1 == max_steps && change > 1e-9)
              return false;
          }
        return true;
      }

      Projection
      result() const;

    private:
      const Point<dim>     &x;
      const FaceGeometry   &geometry;
      std::array<double, 2> xi;
      FacePoint             point;
      Tensor<1, dim>        r; // x - point

      /** The matrix t_a . t_b - r . x_ab, as far as it stays positive definite: curvature of a
       * patch and twist of a warped face belong to it, or convergence would be linear. */
      std::array<std::array<double, 2>, 2>
      matrix() const;
      /** @return false if the face is degenerate. */
      bool
      newton_step(double (&step)[2]) const;
      /** Take a step, held within the face, halved until the distance does not grow.
       * @return the largest change of a coordinate. */
      double
      take(const double (&step)[2]);
    };



    std::array<std::array<double, 2>, 2>
    ClosestPoint::matrix() const
    {
      const Face                          &face = geometry.face();
      std::array<std::array<double, 2>, 2> a;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          a[i][j] = point.tangents[i] * point.tangents[j];
      Tensor<1, dim> twist;
      if (geometry.smooth())
        {
          const auto second = geometry.second_derivatives(xi);
          twist             = second[1];
          for (unsigned int i = 0; i < 2; ++i)
            {
              const double curved = a[i][i] - r * second[2 * i];
              if (curved > 0.1 * a[i][i])
                a[i][i] = curved;
            }
        }
      else if (face.degree == 1)
        twist =
          0.25 * ((face.position(0) - face.position(1)) - (face.position(2) - face.position(3)));
      const double coupling = a[0][1] - r * twist;
      if (coupling * coupling < 0.9 * a[0][0] * a[1][1])
        a[0][1] = a[1][0] = coupling;
      return a;
    }



    bool
    ClosestPoint::newton_step(double (&step)[2]) const
    {
      const double b[2] = {point.tangents[0] * r, point.tangents[1] * r};
      const auto   a    = matrix();
      // Coordinates that stay at a bound because the step would leave it.
      bool at_bound[2];
      for (unsigned int i = 0; i < 2; ++i)
        at_bound[i] = (xi[i] >= 1. && b[i] > 0.) || (xi[i] <= -1. && b[i] < 0.);
      if (at_bound[0] || at_bound[1])
        {
          for (unsigned int i = 0; i < 2; ++i)
            if (!at_bound[i] && a[i][i] > 0.)
              step[i] = b[i] / a[i][i];
          return true;
        }
      const double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
      if (det <= 0.)
        return false;
      step[0] = (a[1][1] * b[0] - a[0][1] * b[1]) / det;
      step[1] = (a[0][0] * b[1] - a[1][0] * b[0]) / det;
      return true;
    }



    double
    ClosestPoint::take(const double (&step)[2])
    {
      std::array<double, 2> next{};
      FacePoint             next_point;
      Tensor<1, dim>        next_r;
      double                change = 0.;
      for (double scale = 1.; scale > 1e-4; scale *= 0.5)
        {
          change = 0.;
          for (unsigned int i = 0; i < 2; ++i)
            {
              next[i] = std::clamp(xi[i] + scale * step[i], -1., 1.);
              change  = std::max(change, std::abs(next[i] - xi[i]));
            }
          next_point = geometry.evaluate(next);
          next_r     = x - next_point.x;
          // Distances are equal up to round-off long before coordinates are.
          if (change < 1e-6 || next_r.norm_square() <= r.norm_square() * (1. + 1e-14))
            break;
        }
      xi    = next;
      point = next_point;
      r     = next_r;
      return change;
    }



    Projection
    ClosestPoint::result() const
    {
      Projection result;
      result.xi               = xi;
      result.distance_squared = r.norm_square();
      for (unsigned int i = 0; i < 2; ++i)
        {
          const double length = point.tangents[i].norm();
          if (length == 0. || std::abs(xi[i]) < 1.)
            continue;
          // Half the face is one unit of xi.
          const double beyond = 0.5 * xi[i] * (r * point.tangents[i]) / (length * length);
          const bool   outer = geometry.face().outer_edges & (1u << (2 * i + (xi[i] > 0. ? 1 : 0)));
          double      &amount = outer ? result.beyond_outer : result.beyond_inner;
          amount              = std::max(amount, beyond);
        }
      return result;
    }
  } // namespace



  Projection
  closest_point_projection(const Point<dim> &x, const FaceGeometry &geometry)
  {
    Projection best;
    best.distance_squared = std::numeric_limits<double>::max();
    // A warped face can have more than one local minimum: if the start at the
    // centre fails, the quarters are tried and the closest result counts.
    for (const auto &start : {std::array<double, 2>{{0., 0.}},
                              std::array<double, 2>{{-0.5, -0.5}},
                              std::array<double, 2>{{0.5, -0.5}},
                              std::array<double, 2>{{-0.5, 0.5}},
                              std::array<double, 2>{{0.5, 0.5}}})
      {
        ClosestPoint closest(x, geometry, start);
        if (!closest.solve())
          continue;
        const Projection projection = closest.result();
        if (projection.distance_squared < best.distance_squared)
          best = projection;
        if (start[0] == 0.)
          break;
      }
    return best;
  }
} // namespace Touchstone
