// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_logarithmic_strain_h
#define touchstone_solid_logarithmic_strain_h

#include <touchstone/solid/principal_axes.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>

namespace Touchstone
{
  /**
   * @brief The logarithmic strain E = 1/2 ln C of a tensor C = F^T F and its derivatives.
   *
   * All tensors that functions take and return are components in the frame of the eigenvectors
   * of C, axes(). There, with e(x) = 1/2 ln x and its divided differences e[a,b], e[a,b,c] at the
   * eigenvalues (Daleckii and Krein),
   *
   *   (DE H)_ab = e[a,b] H_ab,
   *   (D2E (H, G))_ab = sum_c e[a,b,c] (H_ac G_cb + G_ac H_cb),
   *
   * which holds for equal eigenvalues, too. Higham (2008), Functions of Matrices, chapter 3;
   * the same in other terms: Miehe and Lambrecht (2001), Commun. Numer. Meth. Engng 17.
   */
  class LogarithmicStrain
  {
  public:
    /** @param C Symmetric and positive definite. */
    explicit LogarithmicStrain(const dealii::SymmetricTensor<2, dim> &C);

    /** @brief The eigenvectors of C, in columns: a tensor A of the frame of C is axes()^T A
     * axes() here. */
    const dealii::Tensor<2, dim> &
    axes() const
    {
      return principal.axes;
    }

    /** @brief E, diagonal. */
    dealii::SymmetricTensor<2, dim>
    strain() const;

    /** @brief The eigenvalues of exp(-E). */
    std::array<double, dim>
    inverse_stretch() const;

    /** @brief The stress S = 2 DE T that does work on C / 2 where @p T does work on E, force per
     * area as @p T. */
    dealii::SymmetricTensor<2, dim>
    conjugate_stress(const dealii::SymmetricTensor<2, dim> &T) const;

    /** @brief The change of conjugate_stress() with C / 2, 4 (DE D DE + T : D2E), force per area.
     * @param T The stress. @param D Its derivative by E. */
    dealii::SymmetricTensor<4, dim>
    conjugate_tangent(const dealii::SymmetricTensor<2, dim> &T,
                      const dealii::SymmetricTensor<4, dim> &D) const;

  private:
    PrincipalAxes principal;
    double        first[dim][dim];
  };

  /** @brief The exponential of a symmetric tensor. */
  dealii::SymmetricTensor<2, dim>
  exponential(const dealii::SymmetricTensor<2, dim> &E);
} // namespace Touchstone

#endif
