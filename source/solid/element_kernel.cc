#include <touchstone/solid/element_kernel.h>
#include <touchstone/vectorised.h>

#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The upper part of X^T X, of @p m rows of @p n numbers each, with all of the blocks
     * on the diagonal. */
    TOUCHSTONE_VECTORISED void
    upper_part_of_square(const unsigned int n,
                         const unsigned int m,
                         const double      *x,
                         double            *result)
    {
      std::fill(result, result + n * n, 0.);
      for (unsigned int r = 0; r < n; ++r)
        for (unsigned int q = 0; q < m; ++q)
          {
            const double  factor = x[n * q + r];
            const double *other  = x + n * q;
            double       *row    = result + n * r;
            for (unsigned int c = r / dim * dim; c < n; ++c)
              row[c] += factor * other[c];
          }
    }
  } // namespace



  ElementKernel::ElementKernel(const Mapping<dim>       &mapping,
                               const FiniteElement<dim> &fe,
                               const ElementType         type,
                               const MaterialParameters &material)
    : type(type)
    , lambda(material.young_modulus * material.poisson_ratio /
             ((1. + material.poisson_ratio) * (1. - 2. * material.poisson_ratio)))
    , mu(material.young_modulus / (2. * (1. + material.poisson_ratio)))
    , quadrature(fe.degree + 1)
    , scalar_fe(fe.degree)
    , values(mapping,
             scalar_fe,
             quadrature,
             update_gradients | update_JxW_values | update_quadrature_points |
               update_inverse_jacobians | update_jacobians)
    , centre(mapping, scalar_fe, QGauss<dim>(1), update_inverse_jacobians | update_jacobians)
    , node_dof(fe.n_dofs_per_cell())
    , n_nodes(scalar_fe.n_dofs_per_cell())
    , n_modes(type == ElementType::incompatible_modes ? dim : 0)
    , n_points(quadrature.size())
    , gradients(n_points, std::vector<Tensor<1, dim>>(n_nodes + n_modes))
    , mean_gradients(n_nodes)
    , weighted(dim * (n_nodes + n_modes) * n_points)
    , products(dim * dim * (n_nodes + n_modes) * (n_nodes + n_modes))
    , full(dim * (n_nodes + n_modes), dim * (n_nodes + n_modes))
    , condensed(dim * n_nodes, dim * n_nodes)
    , recovery(dim * n_modes, dim * n_nodes)
  {
    for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
      {
        const auto [component, node]     = fe.system_to_component_index(i);
        node_dof[dim * node + component] = i;
      }
  }



  void
  ElementKernel::reinit(const typename DoFHandler<dim>::active_cell_iterator &cell)
  {
    const typename Triangulation<dim>::cell_iterator geometry = cell;
    values.reinit(geometry);
    cell_volume = 0.;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        for (unsigned int a = 0; a < n_nodes; ++a)
          gradients[q][a] = values.shape_grad(a, q);
        cell_volume += values.JxW(q);
      }
    if (type == ElementType::b_bar)
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          mean_gradients[a] = Tensor<1, dim>();
          for (unsigned int q = 0; q < n_points; ++q)
            mean_gradients[a] += values.JxW(q) / cell_volume * gradients[q][a];
        }
    if (n_modes > 0)
      {
        // Mode k is 1 - (2 x_k - 1)^2 on the unit cell. With the Jacobian of the
        // centre, and scaled by the ratio of determinants, its gradient
        // integrates to zero: constant stress does no work on it.
        centre.reinit(geometry);
        const Tensor<2, dim> inverse  = Tensor<2, dim>(centre.inverse_jacobian(0));
        const double         j_centre = determinant(Tensor<2, dim>(centre.jacobian(0)));
        for (unsigned int q = 0; q < n_points; ++q)
          {
            const double ratio = j_centre / determinant(Tensor<2, dim>(values.jacobian(q)));
            for (unsigned int k = 0; k < n_modes; ++k)
              gradients[q][n_nodes + k] =
                ratio * (-4.) * (2. * quadrature.point(q)[k] - 1.) * inverse[k];
          }
      }
  }



  void
  ElementKernel::integrate()
  {
    // With G_ab = sum_q w grad N_a (x) grad N_b the stiffness of two nodes is
    // lambda G_ab + mu (G_ab^T + tr G_ab I). With B-bar the volumetric part is
    // that of the mean gradients, with the bulk modulus, and the rest is
    // deviatoric.
    const bool         b_bar   = (type == ElementType::b_bar);
    const double       bulk    = lambda + 2. / 3. * mu;
    const double       lambda_ = b_bar ? -2. / 3. * mu : lambda;
    const unsigned int n       = n_nodes + n_modes;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const double factor = std::sqrt(values.JxW(q));
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            weighted[dim * (n * q + a) + i] = factor * gradients[q][a][i];
      }
    upper_part_of_square(dim * n, n_points, weighted.data(), products.data());
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = a; b < n; ++b)
        {
          const double *g     = &products[dim * (dim * n * a + b)];
          const double  trace = g[0] + g[dim * n + 1] + g[2 * (dim * n + 1)];
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              {
                double k =
                  lambda_ * g[dim * n * i + j] + mu * (g[dim * n * j + i] + (i == j ? trace : 0.));
                if (b_bar)
                  k += bulk * cell_volume * mean_gradients[a][i] * mean_gradients[b][j];
                full(dim * a + i, dim * b + j) = k;
                full(dim * b + j, dim * a + i) = k;
              }
        }
  }



  const FullMatrix<double> &
  ElementKernel::stiffness()
  {
    integrate();
    if (n_modes == 0)
      return full;
    const unsigned int n = dim * n_nodes;
    const unsigned int m = dim * n_modes;
    FullMatrix<double> inner(m, m);
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        inner(i, j) = full(n + i, n + j);
    inner.gauss_jordan();
    recovery = 0.;
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int k = 0; k < m; ++k)
        for (unsigned int j = 0; j < n; ++j)
          recovery(i, j) -= inner(i, k) * full(n + k, j);
    for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int j = i; j < n; ++j)
          condensed(i, j) = full(i, j);
        for (unsigned int k = 0; k < m; ++k)
          {
            const double factor = full(n + k, i);
            for (unsigned int j = i; j < n; ++j)
              condensed(i, j) += factor * recovery(k, j);
          }
        for (unsigned int j = i + 1; j < n; ++j)
          condensed(j, i) = condensed(i, j);
      }
    return condensed;
  }



  void
  ElementKernel::set_displacement(const std::vector<double> &u)
  {
    displacement = u;
    if (n_modes > 0)
      {
        stiffness();
        for (unsigned int i = 0; i < dim * n_modes; ++i)
          {
            double sum = 0.;
            for (unsigned int j = 0; j < dim * n_nodes; ++j)
              sum += recovery(i, j) * u[j];
            displacement.push_back(sum);
          }
      }
    mean_dilatation = 0.;
    if (type == ElementType::b_bar)
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int i = 0; i < dim; ++i)
          mean_dilatation += mean_gradients[a][i] * u[dim * a + i];
  }



  SymmetricTensor<2, dim>
  ElementKernel::stress(const unsigned int q) const
  {
    Tensor<2, dim> gradient;
    for (unsigned int a = 0; a < n_nodes + n_modes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        gradient[i] += displacement[dim * a + i] * gradients[q][a];
    SymmetricTensor<2, dim> strain = symmetrize(gradient);
    if (type == ElementType::b_bar)
      strain += (mean_dilatation - trace(strain)) / dim * unit_symmetric_tensor<dim>();
    return lambda * trace(strain) * unit_symmetric_tensor<dim>() + 2. * mu * strain;
  }
} // namespace Touchstone
