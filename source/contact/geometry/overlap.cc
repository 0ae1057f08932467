#include <touchstone/contact/geometry/bilinear.h>
#include <touchstone/contact/geometry/overlap.h>
#include <touchstone/contact/geometry/polygon.h>
#include <touchstone/contact/geometry/vector3.h>

#include <deal.II/base/quadrature_lib.h>

#include <Sacado.hpp>
#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
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
      /** Of the first tangent, and of the parallelogram of both. */
      Number length, area;

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
        area                   = sqrt(dot(normal, normal));
        length                 = sqrt(dot(t[0], t[0]));
        for (unsigned int d = 0; d < dim; ++d)
          {
            normal[d] /= area;
            e1[d] = t[0][d] / length;
          }
        e2 = cross(normal, e1);
      }
    };

    /** Whether @p xi are coordinates of a point on a face or not far beside it. */
    bool
    near(const std::array<double, 2> &xi)
    {
      return std::abs(xi[0]) < 1.5 && std::abs(xi[1]) < 1.5;
    }

    /** Where @p map takes the value @p x, by Newton's method.
     * @return false if that is not near the face. */
    bool
    invert(const Bilinear<2> &map, const Point2<double> &x, std::array<double, 2> &xi)
    {
      const auto          &c = map.c;
      const Point2<double> mixed{c[3][0], c[3][1]};
      Point2<double>       t[2] = {{c[1][0], c[1][1]}, {c[2][0], c[2][1]}};
      Point2<double>       r{x.x - c[0][0], x.y - c[0][1]};
      xi = {{0., 0.}};
      for (unsigned int iteration = 0; iteration < 20; ++iteration)
        {
          const double jacobian = cross(t[0], t[1]);
          if (jacobian == 0.)
            return false;
          const double inverse = 1. / jacobian;
          const double d[2]    = {inverse * cross(r, t[1]), inverse * cross(t[0], r)};
          xi[0] += d[0];
          xi[1] += d[1];
          // A step leaves nothing but its mixed term.
          r = {-d[0] * d[1] * mixed.x, -d[0] * d[1] * mixed.y};
          if (r.x * r.x + r.y * r.y < 1e-30 * std::abs(jacobian))
            break;
          t[0] = {c[1][0] + xi[1] * mixed.x, c[1][1] + xi[1] * mixed.y};
          t[1] = {c[2][0] + xi[0] * mixed.x, c[2][1] + xi[0] * mixed.y};
        }
      return near(xi);
    }

    /** A face projected onto a plane. */
    template <typename Number>
    struct Shadow
    {
      const Face                                 &face;
      std::array<Point2<Number>, Face::max_nodes> nodes;
      Bilinear<2>                                 bilinear; // if of degree 1

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
        if (face.degree == 1)
          bilinear = Bilinear<2>([this](const unsigned int m, const unsigned int d) {
            return value(d == 0 ? nodes[m].x : nodes[m].y);
          });
      }

      /** The bilinear pieces, counterclockwise. */
      boost::container::static_vector<Polygon<Number>, 4>
      pieces() const
      {
        boost::container::static_vector<Polygon<Number>, 4> result;
        const unsigned int                                  p = face.degree;
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

      /** Position and tangents, without derivatives. */
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
      invert(const double x, const double y, std::array<double, 2> &xi) const
      {
        if (face.degree == 1)
          return Touchstone::invert(bilinear, {x, y}, xi);
        xi = {{0., 0.}};
        for (unsigned int iteration = 0; iteration < 20; ++iteration)
          {
            Point2<double>       t[2];
            const Point2<double> position = evaluate(FaceShapes(face.degree, xi), t);
            const Point2<double> r{x - position.x, y - position.y};
            const double         jacobian = cross(t[0], t[1]);
            if (jacobian == 0.)
              return false;
            const double d[2] = {cross(r, t[1]) / jacobian, cross(t[0], r) / jacobian};
            xi[0] += d[0];
            xi[1] += d[1];
            // The error that is left is of the order of the square.
            if (std::abs(d[0]) + std::abs(d[1]) < 1e-8)
              break;
          }
        return near(xi);
      }
    };

    /** Whether the boxes around two shadows are no closer than @p distance. */
    bool
    apart(const Shadow<double> &a, const Shadow<double> &b, const double distance = 0.)
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
          if (of_a.second + distance <= of_b.first || of_b.second + distance <= of_a.first)
            return true;
        }
      return false;
    }

    /** The corner that is farthest in a direction along which faces have hardly ever an edge.
     * Where edges coincide round-off decides which corner clipping begins with. */
    template <typename Number>
    std::size_t
    first_corner(const Polygon<Number> &corners)
    {
      const auto way = [&](const std::size_t i) {
        return 0.927 * value(corners[i].x) + 0.375 * value(corners[i].y);
      };
      std::size_t first = 0;
      for (std::size_t i = 1; i < corners.size(); ++i)
        if (way(i) > way(first))
          first = i;
      return first;
    }

    /** Visit points of a polygon, with weights that integrate shape functions of degree one
     * and their squares exactly on plane facets: of quadrilaterals with a common corner, and of a
     * triangle if the number of corners is odd. The error on others depends on the corner that
     * comes first: if that changed in each iteration, nothing would converge. */
    template <typename Number, typename Visitor>
    void
    for_each_point(const Polygon<Number> &corners, const unsigned int degree, const Visitor &visit)
    {
      // Products of two functions of this degree, each in both directions.
      static const QGauss<2>                   squares[2]   = {QGauss<2>(3), QGauss<2>(5)};
      static const QWitherdenVincentSimplex<2> triangles[2] = {QWitherdenVincentSimplex<2>(3),
                                                               QWitherdenVincentSimplex<2>(5)};
      const Quadrature<2> &of_square = squares[degree - 1], &of_triangle = triangles[degree - 1];
      const std::size_t    n = corners.size(), first = first_corner(corners);
      const auto           corner = [&](const std::size_t i) { return corners[(first + i) % n]; };
      const Point2<Number> origin = corner(0);
      for (std::size_t i = 1; i + 1 < n; i += 2)
        {
          const Point2<Number> a = corner(i) - origin, b = corner(i + 1) - origin;
          if (i + 2 == n)
            {
              const Number double_area = cross(a, b);
              for (unsigned int q = 0; q < of_triangle.size(); ++q)
                {
                  const double r = of_triangle.point(q)[0], s = of_triangle.point(q)[1];
                  visit(Point2<Number>{origin.x + r * a.x + s * b.x, origin.y + r * a.y + s * b.y},
                        Number(of_triangle.weight(q) * double_area));
                }
              continue;
            }
          // origin + r a + s c + r s (b - a - c)
          const Point2<Number> c = corner(i + 2) - origin;
          const Point2<Number> mixed{b.x - a.x - c.x, b.y - a.y - c.y};
          for (unsigned int q = 0; q < of_square.size(); ++q)
            {
              const double         r = of_square.point(q)[0], s = of_square.point(q)[1];
              const Point2<Number> by_r{a.x + s * mixed.x, a.y + s * mixed.y};
              const Point2<Number> by_s{c.x + r * mixed.x, c.y + r * mixed.y};
              visit(Point2<Number>{origin.x + r * by_r.x + s * c.x,
                                   origin.y + r * by_r.y + s * c.y},
                    Number(of_square.weight(q) * cross(by_r, by_s)));
            }
        }
    }

    /** Visit the quadrature points on the common parts of two shadows, with place
     * and weight in the plane, and their corners with weight zero. */
    template <typename Number, typename Visitor>
    void
    for_each_point(const Shadow<Number> &slave, const Shadow<Number> &master, const Visitor &visit)
    {
      const auto master_pieces = master.pieces();
      for (const Polygon<Number> &window : slave.pieces())
        {
          const double whole = value(area(window));
          for (const Polygon<Number> &piece : master_pieces)
            {
              Polygon<Number> common = clip(piece, window);
              if (common.size() < 3 || area(common) < 1e-12 * whole)
                continue;
              remove_flat_corners(common, 1e-9 * whole);
              for_each_point(common, slave.face.degree, visit);
              for (const Point2<Number> &corner : common)
                visit(corner, Number(0.));
            }
        }
    }

    /** Area of a face per area of its shadow on a plane. */
    class Stretch
    {
    public:
      Stretch(const Face &face, const Positions<double> &x, const Plane<double> &plane)
        : face(face)
        , x(x)
        , normal(cross(plane.e1, plane.e2))
      {
        if (face.degree == 1)
          bilinear =
            Bilinear<dim>([&x](const unsigned int m, const unsigned int d) { return x[m][d]; });
      }

      double
      operator()(const std::array<double, 2> &xi) const
      {
        Vector3<double> place, t[2] = {{}, {}};
        if (face.degree == 1)
          bilinear.evaluate(xi, place, t);
        else
          {
            const FaceShapes shapes(face.degree, xi);
            for (unsigned int m = 0; m < face.n_nodes(); ++m)
              for (unsigned int a = 0; a < 2; ++a)
                for (unsigned int d = 0; d < dim; ++d)
                  t[a][d] += shapes.gradient[m][a] * x[m][d];
          }
        const Vector3<double> c = cross(t[0], t[1]);
        return std::sqrt(dot(c, c)) / std::abs(dot(c, normal));
      }

    private:
      const Face              &face;
      const Positions<double> &x;
      Vector3<double>          normal;
      Bilinear<dim>            bilinear; // if of degree 1
    };
  } // namespace



  std::vector<std::vector<OverlapPoint>>
  overlap(const Face &slave, const std::vector<const Face *> &masters)
  {
    const Positions<double> x = positions(slave);
    const Plane<double>     plane(slave, x);
    const Shadow<double>    slave_shadow(slave, x, plane);
    const Stretch           stretch(slave, x, plane);

    std::vector<std::vector<OverlapPoint>> result(masters.size());
    std::vector<OverlapPoint>              points;
    for (std::size_t f = 0; f < masters.size(); ++f)
      {
        const Shadow<double> master_shadow(*masters[f], positions(*masters[f]), plane);
        // Most faces that are near are beside it.
        if (apart(slave_shadow, master_shadow))
          continue;
        points.clear();
        for_each_point(slave_shadow,
                       master_shadow,
                       [&](const Point2<double> &place, const double weight) {
                         OverlapPoint point;
                         if (!slave_shadow.invert(place.x, place.y, point.slave) ||
                             !master_shadow.invert(place.x, place.y, point.master))
                           return;
                         point.weight = weight * stretch(point.slave);
                         points.push_back(point);
                       });
        result[f] = points;
      }
    return result;
  }



  std::vector<OverlapPoint>
  overlap(const Face &slave, const Face &master)
  {
    return overlap(slave, std::vector<const Face *>{&master})[0];
  }



  bool
  may_overlap(const Face &slave, const Face &master, const double motion)
  {
    const Positions<double> x = positions(slave), y = positions(master);
    const Plane<double>     plane(slave, x);
    const Vector3<double>   normal = cross(plane.e1, plane.e2);
    double                  height = 0.;
    for (unsigned int m = 0; m < master.n_nodes(); ++m)
      height = std::max(height, std::abs(dot(normal, y[m]) - dot(normal, plane.origin)));
    // The plane may tilt, and then shadows move by the height.
    const double tilt = motion * (1. / plane.length + plane.length / plane.area);
    return !apart(Shadow<double>(slave, x, plane),
                  Shadow<double>(master, y, plane),
                  2. * (2. * motion + tilt * height));
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
        const double px = place.x.val(), py = place.y.val();
        if (!slave_shadow.invert(px, py, point.slave) ||
            !master_shadow.invert(px, py, point.master))
          return;
        const FaceShapes shapes(slave.degree, point.slave);
        point.weight = 0.;
        point.d_weight.fill(0.);
        differentiate_inverse(slave_shadow, shapes, place, point.d_slave);
        differentiate_inverse(master_shadow,
                              FaceShapes(master.degree, point.master),
                              place,
                              point.d_master);
        if (weight.val() == 0.)
          {
            points.push_back(point);
            return;
          }

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
        point.weight = weight.val() * size / std::abs(j);
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
