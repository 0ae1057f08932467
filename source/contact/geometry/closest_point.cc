// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_geometry.h>

#include <algorithm>
#include <cmath>

// Closest-point projection of a point onto one face: minimise |x - x(xi)|^2 over xi in [-1,1]^2
// (doc/theory.md 4, "Projection"). FaceTree::project() calls it for each candidate face of a
// search, so it must end on warped and degenerate faces, too. The result also says how far the
// point lies beyond the edges of the face, from which the searches tell a wedge over a sharp edge
// and the end of the surface.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Limit of Newton steps. 50 are many more than any face has needed. */
    constexpr unsigned int max_steps = 50;

    /** Beside an exact surface of radius R the distance d of the point decides how fast steps
     * without curvature converge, like (d/R)^n, or that they do not. Near it, as in contact, these
     * are enough; the derivatives are costly. */
    constexpr unsigned int steps_without_curvature = 5;

    /** Projected Newton method for the closest point on a face, in xi: half the squared distance
     * has the gradient -t_a . r and the Hessian t_a . t_b - r . x,ab, with r = x - x(xi). A step
     * solves Hessian * step = t . r for the coordinates that are not held at a bound. */
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
            curved = geometry.smooth() ||
                     (geometry.exact_surface() && iteration >= steps_without_curvature);
            double step[2] = {0., 0.};
            if (!newton_step(step))
              return false;
            const double change = take(step);
            // Quadratic convergence ends here. If the last step is still large, the iteration has
            // not converged and another start is tried; between the two limits round-off of a flat
            // minimum is accepted.
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
      bool                  curved = false;

      /** The Hessian t_a . t_b - r . x,ab, as far as it stays positive definite. Without the
       * curvature of a patch and the twist of a warped face convergence would be linear. */
      std::array<std::array<double, 2>, 2>
      matrix() const;
      /** @return false if the face is degenerate. */
      bool
      newton_step(double (&step)[2]) const;
      /** Apply a step, restricted to the face and halved until the distance does not grow.
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
      if (curved)
        {
          const auto second = geometry.second_derivatives(xi);
          twist             = second[1];
          for (unsigned int i = 0; i < 2; ++i)
            {
              const double entry = a[i][i] - r * second[2 * i];
              // Beyond a centre of curvature the Hessian is not positive definite and a Newton step
              // would go to a maximum of the distance: there the Gauss-Newton term t_a . t_a stays.
              if (entry > 0.1 * a[i][i])
                a[i][i] = entry;
            }
        }
      else if (face.degree == 1)
        twist =
          0.25 * ((face.position(0) - face.position(1)) - (face.position(2) - face.position(3)));
      const double coupling = a[0][1] - r * twist;
      // The off-diagonal entry must leave the determinant clearly positive.
      if (coupling * coupling < 0.9 * a[0][0] * a[1][1])
        a[0][1] = a[1][0] = coupling;
      return a;
    }



    bool
    ClosestPoint::newton_step(double (&step)[2]) const
    {
      const double b[2] = {point.tangents[0] * r, point.tangents[1] * r};
      const auto   a    = matrix();
      // Coordinates at a bound at which the distance decreases towards the outside.
      bool at_bound[2];
      for (unsigned int i = 0; i < 2; ++i)
        at_bound[i] = (xi[i] >= 1. && b[i] > 0.) || (xi[i] <= -1. && b[i] < 0.);
      // With one coordinate held, the other takes the step of the one-dimensional problem along the
      // edge; at a corner that holds both the step is zero, and the iteration has converged.
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
          // The bounds are imposed on each trial, so that the distance compared is that of a point
          // of the face.
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
          // Only a coordinate at its bound can have held the projection back. What is left of r
          // along the tangent is then how far the point lies beyond that edge.
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
