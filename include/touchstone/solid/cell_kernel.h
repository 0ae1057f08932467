// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_cell_kernel_h
#define touchstone_solid_cell_kernel_h

#include <touchstone/solid/body_parameters.h>
#include <touchstone/solid/material_law.h>

#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Nodal forces and tangent stiffness of one hexahedron of nonlinear material.
   *
   * What kernels for small and finite strain share: shapes, the loops over points and
   * nodes, the state of the material, and the terms of a dilatation that is averaged over
   * the cell. Plain arrays: nodes in the order of FE_Q, node a component i at 3a+i.
   */
  class CellKernel
  {
  public:
    CellKernel(unsigned int degree, std::shared_ptr<const MaterialLaw> law, bool averaged);
    virtual ~CellKernel() = default;

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

    unsigned int
    n_dofs() const
    {
      return dim * n_nodes;
    }

    const std::shared_ptr<const MaterialLaw> &
    material() const
    {
      return law;
    }

    /** @brief Time since the committed state, see MaterialInput. */
    void
    set_step_length(const double length)
    {
      step_length = length;
    }

    /** @brief The present time, see MaterialInput. */
    void
    set_time(const double present)
    {
      time = present;
    }

    /** @brief Number of history variables of a cell; those of its points follow one another. */
    unsigned int
    n_state() const
    {
      return n_points * law->n_state();
    }

    /** @brief Write the state of virgin material. */
    void
    start(double *state) const;

    /**
     * @brief Set the cell and its displacement.
     * @param positions    Reference positions of the nodes, length.
     * @param displacement Displacements of the nodes, length.
     * @param committed    State of the cell at the end of the last step; is not copied.
     *                     Null for virgin material.
     * @return the smallest det F of the quadrature points; 1 for small strain; 0 if the law does
     * not admit the deformation of one of them. Unless it is positive no other function may be
     * called.
     */
    double
    reinit(const double *positions, const double *displacement, const double *committed = nullptr);

    /** @brief Whether reinit() can return other numbers than 1. */
    virtual bool
    can_invert() const = 0;

    /** @brief Whether round-off of F = I + grad u matters beside that of u. */
    virtual bool
    finite_strain() const = 0;

    /** @brief Energy of the cell, stored and dissipated since the last step, of which
     * forces are the derivative if the material is symmetric; force times length. */
    double
    energy();

    /** @brief Elastic energy of the cell, force times length. */
    double
    elastic_energy();

    /** @brief Nodal forces, n_dofs() numbers. */
    const std::vector<double> &
    force();

    /** @brief Tangent, the derivative of force(), row by row, n_dofs() times n_dofs()
     * numbers, force per length.
     * @param symmetric Its symmetric part, if the material has none. */
    const std::vector<double> &
    stiffness(bool symmetric = false);

    /** @brief Stress at quadrature point @p q: Cauchy stress, force per present area. */
    virtual dealii::SymmetricTensor<2, dim>
    stress(unsigned int q) = 0;

    /** @brief Volume that quadrature point @p q stands for, the present one at finite
     * strain. */
    virtual double
    volume(unsigned int q) const = 0;

    /** @brief Reference position of quadrature point @p q. */
    dealii::Point<dim>
    point(const unsigned int q) const
    {
      return points[q].position;
    }

    /** @brief Reference volume that quadrature point @p q stands for. */
    double
    weight(const unsigned int q) const
    {
      return points[q].weight;
    }

    /** @brief State that belongs to the displacement; after energy(), force() or
     * stiffness(). */
    const std::vector<double> &
    present() const
    {
      return present_state;
    }

    /** @brief Whether the material law succeeded at all points in the last of these evaluations. */
    bool
    solved() const
    {
      return all_solved;
    }

  protected:
    /** What belongs to one quadrature point. */
    struct PointData
    {
      dealii::Point<dim> position;
      /** Reference volume. */
      double weight;
      /** Displacement gradient. */
      dealii::Tensor<2, dim> gradient;
      MaterialResponse       response;
    };

    const std::shared_ptr<const MaterialLaw> law;
    /** Whether the dilatation is averaged over the cell. */
    const bool             averaged;
    const unsigned int     n_nodes, n_points;
    std::vector<PointData> points;
    /** Reference volume of the cell. */
    double cell_volume = 0.;
    /** Derivative of the averaged dilatation by the displacements. */
    std::vector<double> mean_gradient;

    /** The second derivatives of the energy that involve the averaged dilatation t. */
    struct MeanTerms
    {
      /** By displacement gradient and t, and the other way round, per reference volume. */
      dealii::Tensor<2, dim> left, right;
      /** By t twice. */
      double second;
    };

    /** Gradients of the shapes on the reference cell, [J][a]. */
    double *
    shape_gradient(const unsigned int q)
    {
      return &gradients[q * dim * n_nodes];
    }

    /** The displacement has changed: @return the smallest det F. */
    virtual double
    deform() = 0;

    /** The deformation that the law is evaluated for at point @p q. */
    virtual dealii::Tensor<2, dim>
    deformation(unsigned int q) const = 0;

    virtual void
    set_mean_gradient() = 0;

    /** The stress that does work on the displacement gradient of point @p q at fixed averaged
     * dilatation; adds to @p pressure the stress that does work on that dilatation, times volume.
     */
    virtual dealii::Tensor<2, dim>
    point_stress(unsigned int q, double &pressure) const = 0;

    /** Turn the law's tangent at point @p q into the derivative at fixed averaged dilatation. */
    virtual MeanTerms
    modify_tangent(unsigned int q, double pressure, dealii::Tensor<4, dim> &A) const = 0;

    /** Second derivative by t that does not come from the points. */
    virtual double
    mean_curvature(double pressure) const = 0;

    void
    respond(Demand demand);

    /** Whether the law admits the deformations of all points. */
    bool
    admitted() const;

    /** The response holds the stress of the present deformation. */
    bool has_stress = false;

  private:
    /** Gradients of the shapes on the unit cell and these shapes, [a][d][q]; gradients on the unit
     * cell and on the reference cell, [q][J][a]; see CellLoops. */
    std::vector<double> tables, unit_gradients, gradients;
    std::vector<double> unit_weights;
    /** Positions, displacements and their derivatives on the unit cell at all points. */
    std::vector<double> place, motion;
    std::vector<double> virgin, present_state;
    const double       *committed_state = nullptr;
    double              step_length = 0., time = 0.;
    bool                all_solved = true;

    std::vector<double> nodal_force, blocks, matrix;
    /** Mixed derivatives of the energy by the displacements and the averaged dilatation. */
    std::vector<double> left, right;
  };
} // namespace Touchstone

#endif
