// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/facing_part.h>
#include <touchstone/contact/pairing/opposite_point.h>
#include <touchstone/contact/pairing/overlap_sample.h>

// What is integrated at one quadrature point of an overlap: weight, shapes, gap vector and normal,
// and the same with derivatives by the positions of the nodes of both faces (doc/theory.md 3 and
// 4).
namespace Touchstone
{
  using namespace dealii;

  template <unsigned int n>
  bool
  evaluate(const OverlapPoint       &point,
           const FaceGeometry       &slave,
           const FaceGeometry       &master,
           const Tensor<1, dim>     &plane,
           OverlapSample<n, double> &sample)
  {
    const FaceShapes      shapes(slave.face().degree, point.slave);
    const Point<dim>      x  = slave.position(point.slave, shapes);
    std::array<double, 2> xi = point.master;
    FacePoint             on_master;
    if (!find_opposite_point(slave, x, master, plane, xi, on_master))
      return false;
    // The contact normal is that of the master surface, possibly averaged or smoothed; the cosine
    // below is about the surface itself.
    const FaceShapes     master_shapes(master.face().degree, xi);
    const Tensor<1, dim> normal = master.normal(master_shapes, on_master);
    const double         part =
      FacingPart(facing_cosine(plane, normal, master.face(), master.exact_surface(), xi)).value;
    // Master surface too steep here: the point counts as not covered.
    if (part == 0.)
      return false;
    // Gap vector from master to slave, as in pointwise rows: g = n . gap < 0 is penetration
    // (doc/theory.md 1).
    const Tensor<1, dim> gap = x - on_master.x;
    sample.weight            = part * point.weight;
    sample.inclined          = 1. - part;
    Tensor<1, dim> arch      = x, moved;
    for (unsigned int m = 0; m < n; ++m)
      {
        sample.slave_shape[m]  = shapes.value[m];
        sample.master_shape[m] = master_shapes.value[m];
        moved += shapes.value[m] * slave.face().displacement[m] -
                 master_shapes.value[m] * master.face().displacement[m];
        arch -= shapes.value[m] * slave.face().position(m);
      }
    sample.arch = arch.norm();
    for (unsigned int d = 0; d < dim; ++d)
      {
        sample.gap[d]    = gap[d];
        sample.normal[d] = normal[d];
        sample.moved[d]  = moved[d];
      }
    return true;
  }



  namespace
  {
    /** The derivative of the cosine between the slave plane and the master surface at @p point,
     * c = -zeta . nu, nu = x,1 x x,2 / |x,1 x x,2| (doc/theory.md 3.2). Here nu is the normal of
     * the master surface itself: averaged normals hide how steep a single face is. */
    template <unsigned int n>
    typename OverlapPointDerivative<n>::Gradient
    cosine_derivative(const Face                      &slave,
                      const OverlapPointDerivative<n> &point,
                      const FaceGeometry              &master,
                      const FaceDerivative            &on_master)
    {
      const Face          &face  = master.face();
      const Tensor<1, dim> plane = plane_normal(slave);
      const FaceShapes     shapes(face.degree, point.master);
      const FacePoint      x       = evaluate(face, master.exact_surface(), point.master);
      const Tensor<1, dim> product = cross_product_3d(x.tangents[0], x.tangents[1]);
      // c = sign * zeta . product / |product|, as in facing_cosine().
      const double         sign = product * on_master.normal < 0. ? 1. : -1.;
      const Tensor<1, dim> nu   = sign * product / product.norm();
      // d c = by_product . d(t_1 x t_2), from the derivative of the unit vector, and d(t_1 x t_2) =
      // dt_1 x t_2 + t_1 x dt_2.
      const Tensor<1, dim>          by_product = sign * (plane * normalisation_derivative(product));
      const Tensor<1, dim>          by_t[2]    = {cross_product_3d(x.tangents[1], by_product),
                                                  cross_product_3d(by_product, x.tangents[0])};
      std::array<Tensor<1, dim>, 3> second;
      const bool                    exact = master.exact_surface() != nullptr;
      if (exact)
        second = master.second_derivatives(point.master);
      else
        {
          // Of the facet, not of the patch over it.
          const auto hessians = shape_hessians(face.degree, point.master);
          for (unsigned int m = 0; m < n; ++m)
            for (unsigned int s = 0; s < 3; ++s)
              second[s] += hessians[m][s] * face.position(m);
        }
      // The master point moves on its face as the overlap changes.
      const double by_xi[2] = {by_t[0] * second[0] + by_t[1] * second[1],
                               by_t[0] * second[1] + by_t[1] * second[2]};
      const auto   by_slave = plane_normal_derivatives(slave);

      typename OverlapPointDerivative<n>::Gradient result;
      for (unsigned int v = 0; v < OverlapPointDerivative<n>::n_variables; ++v)
        result[v] = by_xi[0] * point.d_master[0][v] + by_xi[1] * point.d_master[1][v];
      for (unsigned int m = 0; m < n; ++m)
        {
          // Slave nodes tilt the plane zeta; master nodes change nu over the tangents.
          const Tensor<1, dim> by_node = nu * by_slave[m];
          Tensor<1, dim>       by_master;
          for (unsigned int a = 0; a < 2; ++a)
            by_master +=
              exact ? by_t[a] * on_master.tangent_position[a][m] : shapes.gradient[m][a] * by_t[a];
          for (unsigned int e = 0; e < dim; ++e)
            {
              result[dim * m + e] += by_node[e];
              result[dim * (n + m) + e] += by_master[e];
            }
        }
      return result;
    }



