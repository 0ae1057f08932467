#include <touchstone/contact/overlap.h>
#include <touchstone/contact/vector3.h>

#include <deal.II/base/quadrature_lib.h>

#include <Sacado.hpp>
#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    // The geometry in the plane is written for double and for numbers that carry
    // derivatives (Sacado); deal.II's Point does not go with the latter, whose
    // products are expression templates.
    template <typename Number>
    struct Point2
    {
      Number x, y;
    };

    template <typename Number>
    Point2<Number>
    operator-(const Point2<Number> &a, const Point2<Number> &b)
    {
      return {a.x - b.x, a.y - b.y};
    }

    using Touchstone::cross;

    template <typename Number>
    Number
    cross(const Point2<Number> &a, const Point2<Number> &b)
    {
      return a.x * b.y - a.y * b.x;
    }

    inline double
    value(const double x)
    {
      return x;
    }

    template <int n>
    double
    value(const Sacado::Fad::SFad<double, n> &x)
    {
      return x.val();
    }

    template <typename Number>
    using Polygon = std::vector<Point2<Number>>;

    template <typename Number>
    Number
    area(const Polygon<Number> &polygon)
    {
      Number sum = 0.;
      for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += 0.5 * cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
      return sum;
    }

    /** Centre of area: unlike any of the corners it moves by round-off only when
     * round-off adds or removes a corner. */
    template <typename Number>
    Point2<Number>
    centroid(const Polygon<Number> &polygon)
    {
      Point2<Number> sum{0., 0.};
      for (std::size_t i = 2; i < polygon.size(); ++i)
        {
          const Point2<Number> a = polygon[i - 1] - polygon[0];
          const Point2<Number> b = polygon[i] - polygon[0];
          const Number         c = 0.5 * cross(a, b) / 3.;
          sum.x += c * (a.x + b.x);
          sum.y += c * (a.y + b.y);
        }
      const Number whole = area(polygon);
      return {polygon[0].x + sum.x / whole, polygon[0].y + sum.y / whole};
    }

    /** The part of @p subject within the convex, counterclockwise @p window.
     * Sutherland and Hodgman (1974), Commun. ACM 17. */
    template <typename Number>
    Polygon<Number>
    clip(Polygon<Number> subject, const Polygon<Number> &window)
    {
      for (std::size_t e = 0; e < window.size() && !subject.empty(); ++e)
        {
          const Point2<Number> &a    = window[e];
          const Point2<Number>  edge = window[(e + 1) % window.size()] - a;
          std::vector<Number>   side;
          for (const Point2<Number> &p : subject)
            side.push_back(cross(edge, p - a));
          Polygon<Number> result;
          for (std::size_t i = 0; i < subject.size(); ++i)
            {
              const std::size_t     j  = (i + 1) % subject.size();
              const Point2<Number> &p  = subject[i];
              const Number         &dp = side[i], &dq = side[j];
              if (dp >= 0.)
                result.push_back(p);
              if ((dp > 0. && dq < 0.) || (dp < 0. && dq > 0.))
                {
                  const Number t = dp / (dp - dq);
                  result.push_back(
                    {p.x + t * (subject[j].x - p.x), p.y + t * (subject[j].y - p.y)});
                }
            }
          subject.swap(result);
        }
      return subject;
    }

    template <typename Number>
    using Positions = std::array<Vector3<Number>, Face::max_nodes>;

    Positions<double>
    positions(const Face &face)
    {
      Positions<double> result;
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        for (unsigned int d = 0; d < dim; ++d)
          result[m][d] = face.reference[m][d] + face.displacement[m][d];
      return result;
    }

    /** The tangent plane at the centre of a face. */
    template <typename Number>
    struct Plane
    {
      Vector3<Number> origin, e1, e2;

      Plane(const Face &face, const Positions<Number> &x)
      {
        const FaceShapes shapes(face.degree, {{0., 0.}});
        Vector3<Number>  t[2];
        for (unsigned int d = 0; d < dim; ++d)
          {
            origin[d] = 0.;
            for (auto &tangent : t)
              tangent[d] = 0.;
            for (unsigned int m = 0; m < face.n_nodes(); ++m)
              {
                origin[d] += shapes.value[m] * x[m][d];
                for (unsigned int a = 0; a < 2; ++a)
                  t[a][d] += shapes.gradient[m][a] * x[m][d];
              }
          }
        using std::sqrt;
        Vector3<Number> normal = cross(t[0], t[1]);
        const Number    area = sqrt(dot(normal, normal)), length = sqrt(dot(t[0], t[0]));
        for (unsigned int d = 0; d < dim; ++d)
          {
            normal[d] /= area;
            e1[d] = t[0][d] / length;
          }
        e2 = cross(normal, e1);
      }
    };

    /** A face projected onto a plane. */
    template <typename Number>
    struct Shadow
    {
      const Face                                 &face;
      std::array<Point2<Number>, Face::max_nodes> nodes;

      Shadow(const Face &face, const Positions<Number> &x, const Plane<Number> &plane)
        : face(face)
      {
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          {
            Vector3<Number> y = x[m];
            for (unsigned int d = 0; d < dim; ++d)
              y[d] -= plane.origin[d];
            nodes[m] = {dot(y, plane.e1), dot(y, plane.e2)};
          }
      }

      /** The bilinear pieces, counterclockwise. */
      std::vector<Polygon<Number>>
      pieces() const
      {
        std::vector<Polygon<Number>> result;
        const unsigned int           p = face.degree;
        for (unsigned int j = 0; j < p; ++j)
          for (unsigned int i = 0; i < p; ++i)
            {
              const unsigned int m = i + (p + 1) * j;
              Polygon<Number>    piece{nodes[m], nodes[m + 1], nodes[m + p + 2], nodes[m + p + 1]};
              if (area(piece) < 0.)
                std::swap(piece[1], piece[3]);
              result.push_back(piece);
            }
        return result;
      }

      /** Position and tangents at @p xi, without derivatives. */
      Point2<double>
      evaluate(const FaceShapes &shapes, Point2<double> (&t)[2]) const
      {
        Point2<double> position{0., 0.};
        t[0] = t[1] = {0., 0.};
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          {
            const double x = value(nodes[m].x), y = value(nodes[m].y);
            position.x += shapes.value[m] * x;
            position.y += shapes.value[m] * y;
            for (unsigned int a = 0; a < 2; ++a)
              {
                t[a].x += shapes.gradient[m][a] * x;
                t[a].y += shapes.gradient[m][a] * y;
              }
          }
        return position;
      }

      /** Face coordinates of a point of the plane, by Newton's method.
       * @return false if there are none near the face. */
      bool
      invert(const double x, const double y, std::array<double, 2> &xi, double &jacobian) const
      {
        xi = {{0., 0.}};
        for (unsigned int iteration = 0; iteration < 20; ++iteration)
          {
            Point2<double>       t[2];
            const Point2<double> position = evaluate(FaceShapes(face.degree, xi), t);
            const Point2<double> r{x - position.x, y - position.y};
            jacobian = cross(t[0], t[1]);
            if (jacobian == 0.)
              return false;
            const double d[2] = {cross(r, t[1]) / jacobian, cross(t[0], r) / jacobian};
            xi[0] += d[0];
            xi[1] += d[1];
            // The error that is left is of the order of the square.
            if (std::abs(d[0]) + std::abs(d[1]) < 1e-8)
              break;
          }
        return std::abs(xi[0]) < 1.5 && std::abs(xi[1]) < 1.5;
      }
    };

    /** Whether the boxes around two shadows have nothing in common. */
    bool
    apart(const Shadow<double> &a, const Shadow<double> &b)
    {
      const auto range = [](const Shadow<double> &shadow, double Point2<double>::*const axis) {
        const auto end = shadow.nodes.begin() + shadow.face.n_nodes();
        const auto [low, high] =
          std::minmax_element(shadow.nodes.begin(), end, [&](const auto &p, const auto &q) {
            return p.*axis < q.*axis;
          });
        return std::make_pair((*low).*axis, (*high).*axis);
      };
      for (const auto axis : {&Point2<double>::x, &Point2<double>::y})
        {
          const auto of_a = range(a, axis), of_b = range(b, axis);
          if (of_a.second <= of_b.first || of_b.second <= of_a.first)
            return true;
        }
      return false;
    }

    /** Visit the quadrature points on the common parts of two shadows, with place
     * and weight in the plane. */
    template <typename Number, typename Visitor>
    void
    for_each_point(const Shadow<Number> &slave, const Shadow<Number> &master, const Visitor &visit)
    {
      static const QGaussSimplex<2> rule(3);
      const auto                    master_pieces = master.pieces();
      for (const Polygon<Number> &window : slave.pieces())
        {
          const double whole = value(area(window));
          for (const Polygon<Number> &piece : master_pieces)
            {
              const Polygon<Number> common = clip(piece, window);
              if (common.size() < 3 || area(common) < 1e-12 * whole)
                continue;
              const Point2<Number> middle = centroid(common);
              for (std::size_t i = 0; i < common.size(); ++i)
                {
                  const Point2<Number> a           = common[i] - middle;
                  const Point2<Number> b           = common[(i + 1) % common.size()] - middle;
                  const Number         double_area = cross(a, b);
                  if (double_area < 1e-12 * whole)
                    continue;
                  for (unsigned int q = 0; q < rule.size(); ++q)
                    {
                      const double r = rule.point(q)[0], s = rule.point(q)[1];
                      visit(Point2<Number>{middle.x + r * a.x + s * b.x,
                                           middle.y + r * a.y + s * b.y},
                            Number(rule.weight(q) * double_area));
                    }
                }
            }
        }
    }
  } // namespace



  std::vector<OverlapPoint>
  overlap(const Face &slave, const Face &master)
  {
    const Positions<double> x = positions(slave);
    const Plane<double>     plane(slave, x);
    const Shadow<double>    slave_shadow(slave, x, plane);
    const Shadow<double>    master_shadow(master, positions(master), plane);

    std::vector<OverlapPoint> points;
    // Most faces that are near are beside it.
    if (apart(slave_shadow, master_shadow))
      return points;
    for_each_point(slave_shadow,
                   master_shadow,
                   [&](const Point2<double> &place, const double weight) {
                     OverlapPoint point;
                     double       slave_jacobian, master_jacobian;
                     if (!slave_shadow.invert(place.x, place.y, point.slave, slave_jacobian) ||
                         !master_shadow.invert(place.x, place.y, point.master, master_jacobian))
                       return;
                     // From the plane to the slave face.
                     const FacePoint on_slave = evaluate(slave, nullptr, point.slave);
                     const double    stretch =
                       cross_product_3d(on_slave.tangents[0], on_slave.tangents[1]).norm() /
                       std::abs(slave_jacobian);
                     point.weight = weight * stretch;
                     points.push_back(point);
                   });
    return points;
  }



  namespace
  {
    /** The implicit derivative of the face coordinates of a point of the plane,
     * x = sum N_m x_m. */
    template <typename Number, typename Gradients>
    void
    differentiate_inverse(const Shadow<Number> &shadow,
                          const FaceShapes     &shapes,
                          const Point2<Number> &place,
                          Gradients            &gradients)
    {
      Point2<double> t[2];
      shadow.evaluate(shapes, t);
      const double jacobian = cross(t[0], t[1]);
      for (unsigned int v = 0; v < gradients[0].size(); ++v)
        {
          Point2<double> r{place.x.fastAccessDx(v), place.y.fastAccessDx(v)};
          for (unsigned int m = 0; m < shadow.face.n_nodes(); ++m)
            {
              r.x -= shapes.value[m] * shadow.nodes[m].x.fastAccessDx(v);
              r.y -= shapes.value[m] * shadow.nodes[m].y.fastAccessDx(v);
            }
          gradients[0][v] = cross(r, t[1]) / jacobian;
          gradients[1][v] = cross(t[0], r) / jacobian;
        }
    }
  } // namespace



  template <unsigned int n>
  std::vector<OverlapPointDerivative<n>>
  differentiated_overlap(const Face &slave, const Face &master)
  {
    using Result                       = OverlapPointDerivative<n>;
    constexpr unsigned int n_variables = Result::n_variables;
    using Number                       = Sacado::Fad::SFad<double, int(n_variables)>;

    std::vector<Result> points;
    // Most faces that are near do not overlap.
    const Positions<double> slave_x = positions(slave), master_x = positions(master);
    {
      const Plane<double>  plane(slave, slave_x);
      const Shadow<double> of_slave(slave, slave_x, plane), of_master(master, master_x, plane);
      bool                 any = false;
      if (!apart(of_slave, of_master))
        for_each_point(of_slave, of_master, [&](const Point2<double> &, double) { any = true; });
      if (!any)
        return points;
    }

    Positions<Number> x, y;
    for (unsigned int m = 0; m < n; ++m)
      for (unsigned int d = 0; d < dim; ++d)
        {
          x[m][d] = Number(n_variables, dim * m + d, slave_x[m][d]);
          y[m][d] = Number(n_variables, dim * (n + m) + d, master_x[m][d]);
        }
    const Plane<Number>  plane(slave, x);
    const Shadow<Number> slave_shadow(slave, x, plane);
    const Shadow<Number> master_shadow(master, y, plane);

    for_each_point(
      slave_shadow, master_shadow, [&](const Point2<Number> &place, const Number &weight) {
        Result       point;
        double       slave_jacobian, master_jacobian;
        const double px = place.x.val(), py = place.y.val();
        if (!slave_shadow.invert(px, py, point.slave, slave_jacobian) ||
            !master_shadow.invert(px, py, point.master, master_jacobian))
          return;
        const FaceShapes shapes(slave.degree, point.slave);
        differentiate_inverse(slave_shadow, shapes, place, point.d_slave);
        differentiate_inverse(master_shadow,
                              FaceShapes(master.degree, point.master),
                              place,
                              point.d_master);

        // The stretch from the plane to the face: |t_1 x t_2| over the jacobian of
        // the shadow, each by the directions in which its tangents matter.
        const FacePoint      on_slave = evaluate(slave, nullptr, point.slave);
        const Tensor<1, dim> c       = cross_product_3d(on_slave.tangents[0], on_slave.tangents[1]);
        const double         size    = c.norm();
        const Tensor<1, dim> by_t[2] = {cross_product_3d(on_slave.tangents[1], c / (size * size)),
                                        cross_product_3d(c / (size * size), on_slave.tangents[0])};
        Point2<double>       t[2];
        slave_shadow.evaluate(shapes, t);
        const double         j          = cross(t[0], t[1]);
        const Point2<double> by_flat[2] = {{t[1].y / j, -t[1].x / j}, {-t[0].y / j, t[0].x / j}};

        const auto                hessians = shape_hessians(slave.degree, point.slave);
        double                    by_xi[2] = {0., 0.};
        typename Result::Gradient relative; // of the weight
        for (unsigned int v = 0; v < n_variables; ++v)
          relative[v] = weight.fastAccessDx(v) / weight.val();
        for (unsigned int m = 0; m < n; ++m)
          for (unsigned int a = 0; a < 2; ++a)
            {
              const auto  &flat     = slave_shadow.nodes[m];
              const double along    = by_flat[a].x * flat.x.val() + by_flat[a].y * flat.y.val();
              double       in_space = 0.;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  in_space += by_t[a][d] * slave_x[m][d];
                  relative[dim * m + d] += shapes.gradient[m][a] * by_t[a][d];
                }
              for (unsigned int b = 0; b < 2; ++b)
                by_xi[b] += hessians[m][a + b] * (in_space - along);
              const double gx = shapes.gradient[m][a] * by_flat[a].x,
                           gy = shapes.gradient[m][a] * by_flat[a].y;
              // The slave face's shadow depends on its own nodes only.
              for (unsigned int v = 0; v < n * dim; ++v)
                relative[v] -= gx * flat.x.fastAccessDx(v) + gy * flat.y.fastAccessDx(v);
            }
        point.weight = weight.val() * size / std::abs(slave_jacobian);
        for (unsigned int v = 0; v < n_variables; ++v)
          point.d_weight[v] = point.weight * (relative[v] + by_xi[0] * point.d_slave[0][v] +
                                              by_xi[1] * point.d_slave[1][v]);
        points.push_back(point);
      });
    return points;
  }

  template std::vector<OverlapPointDerivative<4>>
  differentiated_overlap<4>(const Face &, const Face &);
  template std::vector<OverlapPointDerivative<9>>
  differentiated_overlap<9>(const Face &, const Face &);
} // namespace Touchstone
