// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_principal_axes_h
#define touchstone_solid_principal_axes_h

#include <touchstone/base/types.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>

namespace Touchstone
{
  /**
   * @brief Eigenvalues and eigenvectors of a symmetric tensor, A = V diag(value) V^T.
   *
   * For laws in principal stretches, which need them at every quadrature point: the direct method
   * of Scherzinger and Dohrmann (2008), Comput. Methods Appl. Mech. Engng 197, takes a
   * fourth of the time of deal.II's method of Jacobi (doc/materials.md, "Finite strain"). The axes
   * are orthonormal and A is met to round-off for equal and nearly equal eigenvalues, too, since
   * only the eigenvalue that is farthest from the others comes from a formula.
   */
  struct PrincipalAxes
  {
    /** @param A Any symmetric tensor; what is not a number gives values that are not. */
    explicit PrincipalAxes(const dealii::SymmetricTensor<2, dim> &A);

    /** @brief In no particular order. */
    std::array<double, dim> value;
    /** @brief The eigenvectors, in columns. */
    dealii::Tensor<2, dim> axes;
  };
} // namespace Touchstone

#endif
