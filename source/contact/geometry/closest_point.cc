#include <touchstone/contact/geometry/face_geometry.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** One run of the projected Newton method. @return whether it converged. */
    bool
    project(const Point<dim> &x, const FaceGeometry &geometry, Projection &result)
    {
      const Face            &face  = geometry.face();
      std::array<double, 2> &xi    = result.xi;
      FacePoint              point = geometry.evaluate(xi);
      Tensor<1, dim>         r     = x - point.x;
      for (unsigned int iteration = 0; iteration < 50; ++iteration)
        {
          const double b[2] = {point.tangents[0] * r, point.tangents[1] * r};
          double       a[2][2];
          for (unsigned int i = 0; i < 2; ++i)
            for (unsigned int j = 0; j < 2; ++j)
              a[i][j] = point.tangents[i] * point.tangents[j];
          // Curvature of a patch and twist of a warped face, as long as the matrix
          // stays positive.
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
            twist = 0.25 * ((face.reference[0] + face.displacement[0]) -
                            (face.reference[1] + face.displacement[1]) -
                            (face.reference[2] + face.displacement[2]) +
                            (face.reference[3] + face.displacement[3]));
          const double coupling = a[0][1] - r * twist;
          if (coupling * coupling < 0.9 * a[0][0] * a[1][1])
            a[0][1] = a[1][0] = coupling;

          // Coordinates that stay at a bound because the step would leave it.
          bool held[2];
          for (unsigned int i = 0; i < 2; ++i)
            held[i] = (xi[i] >= 1. && b[i] > 0.) || (xi[i] <= -1. && b[i] < 0.);
          double       step[2] = {0., 0.};
          const double det     = a[0][0] * a[1][1] - a[0][1] * a[1][0];
          if (!held[0] && !held[1])
            {
              if (det <= 0.)
                return false; // a degenerate face
              step[0] = (a[1][1] * b[0] - a[0][1] * b[1]) / det;
              step[1] = (a[0][0] * b[1] - a[1][0] * b[0]) / det;
            }
          else
            for (unsigned int i = 0; i < 2; ++i)
              if (!held[i] && a[i][i] > 0.)
                step[i] = b[i] / a[i][i];

          // Halve the step until the distance does not grow.
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
          if (change < 1e-13)
            break;
          if (iteration == 49 && change > 1e-9)
            return false;
        }

      result.distance_squared = r.norm_square();
      result.beyond_inner = result.beyond_outer = 0.;
      for (unsigned int i = 0; i < 2; ++i)
        {
          const double length = point.tangents[i].norm();
          if (length == 0. || std::abs(xi[i]) < 1.)
            continue;
          // Half the face is one unit of xi.
          const double beyond = 0.5 * xi[i] * (r * point.tangents[i]) / (length * length);
          const bool   outer  = face.outer_edges & (1u << (2 * i + (xi[i] > 0. ? 1 : 0)));
          double      &amount = outer ? result.beyond_outer : result.beyond_inner;
          amount              = std::max(amount, beyond);
        }
      return true;
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
        Projection projection;
        projection.xi        = start;
        const bool converged = project(x, geometry, projection);
        if (converged && projection.distance_squared < best.distance_squared)
          best = projection;
        if (converged && start[0] == 0.)
          break;
      }
    return best;
  }
} // namespace Touchstone
