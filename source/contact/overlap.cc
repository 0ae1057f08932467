#include <touchstone/contact/overlap.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Polygon = std::vector<Point<2>>;

    double
    cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    double
    area(const Polygon &polygon)
    {
      double sum = 0.;
      for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += 0.5 * cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
      return sum;
    }

    /** Centre of area: unlike any of the corners it moves by round-off only when
     * round-off adds or removes a corner. */
    Point<2>
    centroid(const Polygon &polygon)
    {
      Tensor<1, 2> sum;
      for (std::size_t i = 2; i < polygon.size(); ++i)
        {
          const Tensor<1, 2> a = polygon[i - 1] - polygon[0];
          const Tensor<1, 2> b = polygon[i] - polygon[0];
          sum += 0.5 * cross(a, b) / 3. * (a + b);
        }
      return polygon[0] + sum / area(polygon);
    }

    /** The part of @p subject within the convex, counterclockwise @p window.
     * Sutherland and Hodgman (1974), Commun. ACM 17. */
    Polygon
    clip(Polygon subject, const Polygon &window)
    {
      for (std::size_t e = 0; e < window.size() && !subject.empty(); ++e)
        {
          const Point<2>     a    = window[e];
          const Tensor<1, 2> edge = window[(e + 1) % window.size()] - a;
          Polygon            result;
          for (std::size_t i = 0; i < subject.size(); ++i)
            {
              const Point<2> p  = subject[i];
              const Point<2> q  = subject[(i + 1) % subject.size()];
              const double   dp = cross(edge, p - a);
              const double   dq = cross(edge, q - a);
              if (dp >= 0.)
                result.push_back(p);
              if ((dp > 0. && dq < 0.) || (dp < 0. && dq > 0.))
                result.push_back(p + dp / (dp - dq) * (q - p));
            }
          subject.swap(result);
        }
      return subject;
    }

    /** A face projected onto a plane. */
    struct Shadow
    {
      const Face                           &face;
      std::array<Point<2>, Face::max_nodes> nodes;

      Shadow(const Face           &face,
             const Point<dim>     &origin,
             const Tensor<1, dim> &e1,
             const Tensor<1, dim> &e2)
        : face(face)
      {
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          {
            const Tensor<1, dim> x = face.reference[m] + face.displacement[m] - origin;
            nodes[m]               = Point<2>(x * e1, x * e2);
          }
      }

      /** The bilinear pieces, counterclockwise. */
      std::vector<Polygon>
      pieces() const
      {
        std::vector<Polygon> result;
        const unsigned int   p = face.degree;
        for (unsigned int j = 0; j < p; ++j)
          for (unsigned int i = 0; i < p; ++i)
            {
              const unsigned int m = i + (p + 1) * j;
              Polygon            piece{nodes[m], nodes[m + 1], nodes[m + p + 2], nodes[m + p + 1]};
              if (area(piece) < 0.)
                std::swap(piece[1], piece[3]);
              result.push_back(piece);
            }
        return result;
      }

      /** Face coordinates of a point of the plane, by Newton's method.
       * @return false if there are none near the face. */
      bool
      invert(const Point<2> &x, std::array<double, 2> &xi, double &jacobian) const
      {
        xi = {{0., 0.}};
        for (unsigned int iteration = 0; iteration < 20; ++iteration)
          {
            const FaceShapes shapes(face.degree, xi);
            Point<2>         position;
            Tensor<1, 2>     t[2];
            for (unsigned int m = 0; m < face.n_nodes(); ++m)
              {
                position += shapes.value[m] * nodes[m];
                for (unsigned int a = 0; a < 2; ++a)
                  t[a] += shapes.gradient[m][a] * nodes[m];
              }
            const Tensor<1, 2> r = x - position;
            jacobian             = cross(t[0], t[1]);
            if (jacobian == 0.)
              return false;
            const double d[2] = {cross(r, t[1]) / jacobian, cross(t[0], r) / jacobian};
            xi[0] += d[0];
            xi[1] += d[1];
            if (std::abs(d[0]) + std::abs(d[1]) < 1e-13)
              break;
          }
        return std::abs(xi[0]) < 1.5 && std::abs(xi[1]) < 1.5;
      }
    };
  } // namespace



  std::vector<OverlapPoint>
  overlap(const Face &slave, const Face &master)
  {
    const FacePoint      centre = evaluate(slave, nullptr, {{0., 0.}});
    const Tensor<1, dim> normal = centre.normal();
    const Tensor<1, dim> e1     = centre.tangents[0] / centre.tangents[0].norm();
    const Tensor<1, dim> e2     = cross_product_3d(normal, e1);
    const Shadow         slave_shadow(slave, centre.x, e1, e2);
    const Shadow         master_shadow(master, centre.x, e1, e2);

    static const QGaussSimplex<2> rule(3);
    std::vector<OverlapPoint>     points;
    const auto                    master_pieces = master_shadow.pieces();
    for (const Polygon &window : slave_shadow.pieces())
      {
        const double whole = area(window);
        for (const Polygon &piece : master_pieces)
          {
            const Polygon common = clip(piece, window);
            if (common.size() < 3 || area(common) < 1e-12 * whole)
              continue;
            const Point<2> middle = centroid(common);
            for (std::size_t i = 0; i < common.size(); ++i)
              {
                const Tensor<1, 2> a = common[i] - middle;
                const Tensor<1, 2> b = common[(i + 1) % common.size()] - middle;
                if (cross(a, b) < 1e-12 * whole)
                  continue;
                for (unsigned int q = 0; q < rule.size(); ++q)
                  {
                    const Point<2> x = middle + rule.point(q)[0] * a + rule.point(q)[1] * b;
                    OverlapPoint   point;
                    double         slave_jacobian, master_jacobian;
                    if (!slave_shadow.invert(x, point.slave, slave_jacobian) ||
                        !master_shadow.invert(x, point.master, master_jacobian))
                      continue;
                    // From the plane to the slave face.
                    const FacePoint on_slave = evaluate(slave, nullptr, point.slave);
                    const double    stretch =
                      cross_product_3d(on_slave.tangents[0], on_slave.tangents[1]).norm() /
                      std::abs(slave_jacobian);
                    point.weight = rule.weight(q) * cross(a, b) * stretch;
                    points.push_back(point);
                  }
              }
          }
      }
    return points;
  }
} // namespace Touchstone
