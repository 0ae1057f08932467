// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_patch_polynomials_h
#define touchstone_solid_patch_polynomials_h

#include <touchstone/base/types.h>

#include <deal.II/base/tensor.h>
#include <deal.II/lac/full_matrix.h>

#include <array>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Polynomials of degree 1 or 2 in space by their monomials 1, x, y, z, xx, yy, zz, xy, yz,
   * zx about a point, and their fits to values at points by least squares.
   */
  class PatchPolynomials
  {
  public:
    /** @brief 1 or 2. */
    explicit PatchPolynomials(unsigned int degree);

    /** @brief Number of monomials, 4 or 10. */
    const unsigned int n;

    /** @brief The monomials at @p d from the point. */
    std::vector<double>
    monomials(const dealii::Tensor<1, dim> &d) const;

    /** @brief T with monomials(delta + B d) = T monomials(d). */
    dealii::FullMatrix<double>
    affine_map(const dealii::Tensor<2, dim> &B, const dealii::Tensor<1, dim> &delta) const;

    /**
     * @brief M_S^-1 of the least squares, by which right-hand sides sum m(d) f(d) are multiplied.
     *
     * @p M: sum of m(d) m(d)^T over the points; @p frame: its rows are directions, scaled by one
     * over the size of the cells. Powers of the full degree are fitted in directions that are
     * @p fitted only, in which cells lie on both sides of the point; others have too few points.
     */
    dealii::FullMatrix<double>
    least_squares(const dealii::FullMatrix<double> &M,
                  const dealii::Tensor<2, dim>     &frame,
                  const std::array<bool, dim>      &fitted) const;

  private:
    const unsigned int degree;
  };
} // namespace Touchstone

#endif
