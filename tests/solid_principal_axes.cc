// SPDX-License-Identifier: LGPL-2.1-or-later
// Eigenvalues and eigenvectors of symmetric tensors: orthonormal axes, and the tensor is met to
// round-off, for different, equal and nearly equal eigenvalues in any position and for all sizes.

#include <touchstone/solid/principal_axes.h>

#include <deal.II/base/point.h>
#include <deal.II/physics/transformations.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <random>

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** Whether axes are orthonormal and meet the tensors; what is not a number fails. */
  void
  test(const std::string &name, const std::vector<SymmetricTensor<2, dim>> &tensors)
  {
    const Tensor<2, dim> one(unit_symmetric_tensor<dim>());
    bool                 axes = true, met = true;
    for (const SymmetricTensor<2, dim> &A : tensors)
      {
        const PrincipalAxes found(A);
        Tensor<2, dim>      diagonal;
        for (unsigned int i = 0; i < dim; ++i)
          diagonal[i][i] = found.value[i];
        const Tensor<2, dim> made = found.axes * diagonal * transpose(found.axes);
        axes = axes && (transpose(found.axes) * found.axes - one).norm() < 5e-15;
        met  = met && (made - Tensor<2, dim>(A)).norm() <= 5e-15 * A.norm();
      }
    std::cout << name << ": axes " << (axes ? "orthonormal" : "WRONG") << ", tensor "
              << (met ? "met" : "WRONG") << std::endl;
  }



  /** Many rotations of diag(values); the first three are not turned. */
  std::vector<SymmetricTensor<2, dim>>
  turned(const std::array<double, dim> &values)
  {
    std::mt19937                           generator(1);
    std::uniform_real_distribution<double> angle(0., 2. * numbers::PI), height(-1., 1.);
    std::vector<SymmetricTensor<2, dim>>   result;
    for (unsigned int k = 0; k < 2000; ++k)
      {
        const double   z = height(generator), phi = angle(generator);
        const double   r = std::sqrt(1. - z * z);
        Tensor<1, dim> n;
        n[0] = r * std::cos(phi);
        n[1] = r * std::sin(phi);
        n[2] = z;
        const Tensor<2, dim> Q =
          Physics::Transformations::Rotations::rotation_matrix_3d(n, angle(generator));
        Tensor<2, dim> diagonal;
        for (unsigned int i = 0; i < dim; ++i)
          diagonal[i][i] = values[(i + k) % dim];
        result.push_back(symmetrize(k < dim ? diagonal : Q * diagonal * transpose(Q)));
      }
    return result;
  }



  /** The unit tensor with round-off of either sign or none in each component. Among them is one
   * for which all columns of what is left without an eigenvalue are parallel. */
  std::vector<SymmetricTensor<2, dim>>
  near_one()
  {
    std::vector<SymmetricTensor<2, dim>> result;
    for (unsigned int k = 0; k < 729; ++k)
      {
        SymmetricTensor<2, dim> A = unit_symmetric_tensor<dim>();
        for (unsigned int c = 0, rest = k; c < 6; ++c, rest /= 3)
          A.access_raw_entry(c) +=
            std::numeric_limits<double>::epsilon() * (c < dim ? 1. : 0.25) * (rest % 3 - 1.);
        result.push_back(A);
      }
    return result;
  }
} // namespace



int
main()
{
  test("different", turned({{1., 2., 4.}}));
  test("of both signs", turned({{-3., 1., 2.5}}));
  test("trace zero", turned({{-1., 0., 1.}}));
  test("two equal", turned({{1., 1., 2.}}));
  test("two equal, the larger ones", turned({{1., 2., 2.}}));
  test("three equal", turned({{1., 1., 1.}}));
  test("zero", turned({{0., 0., 0.}}));
  for (const double e : {1e-3, 1e-6, 1e-9, 1e-12, 1e-14, 1e-15, 1e-16})
    {
      std::cout << "differences of " << e << '\n';
      test("  three", turned({{1. - e, 1., 1. + 2. * e}}));
      test("  two, one far", turned({{1., 1. + e, 2.}}));
      test("  one of two equal", turned({{1., 1., 1. + e}}));
    }
  test("large", turned({{1e100, 2e100, 5e100}}));
  test("small", turned({{1e-100, 2e-100, 5e-100}}));
  test("of all sizes", turned({{1e-12, 1., 1e12}}));

  test("round-off about one", near_one());

  SymmetricTensor<2, dim> wrong;
  wrong[0][1] = std::numeric_limits<double>::quiet_NaN();
  const PrincipalAxes none(wrong);
  std::cout << "not a number: " << (std::isnan(none.value[0]) ? "not a number" : "WRONG")
            << std::endl;
  return 0;
}
