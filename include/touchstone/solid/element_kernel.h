// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_element_kernel_h
#define touchstone_solid_element_kernel_h

#include <touchstone/base/types.h>
#include <touchstone/solid/body_parameters.h>
#include <touchstone/solid/element_stiffness.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief Stiffness and stress of one hexahedron, small strain, isotropic
   * linear elasticity.
   *
   * Element types:
   * - full: the displacement element;
   * - b_bar: the volumetric strain is its mean over the cell
   *   (Hughes 1980, Int. J. Numer. Meth. Engng 15), for nearly incompressible
   *   materials;
   * - incompatible_modes: three quadratic modes per component, condensed in the
   *   cell, with the modification that passes the patch test on distorted cells
   *   (Taylor, Beresford and Wilson 1976, same journal 10), for bending.
   */
  class ElementKernel
  {
  public:
    /** @param mapping, material Must outlive this object. */
    ElementKernel(const dealii::Mapping<dim>       &mapping,
                  const dealii::FiniteElement<dim> &fe,
                  ElementType                       type,
                  const MaterialParameters         &material);

    /** @brief Set the cell. */
    void
    reinit(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell);

    /** @brief Number of displacement dofs of a cell. */
    unsigned int
    n_dofs() const
    {
      return dim * n_nodes;
    }

    /** @brief Stiffness over the cell's unknowns, in the order node-component. */
    const ElementStiffness<1> &
    stiffness();

    /** @brief What makes the stiffnesses of eight cells at once. */
    ElementStiffness<8>
    stiffness_of_cells() const
    {
      return {type, material, n_nodes, n_modes, n_points};
    }

    /** @brief Copy this cell's gradients to SIMD lane @p k of eight; lane 0 initialises all lanes.
     */
    void
    become(unsigned int k, ElementStiffness<8> &cells) const;

    /** @brief Set the nodal displacements for stress(), in the order node-component. */
    void
    set_displacement(const std::vector<double> &u);

    unsigned int
    n_quadrature_points() const
    {
      return n_points;
    }

    dealii::SymmetricTensor<2, dim>
    stress(unsigned int q) const;

    dealii::Point<dim>
    point(unsigned int q) const
    {
      return values.quadrature_point(q);
    }

    double
    volume(unsigned int q) const
    {
      return values.JxW(q);
    }

    /** @brief The unknown of a cell's local numbering that is component @p d of
     * local node @p a. */
    unsigned int
    local_dof(const unsigned int a, const unsigned int d) const
    {
      return node_dof[dim * a + d];
    }

    unsigned int
    nodes_per_cell() const
    {
      return n_nodes;
    }

  private:
    const ElementType         type;
    const MaterialParameters &material;
    dealii::QGauss<dim>       quadrature;
    /** A scalar copy of the element: all components have the same shapes. */
    const dealii::FE_Q<dim>   scalar_fe;
    dealii::FEValues<dim>     values;
    dealii::FEValues<dim>     centre;
    std::vector<unsigned int> node_dof;
    const unsigned int        n_nodes, n_modes, n_points;
    /** Gradients of shapes and incompatible modes, [point][shape]. */
    std::vector<std::vector<dealii::Tensor<1, dim>>> gradients;
    std::vector<dealii::Tensor<1, dim>>              mean_gradients;
    double                                           cell_volume = 0.;
    std::vector<double>                              displacement;
    double                                           mean_dilatation = 0.;
    ElementStiffness<1>                              own;

    /** Set the gradients of cells number @p begin to @p end - 1. */
    template <unsigned int n_cells>
    void
    set_gradients(ElementStiffness<n_cells> &stiffness, unsigned int begin, unsigned int end) const;
  };
} // namespace Touchstone

#endif
