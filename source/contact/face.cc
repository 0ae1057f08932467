#include <touchstone/contact/face.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Lagrange polynomials on equidistant points of [-1,1], and derivatives. */
    void
    lagrange(const unsigned int degree, const double x, double *value, double *derivative)
    {
      if (degree == 1)
        {
          value[0]      = 0.5 * (1. - x);
          value[1]      = 0.5 * (1. + x);
          derivative[0] = -0.5;
          derivative[1] = 0.5;
        }
      else
        {
          value[0]      = 0.5 * x * (x - 1.);
          value[1]      = (1. - x) * (1. + x);
          value[2]      = 0.5 * x * (x + 1.);
          derivative[0] = x - 0.5;
          derivative[1] = -2. * x;
          derivative[2] = x + 0.5;
        }
    }
  } // namespace



  FaceShapes::FaceShapes(const unsigned int degree, const std::array<double, 2> &xi)
  {
    double n[2][3], dn[2][3];
    for (unsigned int d = 0; d < 2; ++d)
      lagrange(degree, xi[d], n[d], dn[d]);
    for (unsigned int j = 0; j <= degree; ++j)
      for (unsigned int i = 0; i <= degree; ++i)
        {
          const unsigned int m = i + (degree + 1) * j;
          value[m]             = n[0][i] * n[1][j];
          gradient[m]          = {{dn[0][i] * n[1][j], n[0][i] * dn[1][j]}};
        }
  }



  std::array<double, 2>
  node_coordinates(const Face &face, const unsigned int m)
  {
    const unsigned int p = face.degree;
    return {{2. * (m % (p + 1)) / p - 1., 2. * (m / (p + 1)) / p - 1.}};
  }



  Tensor<1, dim>
  FacePoint::normal() const
  {
    const Tensor<1, dim> cross  = cross_product_3d(tangents[0], tangents[1]);
    const double         length = cross.norm();
    return length > 0. ? cross / length : cross;
  }



  FacePoint
  evaluate(const Face &face, const AnalyticSurface *exact, const std::array<double, 2> &xi)
  {
    const FaceShapes shapes(face.degree, xi);
    FacePoint        result;
    Point<dim>       reference;
    Tensor<1, dim>   displacement;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        reference += shapes.value[m] * face.reference[m];
        displacement += shapes.value[m] * face.displacement[m];
        for (unsigned int a = 0; a < 2; ++a)
          result.tangents[a] += shapes.gradient[m][a] * face.reference[m];
      }
    if (exact)
      {
        const Tensor<2, dim> gradient = exact->projection_gradient(reference);
        for (unsigned int a = 0; a < 2; ++a)
          result.tangents[a] = gradient * result.tangents[a];
        reference = exact->project(reference);
      }
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      for (unsigned int a = 0; a < 2; ++a)
        result.tangents[a] += shapes.gradient[m][a] * face.displacement[m];
    result.x = reference + displacement;
    return result;
  }



  namespace
  {
    /** One run of the projected Newton method. @return whether it converged. */
    bool
    project(const Point<dim> &x, const Face &face, const AnalyticSurface *exact, Projection &result)
    {
      std::array<double, 2> &xi    = result.xi;
      FacePoint              point = evaluate(face, exact, xi);
      Tensor<1, dim>         r     = x - point.x;
      for (unsigned int iteration = 0; iteration < 50; ++iteration)
        {
          const double b[2] = {point.tangents[0] * r, point.tangents[1] * r};
          double       a[2][2];
          for (unsigned int i = 0; i < 2; ++i)
            for (unsigned int j = 0; j < 2; ++j)
              a[i][j] = point.tangents[i] * point.tangents[j];
          // Twist of a warped face, as long as the matrix stays positive.
          Tensor<1, dim> twist;
          if (face.degree == 1)
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
              next_point = evaluate(face, exact, next);
              next_r     = x - next_point.x;
              if (next_r.norm_square() <= r.norm_square() * (1. + 1e-14))
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
  closest_point_projection(const Point<dim> &x, const Face &face, const AnalyticSurface *exact)
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
        const bool converged = project(x, face, exact, projection);
        if (converged && projection.distance_squared < best.distance_squared)
          best = projection;
        if (converged && start[0] == 0.)
          break;
      }
    return best;
  }
} // namespace Touchstone
