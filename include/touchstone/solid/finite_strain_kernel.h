// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_finite_strain_kernel_h
#define touchstone_solid_finite_strain_kernel_h

#include <touchstone/solid/cell_kernel.h>
#include <touchstone/solid/hyperelastic_law.h>

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
   * Of plastic material W is the energy that a step stores and dissipates.
   */
  class FiniteStrainKernel : public CellKernel
  {
  public:
    /** @param type full or f_bar. @param material With the name of a HyperelasticLaw or a
     * FiniteStrainLaw. */
    FiniteStrainKernel(unsigned int degree, ElementType type, const MaterialParameters &material);

    bool
    can_invert() const override
    {
      return true;
    }

    bool
    finite_strain() const override
    {
      return true;
    }

    dealii::SymmetricTensor<2, dim>
    stress(unsigned int q) override;

    double
    volume(const unsigned int q) const override
    {
      return points[q].weight * kinematics[q].J;
    }

  private:
    struct Kinematics
    {
      /** Deformation gradient, its determinant, its inverse transposed. */
      dealii::Tensor<2, dim> F, H;
      double                 J;
      /** (Jbar/J)^{1/3} and the gradient that the law sees; 1 and F if full. */
      double                 alpha;
      dealii::Tensor<2, dim> F_bar;
    };

    std::vector<Kinematics> kinematics;
    /** Mean dilatation of the cell. */
    double mean_J = 1.;

    double
    deform() override;
    dealii::Tensor<2, dim>
    deformation(const unsigned int q) const override
    {
      return kinematics[q].F_bar;
    }
    void
    set_mean_gradient() override;
    dealii::Tensor<2, dim>
    point_stress(unsigned int q, double &pressure) const override;
    MeanTerms
    modify_tangent(unsigned int q, double pressure, dealii::Tensor<4, dim> &A) const override;
    double
    mean_curvature(const double pressure) const override
    {
      return -pressure;
    }
  };
} // namespace Touchstone

#endif
