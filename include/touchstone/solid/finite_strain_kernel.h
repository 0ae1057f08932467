#ifndef touchstone_solid_finite_strain_kernel_h
#define touchstone_solid_finite_strain_kernel_h

#include <touchstone/scene/body_parameters.h>
#include <touchstone/solid/hyperelastic_law.h>

#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Energy, nodal forces and tangent stiffness of one hexahedron at finite
   * strain, total Lagrangian.
   *
   * Everything is derived from the energy of the cell, so the tangent is the
   * symmetric second derivative: CG and LDL^T need that. Element types:
   * - full: E(u) = sum_q w W(F(u));
   * - f_bar, for nearly incompressible material of degree 1: E(u) = sum_q w
   *   W(Fbar(u)) with Fbar = (Jbar/J)^{1/3} F, where Jbar = v/V is the ratio of the
   *   cell's present and reference volume.
   *
   * Fbar is the modification of de Souza Neto, Peric, Dutko and Owen (1996), Int.
   * J. Solids Struct. 33, who take Jbar at the centre of the cell and the stress
   * P(Fbar) as it is, which makes their tangent unsymmetric. The mean dilatation
   * is that of Simo, Taylor and Pister (1985), Comput. Methods Appl. Mech. Engng
   * 51: where the energies of shape and volume are separate, as in the
   * neo-Hookean law, this element is theirs.
   *
   * Plain arrays: nodes in the order of FE_Q, node a component i at 3a+i.
   */
  class FiniteStrainKernel
  {
  public:
    /** @param type full or f_bar. */
    FiniteStrainKernel(unsigned int degree, ElementType type, const MaterialParameters &material);

    unsigned int
    nodes_per_cell() const
    {
      return n_nodes;
    }

    unsigned int
    n_quadrature_points() const
    {
      return n_points;
    }

    /**
     * @brief Go to a cell and a displacement; both arrays are copied from.
     * @param positions    Reference positions of the nodes, length.
     * @param displacement Displacements of the nodes, length.
     * @return the smallest det F of the quadrature points. Unless it is positive
     *         nothing else can be asked for.
     */
    double
    reinit(const double *positions, const double *displacement);

    /** @brief Energy of the cell, force times length. */
    double
    energy() const;

    /** @brief Nodal forces, dE/du, n_dofs() numbers. */
    const std::vector<double> &
    force();

    /** @brief Tangent, d2E/du2, row by row, n_dofs() times n_dofs() numbers, force
     * per length. */
    const std::vector<double> &
    stiffness();

    unsigned int
    n_dofs() const
    {
      return dim * n_nodes;
    }

    /** @brief Cauchy stress at quadrature point @p q: force per present area. */
    dealii::SymmetricTensor<2, dim>
    stress(unsigned int q) const;

    /** @brief Present volume that quadrature point @p q stands for. */
    double
    volume(unsigned int q) const
    {
      return points[q].weight * points[q].J;
    }

    /** @brief Reference position of quadrature point @p q. */
    dealii::Point<dim>
    point(unsigned int q) const
    {
      return points[q].position;
    }

  private:
    /** What belongs to one quadrature point. */
    struct PointData
    {
      dealii::Point<dim> position;
      /** Reference volume. */
      double weight;
      /** Deformation gradient, its determinant, its inverse transposed. */
      dealii::Tensor<2, dim> F, H;
      double                 J;
      /** (Jbar/J)^{1/3} and the gradient that the law sees; 1 and F if full. */
      double                 alpha;
      dealii::Tensor<2, dim> F_bar;
      /** P(Fbar), for modify_tangent(). */
      dealii::Tensor<2, dim> P;
    };

    const bool                             f_bar;
    const std::shared_ptr<HyperelasticLaw> law;
    const unsigned int                     n_nodes, n_points;
    /** Shapes on the unit cell, [q][a]; gradients on the unit cell and on the
     * reference cell, [q][J][a]: the innermost loops run over the nodes. */
    std::vector<double>    shapes, unit_gradients, gradients;
    std::vector<double>    unit_weights;
    std::vector<PointData> points;
    /** Reference volume of the cell and its mean dilatation. */
    double cell_volume = 0., mean_J = 1.;

    std::vector<double> nodal_force, blocks, matrix;
    /** Derivative of ln Jbar, and the mixed derivative of the energy by the
     * displacements and ln Jbar. */
    std::vector<double> mean_gradient, mixed;

    double *
    gradient(const unsigned int q)
    {
      return &gradients[q * dim * n_nodes];
    }

    void
    set_mean_gradient();

    /** Turn A = dP/dF at Fbar of point @p q into the second derivative by F with Jbar
     * held, add the terms of ln Jbar to @p mixed, and return the second derivative
     * by ln Jbar. @p pressure is sum_q w P(Fbar) : Fbar / 3. */
    double
    modify_tangent(unsigned int q, double pressure, dealii::Tensor<4, dim> &A);
  };
} // namespace Touchstone

#endif