    /** The weight of a point, reduced by FacingPart where the surfaces are inclined, and by how
     * much less than all that is. @return false if nothing is left. */
    template <unsigned int n>
    bool
    differentiate_weight(const Face                      &slave,
                         const OverlapPointDerivative<n> &point,
                         const FaceGeometry              &master,
                         const FaceDerivative            &on_master,
                         PositionFad<n>                  &weight,
                         PositionFad<n>                  &inclined)
    {
      constexpr unsigned int n_variables = OverlapPointDerivative<n>::n_variables;
      const double           cosine      = facing_cosine(
        plane_normal(slave), on_master.normal, master.face(), master.exact_surface(), point.master);
      // Product rule: weight = S(c) times area weight.
      const FacingPart part(cosine);
      weight.val() = part.value * point.weight;
      inclined     = 1. - part.value;
      for (unsigned int v = 0; v < n_variables; ++v)
        weight.fastAccessDx(v) = part.value * point.d_weight[v];
      // Up to 45 degrees the factor is constant, and this costs nothing.
      if (part.by_cosine != 0.)
        {
          const auto d_cosine = cosine_derivative<n>(slave, point, master, on_master);
          for (unsigned int v = 0; v < n_variables; ++v)
            {
              weight.fastAccessDx(v) += point.weight * part.by_cosine * d_cosine[v];
              inclined.fastAccessDx(v) = -part.by_cosine * d_cosine[v];
            }
        }
      return part.value > 0.;
    }



    /** Displacement and arch of a sample whose shape functions are known. */
    template <unsigned int n>
    void
    differentiate_shape(const OverlapPointDerivative<n>  &point,
                        const Face                       &slave,
                        const FacePosition               &on_slave,
                        const Face                       &master,
                        OverlapSample<n, PositionFad<n>> &sample)
    {
      PositionFad<n> square(0.);
      for (unsigned int d = 0; d < dim; ++d)
        {
          // The point on the surface itself, which moves on its face and with the nodes.
          PositionFad<n> arch(on_slave.point.x[d]);
          for (unsigned int v = 0; v < OverlapPointDerivative<n>::n_variables; ++v)
            arch.fastAccessDx(v) = on_slave.point.tangents[0][d] * point.d_slave[0][v] +
                                   on_slave.point.tangents[1][d] * point.d_slave[1][v];
          for (unsigned int m = 0; m < n; ++m)
            for (unsigned int e = 0; e < dim; ++e)
              arch.fastAccessDx(dim * m + e) += on_slave.x_position[m][d][e];
          sample.moved[d] = 0.;
          for (unsigned int m = 0; m < n; ++m)
            {
              const auto at_node = [](const double value, const unsigned int variable) {
                return PositionFad<n>(OverlapPointDerivative<n>::n_variables, variable, value);
              };
              // A node that moves changes its displacement by as much as its position.
              sample.moved[d] +=
                sample.slave_shape[m] * at_node(slave.displacement[m][d], dim * m + d) -
                sample.master_shape[m] * at_node(master.displacement[m][d], dim * (n + m) + d);
              arch -= sample.slave_shape[m] * at_node(slave.position(m)[d], dim * m + d);
            }
          square += arch * arch;
        }
      // Facets have no arch, and a root of zero no derivative.
      sample.arch = square.val() > 0. ? PositionFad<n>(sqrt(square)) : PositionFad<n>(0.);
    }
  } // namespace



