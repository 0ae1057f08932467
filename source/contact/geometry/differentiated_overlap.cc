// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/overlap.h>
#include <touchstone/contact/geometry/projected_face.h>

#include <algorithm>

// The quadrature points on the overlap of two faces with their derivatives by the positions of all
// nodes, for the consistent linearisation of averaged rows (doc/theory.md 4, "Derivatives of
// rows"). The clipping itself carries forward derivatives (Sacado); face coordinates and surface
// weights are differentiated by hand, because inverting a map by Newton's method with such numbers
// would cost many times as much.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The implicit derivative of the face coordinates xi of a point x of the plane: from
     * x = sum_m N_m(xi) x_m, J d xi = dx - sum_m N_m dx_m with J = [t_1, t_2]. */
    template <typename Number, typename Gradients>
    void
    differentiate_inverse(const ProjectedFace<Number> &face,
                          const FaceShapes            &shapes,
                          const Point2<Number>        &x,
                          Gradients                   &gradients)
    {
      Point2<double> t[2];
      face.evaluate(shapes, t);
      // The columns of J are the tangents t_1, t_2 in the plane; Cramer's rule solves the 2 x 2
      // system for each variable v.
      const double jacobian = cross(t[0], t[1]);
      for (unsigned int v = 0; v < gradients[0].size(); ++v)
        {
          Point2<double> r{x.x.fastAccessDx(v), x.y.fastAccessDx(v)};
          for (unsigned int m = 0; m < face.face.n_nodes(); ++m)
            {
              r.x -= shapes.value[m] * face.nodes[m].x.fastAccessDx(v);
              r.y -= shapes.value[m] * face.nodes[m].y.fastAccessDx(v);
            }
          gradients[0][v] = cross(r, t[1]) / jacobian;
          gradients[1][v] = cross(t[0], r) / jacobian;
        }
    }



    /** Set weight and d_weight of a point whose coordinates and their derivatives are known: the
     * weight in the plane times the surface Jacobian ratio of the slave face, |t_1 x t_2| over the
     * Jacobian j of its projection. Relative changes add up; each of the two is differentiated by
     * the directions in which its tangents matter, d |c| / |c| = sum_a b_a . dt_a. */
    template <unsigned int n, typename Number>
    void
    differentiate_area_weight(const Face                  &slave,
                              const Positions<double>     &x,
                              const ProjectedFace<Number> &projected,
                              const FaceShapes            &shapes,
                              const Number                &weight,
                              OverlapPointDerivative<n>   &point)
    {
      constexpr unsigned int n_variables = OverlapPointDerivative<n>::n_variables;
      // b_a in space: d|c| = c/|c| . (dt_1 x t_2 + t_1 x dt_2) gives t_2 x c/|c|^2 for dt_1 and
      // c/|c|^2 x t_1 for dt_2.
      const FacePoint      on_slave = evaluate(slave, nullptr, point.slave);
      const Tensor<1, dim> c        = cross_product_3d(on_slave.tangents[0], on_slave.tangents[1]);
      const double         size     = c.norm();
      const Tensor<1, dim> by_t[2]  = {cross_product_3d(on_slave.tangents[1], c / (size * size)),
                                       cross_product_3d(c / (size * size), on_slave.tangents[0])};
      Point2<double>       t[2];
      projected.evaluate(shapes, t);
      // The same for the Jacobian j = t_1 x t_2 of the projection, in the plane.
      const double         j          = cross(t[0], t[1]);
      const Point2<double> by_flat[2] = {{t[1].y / j, -t[1].x / j}, {-t[0].y / j, t[0].x / j}};

      // The tangents change with the nodes at a fixed xi (relative) and as xi itself moves on the
      // face (by_xi, over the second derivatives of the shapes).
      const auto hessians = shape_hessians(slave.degree, point.slave);
      double     by_xi[2] = {0., 0.};
      typename OverlapPointDerivative<n>::Gradient relative; // of the weight
      for (unsigned int v = 0; v < n_variables; ++v)
        relative[v] = weight.fastAccessDx(v) / weight.val();
      for (unsigned int m = 0; m < n; ++m)
        for (unsigned int a = 0; a < 2; ++a)
          {
            const auto  &flat     = projected.nodes[m];
            const double along    = by_flat[a].x * flat.x.val() + by_flat[a].y * flat.y.val();
            double       in_space = 0.;
            for (unsigned int d = 0; d < dim; ++d)
              {
                in_space += by_t[a][d] * x[m][d];
                relative[dim * m + d] += shapes.gradient[m][a] * by_t[a][d];
              }
            for (unsigned int b = 0; b < 2; ++b)
              // Entry a + b of the Hessians 11, 12, 22 is the derivative of tangent a by xi_b.
              by_xi[b] += hessians[m][a + b] * (in_space - along);
            const double gx = shapes.gradient[m][a] * by_flat[a].x,
                         gy = shapes.gradient[m][a] * by_flat[a].y;
            // The projection of the slave face depends on its own nodes only.
            for (unsigned int v = 0; v < n * dim; ++v)
              relative[v] -= gx * flat.x.fastAccessDx(v) + gy * flat.y.fastAccessDx(v);
          }
      point.weight = weight.val() * size / std::abs(j);
      for (unsigned int v = 0; v < n_variables; ++v)
        point.d_weight[v] = point.weight * (relative[v] + by_xi[0] * point.d_slave[0][v] +
                                            by_xi[1] * point.d_slave[1][v]);
    }



    /** Whether two faces overlap at all, tested without derivatives, which costs little. */
    bool
    overlaps(const Face              &slave,
             const Positions<double> &slave_x,
             const Face              &master,
             const Positions<double> &master_x)
    {
      const TangentPlane<double>  plane(slave, slave_x);
      const ProjectedFace<double> of_slave(slave, slave_x, plane),
        of_master(master, master_x, plane);
      bool any = false;
      if (!apart(of_slave, of_master))
        for_each_common_point(of_slave, of_master, [&](const Point2<double> &, double) {
          any = true;
        });
      return any;
    }
  } // namespace



  template <unsigned int n>
  std::vector<OverlapPointDerivative<n>>
  differentiated_overlap(const Face &slave, const Face &master)
  {
    using Result                       = OverlapPointDerivative<n>;
    constexpr unsigned int n_variables = Result::n_variables;
    using Number                       = Sacado::Fad::SFad<double, int(n_variables)>;

    std::vector<Result>     points;
    const Positions<double> slave_x = positions(slave), master_x = positions(master);
    // Most faces that are near do not overlap.
    if (!overlaps(slave, slave_x, master, master_x))
      return points;

    // The independent variables: first the positions of the slave nodes, then those of the master.
    Positions<Number> x, y;
    for (unsigned int m = 0; m < n; ++m)
      for (unsigned int d = 0; d < dim; ++d)
        {
          x[m][d] = Number(n_variables, dim * m + d, slave_x[m][d]);
          y[m][d] = Number(n_variables, dim * (n + m) + d, master_x[m][d]);
        }
    const TangentPlane<Number>  plane(slave, x);
    const ProjectedFace<Number> of_slave(slave, x, plane);
    const ProjectedFace<Number> of_master(master, y, plane);

    for_each_common_point(
      of_slave, of_master, [&](const Point2<Number> &position, const Number &weight) {
        Result point;
        // Values without derivatives suffice to invert the maps; the derivatives follow from the
        // implicit function theorem.
        const Point2<double> at{position.x.val(), position.y.val()};
        if (!of_slave.invert(at, point.slave) || !of_master.invert(at, point.master))
          return;
        const FaceShapes shapes(slave.degree, point.slave);
        point.weight = 0.;
        point.d_weight.fill(0.);
        differentiate_inverse(of_slave, shapes, position, point.d_slave);
        differentiate_inverse(of_master,
                              FaceShapes(master.degree, point.master),
                              position,
                              point.d_master);
        // Corners of the overlap have weight zero: they only take part in the smallest gap of a
        // row.
        if (weight.val() != 0.)
          differentiate_area_weight<n>(slave, slave_x, of_slave, shapes, weight, point);
        points.push_back(point);
      });
    return points;
  }

  template std::vector<OverlapPointDerivative<4>>
  differentiated_overlap<4>(const Face &, const Face &);
  template std::vector<OverlapPointDerivative<9>>
  differentiated_overlap<9>(const Face &, const Face &);
} // namespace Touchstone
