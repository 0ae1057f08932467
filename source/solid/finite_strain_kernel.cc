#include <touchstone/solid/finite_strain_kernel.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Add w A : (grad N_a, grad N_b) of a quadrature point to the blocks
     * [a][i][k][b], a <= b. The number of nodes is known to the compiler: this loop
     * takes most of the time of an assembly. */
    template <unsigned int n>
    void
    add_point(const double *gradient, const double weight, const Tensor<4, dim> &A, double *blocks)
    {
      const double *g[dim] = {gradient, gradient + n, gradient + 2 * n};
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int k = 0; k < dim; ++k)
            {
              double left[dim];
              for (unsigned int l = 0; l < dim; ++l)
                left[l] = weight * (g[0][a] * A[i][0][k][l] + g[1][a] * A[i][1][k][l] +
                                    g[2][a] * A[i][2][k][l]);
              double *block = blocks + ((a * dim + i) * dim + k) * n;
              for (unsigned int b = a; b < n; ++b)
                block[b] += left[0] * g[0][b] + left[1] * g[1][b] + left[2] * g[2][b];
            }
    }
  } // namespace



  FiniteStrainKernel::FiniteStrainKernel(const unsigned int        degree,
                                         const ElementType         type,
                                         const MaterialParameters &material)
    : f_bar(type == ElementType::f_bar)
    , law(HyperelasticRegistry::make(material.law, material))
    , n_nodes(Utilities::pow(degree + 1, dim))
    , n_points(Utilities::pow(degree + 1, dim))
    , points(n_points)
    , nodal_force(dim * n_nodes)
    , blocks(dim * dim * n_nodes * n_nodes)
    , matrix(dim * dim * n_nodes * n_nodes)
    , mean_gradient(dim * n_nodes)
    , mixed(dim * n_nodes)
  {
    Assert(f_bar || type == ElementType::full, ExcNotImplemented());
    const QGauss<dim> quadrature(degree + 1);
    const FE_Q<dim>   fe(degree);
    unit_weights = quadrature.get_weights();
    gradients.resize(n_points * dim * n_nodes);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        for (unsigned int a = 0; a < n_nodes; ++a)
          shapes.push_back(fe.shape_value(a, quadrature.point(q)));
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int a = 0; a < n_nodes; ++a)
            unit_gradients.push_back(fe.shape_grad(a, quadrature.point(q))[d]);
      }
  }



  double
  FiniteStrainKernel::reinit(const double *positions, const double *displacement)
  {
    double smallest = std::numeric_limits<double>::max(), present_volume = 0.;
    cell_volume = 0.;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        PointData    &point = points[q];
        const double *unit  = &unit_gradients[q * dim * n_nodes];
        // dX/dxi and du/dxi: the cell is isoparametric.
        Tensor<2, dim> jacobian, unit_gradient;
        point.position = Point<dim>();
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            {
              point.position[i] += shapes[q * n_nodes + a] * positions[dim * a + i];
              for (unsigned int d = 0; d < dim; ++d)
                {
                  jacobian[i][d] += positions[dim * a + i] * unit[d * n_nodes + a];
                  unit_gradient[i][d] += displacement[dim * a + i] * unit[d * n_nodes + a];
                }
            }
        const Tensor<2, dim> inverse = invert(jacobian);
        double              *g       = gradient(q);
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int a = 0; a < n_nodes; ++a)
            g[d * n_nodes + a] = unit[a] * inverse[0][d] + unit[n_nodes + a] * inverse[1][d] +
                                 unit[2 * n_nodes + a] * inverse[2][d];
        point.weight = unit_weights[q] * determinant(jacobian);
        point.F      = unit_gradient * inverse;
        for (unsigned int d = 0; d < dim; ++d)
          point.F[d][d] += 1.;
        point.J = determinant(point.F);
        cell_volume += point.weight;
        present_volume += point.weight * point.J;
        smallest = std::min(smallest, point.J);
      }
    // False for what is not a number, too.
    if (!(smallest > 0.))
      return std::isnan(smallest) ? 0. : smallest;

    mean_J = present_volume / cell_volume;
    for (PointData &point : points)
      {
        point.H     = transpose(invert(point.F));
        point.alpha = f_bar ? std::cbrt(mean_J / point.J) : 1.;
        point.F_bar = point.alpha * point.F;
      }
    return smallest;
  }



  double
  FiniteStrainKernel::energy() const
  {
    double sum = 0.;
    for (const PointData &point : points)
      sum += point.weight * law->energy(point.F_bar);
    return sum;
  }



  void
  FiniteStrainKernel::set_mean_gradient()
  {
    // v = sum_q w J and dJ = J H : dF.
    std::fill(mean_gradient.begin(), mean_gradient.end(), 0.);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const PointData &point  = points[q];
        const double    *g      = gradient(q);
        const double     factor = point.weight * point.J / (mean_J * cell_volume);
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int d = 0; d < dim; ++d)
              mean_gradient[dim * a + i] += factor * point.H[i][d] * g[d * n_nodes + a];
      }
  }



  const std::vector<double> &
  FiniteStrainKernel::force()
  {
    // dFbar = alpha dF + Fbar (d ln Jbar - d ln J) / 3.
    std::fill(nodal_force.begin(), nodal_force.end(), 0.);
    double pressure = 0.;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const PointData &point  = points[q];
        const double    *g      = gradient(q);
        Tensor<2, dim>   stress = law->stress(point.F_bar);
        if (f_bar)
          {
            const double third = scalar_product(stress, point.F_bar) / 3.;
            pressure += point.weight * third;
            stress = point.alpha * stress - third * point.H;
          }
        stress *= point.weight;
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            nodal_force[dim * a + i] += stress[i][0] * g[a] + stress[i][1] * g[n_nodes + a] +
                                        stress[i][2] * g[2 * n_nodes + a];
      }
    if (f_bar)
      {
        set_mean_gradient();
        for (unsigned int i = 0; i < n_dofs(); ++i)
          nodal_force[i] += pressure * mean_gradient[i];
      }
    return nodal_force;
  }



  double
  FiniteStrainKernel::modify_tangent(const unsigned int q, const double pressure, Tensor<4, dim> &A)
  {
    // With R = A : Fbar, S = P + R and p = P : Fbar / 3 the energy W(Fbar) as a function
    // of F and t = ln Jbar has the second derivatives
    //   FF: alpha^2 A - alpha/3 (S x H + H x S) + (S : Fbar)/9 H x H + p X,
    //   Ft: alpha/3 S - (S : Fbar)/9 H,    tt: (S : Fbar)/9,
    // where X_iJkL = H_iL H_kJ. To FF comes the share of the second derivative of t
    // itself, as a function of the displacements: J/(Jbar V) (H x H - X) - dt dt.
    const PointData &point = points[q];
    Tensor<2, dim>   S     = point.P;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        S[i][j] += scalar_product(A[i][j], point.F_bar);
    const double second   = scalar_product(S, point.F_bar) / 9.;
    const double dilation = pressure * point.J / (mean_J * cell_volume);
    const double product  = second + dilation;
    const double exchange = scalar_product(point.P, point.F_bar) / 3. - dilation;
    const double square   = point.alpha * point.alpha;
    S *= point.alpha / 3.;
    const Tensor<2, dim> &H = point.H;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            A[i][j][k][l] = square * A[i][j][k][l] - S[i][j] * H[k][l] - H[i][j] * S[k][l] +
                            product * H[i][j] * H[k][l] + exchange * H[i][l] * H[k][j];

    const Tensor<2, dim> mixed_stress = point.weight * (S - second * H);
    const double        *g            = gradient(q);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          mixed[dim * a + i] += mixed_stress[i][d] * g[d * n_nodes + a];
    return point.weight * second;
  }



  const std::vector<double> &
  FiniteStrainKernel::stiffness()
  {
    std::fill(blocks.begin(), blocks.end(), 0.);
    double pressure = 0., second = 0.;
    if (f_bar)
      {
        set_mean_gradient();
        std::fill(mixed.begin(), mixed.end(), 0.);
        for (PointData &point : points)
          {
            point.P = law->stress(point.F_bar);
            pressure += point.weight * scalar_product(point.P, point.F_bar) / 3.;
          }
      }
    for (unsigned int q = 0; q < n_points; ++q)
      {
        Tensor<4, dim> A = law->tangent(points[q].F_bar);
        if (f_bar)
          second += modify_tangent(q, pressure, A);
        (n_nodes == 8 ? add_point<8>
                      : add_point<27>)(gradient(q), points[q].weight, A, blocks.data());
      }
    const unsigned int n = n_dofs();
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int b = a; b < n_nodes; ++b)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int k = 0; k < dim; ++k)
            {
              double value = blocks[((a * dim + i) * dim + k) * n_nodes + b];
              if (f_bar)
                value +=
                  mixed[dim * a + i] * mean_gradient[dim * b + k] +
                  mean_gradient[dim * a + i] * mixed[dim * b + k] +
                  (second - pressure) * mean_gradient[dim * a + i] * mean_gradient[dim * b + k];
              matrix[(dim * a + i) * n + dim * b + k] = value;
              matrix[(dim * b + k) * n + dim * a + i] = value;
            }
    return matrix;
  }



  SymmetricTensor<2, dim>
  FiniteStrainKernel::stress(const unsigned int q) const
  {
    const PointData &point = points[q];
    return symmetrize(law->stress(point.F_bar) * transpose(point.F_bar)) / determinant(point.F_bar);
  }
} // namespace Touchstone
