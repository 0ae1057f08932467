// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/element_kernel.h>

#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <cmath>

// Linear elastic cells of small strain with the choice of elements of doc/theory.md 2.1: full
// integration, B-bar, incompatible modes. This class evaluates geometry and stresses of a cell
// with FEValues; the sums of its stiffness are done by ElementStiffness, for eight cells at
// once.
namespace Touchstone
{
  using namespace dealii;

  ElementKernel::ElementKernel(const Mapping<dim>       &mapping,
                               const FiniteElement<dim> &fe,
                               const ElementType         type,
                               const MaterialParameters &material)
    : type(type)
    , material(material)
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
    , own(type, material, n_nodes, n_modes, n_points)
  {
    // Inside the kernel dofs are ordered by nodes, dim * node + component, whatever the order of
    // the FESystem is.
    for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
      {
        const auto [component, node]     = fe.system_to_component_index(i);
        node_dof[dim * node + component] = i;
      }
  }



  /** Gradients of the shapes and of the incompatible modes at the quadrature points of a cell. */
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
    // B-bar: the divergence of a shape function is replaced by its mean over the cell,
    // volume-weighted.
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



  template <unsigned int n_cells>
  void
  ElementKernel::set_gradients(ElementStiffness<n_cells> &stiffness,
                               const unsigned int         begin,
                               const unsigned int         end) const
  {
    for (unsigned int q = 0; q < n_points; ++q)
      {
        // Gradients are scaled by the root of the integration weight, so that the stiffness is a
        // plain sum of products of two gradients without a third factor in its innermost loop.
        const double factor = std::sqrt(values.JxW(q));
        for (unsigned int a = 0; a < n_nodes + n_modes; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            std::fill(&stiffness.gradient(q, a, i, begin),
                      &stiffness.gradient(q, a, i, begin) + (end - begin),
                      factor * gradients[q][a][i]);
      }
    if (type == ElementType::b_bar)
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int i = 0; i < dim; ++i)
          std::fill(&stiffness.mean_gradient(a, i, begin),
                    &stiffness.mean_gradient(a, i, begin) + (end - begin),
                    std::sqrt(cell_volume) * mean_gradients[a][i]);
  }



  const ElementStiffness<1> &
  ElementKernel::stiffness()
  {
    set_gradients(own, 0, 1);
    own.compute();
    return own;
  }



  void
  ElementKernel::become(const unsigned int k, ElementStiffness<8> &cells) const
  {
    set_gradients(cells, k, k == 0 ? 8 : k + 1);
  }



  /** Set the nodal displacements by which stresses are evaluated. The amplitudes of incompatible
   * modes are not dofs of the system; they follow from the nodal displacements by the condition
   * that the cell is in equilibrium with respect to them, and so are recovered from their rows of
   * the stiffness. */
  void
  ElementKernel::set_displacement(const std::vector<double> &u)
  {
    displacement = u;
    if (n_modes > 0)
      {
        set_gradients(own, 0, 1);
        own.compute_modes();
        own.recover_modes(displacement);
      }
    mean_dilatation = 0.;
    if (type == ElementType::b_bar)
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int i = 0; i < dim; ++i)
          mean_dilatation += mean_gradients[a][i] * u[dim * a + i];
  }



  /** Cauchy stress at a quadrature point by Hooke's law, from the strain that the element uses in
   * its stiffness: with modes or mean dilatation. The plain displacement gradient would show the
   * oscillating pressures that these elements are there to avoid. */
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
    const double mu = material.shear_modulus(), lambda = material.bulk_modulus() - 2. / 3. * mu;
    return lambda * trace(strain) * unit_symmetric_tensor<dim>() + 2. * mu * strain;
  }
} // namespace Touchstone
