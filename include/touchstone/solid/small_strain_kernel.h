// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_small_strain_kernel_h
#define touchstone_solid_small_strain_kernel_h

#include <touchstone/solid/cell_kernel.h>

namespace Touchstone
{
  /**
   * @brief Nodal forces and tangent stiffness of one hexahedron at small strain, of material
   * with history. Linear material has the ElementKernel, which is evaluated once.
   *
   * Element types as there: full, and b_bar with the volumetric strain averaged over the
   * cell (Hughes 1980, Int. J. Numer. Meth. Engng 15): plastic flow keeps the volume, so the
   * full element of degree 1 locks.
   */
  class SmallStrainKernel : public CellKernel
  {
  public:
    /** @param type full or b_bar. @param material With the name of a SmallStrainLaw. */
    SmallStrainKernel(unsigned int degree, ElementType type, const MaterialParameters &material);

    bool
    can_invert() const override
    {
      return false;
    }

    bool
    finite_strain() const override
    {
      return false;
    }

    dealii::SymmetricTensor<2, dim>
    stress(unsigned int q) override;

    double
    volume(const unsigned int q) const override
    {
      return points[q].weight;
    }

  private:
    double mean_dilatation = 0.;

    double
    deform() override;
    dealii::Tensor<2, dim>
    deformation(unsigned int q) const override;
    void
    set_mean_gradient() override;
    dealii::Tensor<2, dim>
    point_stress(unsigned int q, double &pressure) const override;
    MeanTerms
    modify_tangent(unsigned int q, double pressure, dealii::Tensor<4, dim> &A) const override;
    double
    mean_curvature(double /*pressure*/) const override
    {
      return 0.;
    }
  };
} // namespace Touchstone

#endif