  template <unsigned int n>
  bool
  differentiate(const OverlapPointDerivative<n>  &point,
                const FaceGeometry               &slave,
                const FacePosition               &on_slave,
                const FaceGeometry               &master,
                const FaceDerivative             &on_master,
                OverlapSample<n, PositionFad<n>> &sample)
  {
    constexpr unsigned int n_variables = OverlapPointDerivative<n>::n_variables;
    if (!differentiate_weight<n>(
          slave.face(), point, master, on_master, sample.weight, sample.inclined))
      return false;

    // Both points move on their faces as the overlap changes (d xi), and with the nodes.
    for (unsigned int d = 0; d < dim; ++d)
      {
        PositionFad<n> &gap = sample.gap[d], &normal = sample.normal[d];
        // Total derivative: over the coordinates d xi on both faces first.
        gap.val()    = on_slave.point.x[d] - on_master.point.x[d];
        normal.val() = on_master.normal[d];
        for (unsigned int v = 0; v < n_variables; ++v)
          {
            double d_gap = 0., d_normal = 0.;
            for (unsigned int a = 0; a < 2; ++a)
              {
                d_gap += on_slave.point.tangents[a][d] * point.d_slave[a][v] -
                         on_master.point.tangents[a][d] * point.d_master[a][v];
                d_normal += on_master.normal_xi[a][d] * point.d_master[a][v];
              }
            gap.fastAccessDx(v)    = d_gap;
            normal.fastAccessDx(v) = d_normal;
          }
        for (unsigned int m = 0; m < n; ++m)
          for (unsigned int e = 0; e < dim; ++e)
            {
              // Then at fixed xi, directly by the positions of slave and master nodes.
              gap.fastAccessDx(dim * m + e) += on_slave.x_position[m][d][e];
              gap.fastAccessDx(dim * (n + m) + e) -= on_master.x_position[m][d][e];
              normal.fastAccessDx(dim * (n + m) + e) += on_master.normal_position[m][d][e];
            }
      }
    for (unsigned int m = 0; m < n; ++m)
      {
        // Shape functions change by xi alone.
        const auto shape = [&](const FaceShapes                                     &shapes,
                               const std::array<std::array<double, n_variables>, 2> &d_xi) {
          PositionFad<n> result(shapes.value[m]);
          for (unsigned int v = 0; v < n_variables; ++v)
            result.fastAccessDx(v) =
              shapes.gradient[m][0] * d_xi[0][v] + shapes.gradient[m][1] * d_xi[1][v];
          return result;
        };
        sample.slave_shape[m]  = shape(on_slave.shapes, point.d_slave);
        sample.master_shape[m] = shape(on_master.shapes, point.d_master);
      }
    differentiate_shape<n>(point, slave.face(), on_slave, master.face(), sample);
    return true;
  }



  template bool
  evaluate<4>(const OverlapPoint &,
              const FaceGeometry &,
              const FaceGeometry &,
              const Tensor<1, dim> &,
              OverlapSample<4, double> &);
  template bool
  evaluate<9>(const OverlapPoint &,
              const FaceGeometry &,
              const FaceGeometry &,
              const Tensor<1, dim> &,
              OverlapSample<9, double> &);
  template bool
  differentiate<4>(const OverlapPointDerivative<4> &,
                   const FaceGeometry &,
                   const FacePosition &,
                   const FaceGeometry &,
                   const FaceDerivative &,
                   OverlapSample<4, PositionFad<4>> &);
  template bool
  differentiate<9>(const OverlapPointDerivative<9> &,
                   const FaceGeometry &,
                   const FacePosition &,
                   const FaceGeometry &,
                   const FaceDerivative &,
                   OverlapSample<9, PositionFad<9>> &);
} // namespace Touchstone
