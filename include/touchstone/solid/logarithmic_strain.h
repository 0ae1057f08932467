// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_logarithmic_strain_h
#define touchstone_solid_logarithmic_strain_h

#include <touchstone/base/types.h>

#include <deal.II/base/symmetric_tensor.h>

namespace Touchstone
{
  /**
   * @brief The logarithmic strain E = 1/2 ln C of a tensor C = F^T F and its derivatives.
   *
   * In the frame of the eigenvectors of C, with e(x) = 1/2 ln x and its divided differences
   * e[a,b], e[a,b,c] at the eigenvalues (Daleckii and Krein),
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

    /** @brief E. */
    dealii::SymmetricTensor<2, dim>
    strain() const;

    /** @brief exp(-E). */
    dealii::SymmetricTensor<2, dim>
    inverse_stretch() const;

    /** @brief DE H, the change of E with C; the map is its own transpose. */
    dealii::SymmetricTensor<2, dim>
    derivative(const dealii::SymmetricTensor<2, dim> &H) const;

    /** @brief The tensor Q with Q : G = T : D2E(H, G) for all G. */
    dealii::SymmetricTensor<2, dim>
    curvature(const dealii::SymmetricTensor<2, dim> &T,
              const dealii::SymmetricTensor<2, dim> &H) const;

  private:
    /** Columns are eigenvectors. */
    dealii::Tensor<2, dim>  frame;
    std::array<double, dim> value;
    double                  first[dim][dim];
    double                  second[dim][dim][dim];

    dealii::Tensor<2, dim>
    to_frame(const dealii::SymmetricTensor<2, dim> &H) const;
    dealii::SymmetricTensor<2, dim>
    from_frame(const dealii::Tensor<2, dim> &H) const;
  };

  /** @brief The exponential of a symmetric tensor. */
  dealii::SymmetricTensor<2, dim>
  exponential(const dealii::SymmetricTensor<2, dim> &E);
} // namespace Touchstone

#endif
