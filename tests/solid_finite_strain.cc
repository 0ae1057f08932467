// SPDX-License-Identifier: LGPL-2.1-or-later
// Elements for finite strain on a distorted cell in a large deformation: forces
// are the derivative of the energy and the tangent that of the forces; symmetric;
// a rotation of the deformed cell turns its forces and stress and does no work;
// a homogeneous deformation gives the law's stress at every point.

#include <touchstone/solid/finite_strain_kernel.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/physics/transformations.h>

#include "mesh_common.h"
#include <random>

using namespace Touchstone;
using namespace dealii;

namespace
{
  using Array = std::vector<double>;

  void
  check(const std::string &law_name,
        const std::string &name,
        const unsigned int degree,
        const ElementType  type,
        const double       nu)
  {
    MaterialParameters material;
    material.law           = law_name;
    material.young_modulus = 2.;
    material.poisson_ratio = nu;
    FiniteStrainKernel kernel(degree, type, material);
    const unsigned int n = kernel.n_dofs(), n_nodes = kernel.nodes_per_cell();

    std::mt19937                           generator(42);
    std::uniform_real_distribution<double> random(-0.1, 0.1);
    const std::vector<Point<dim>>          unit = FE_Q<dim>(degree).get_unit_support_points();
    Array                                  X(n), u(n);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int d = 0; d < dim; ++d)
        {
          // A large stretch and shear, and noise on both.
          X[dim * a + d] = (1. + 0.5 * d) * unit[a][d] + random(generator) / degree;
          u[dim * a + d] =
            0.4 * unit[a][(d + 1) % dim] + 0.2 * unit[a][d] + random(generator) / degree;
        }

    const double determinant = kernel.reinit(X.data(), u.data());
    const Array  force = kernel.force(), matrix = kernel.stiffness();
    const double energy = kernel.energy();

    double largest_force = 0., largest = 0., asymmetry = 0., residual = 0., tangent = 0.;
    for (unsigned int i = 0; i < n; ++i)
      {
        largest_force = std::max(largest_force, std::abs(force[i]));
        for (unsigned int j = 0; j < n; ++j)
          {
            largest   = std::max(largest, std::abs(matrix[n * i + j]));
            asymmetry = std::max(asymmetry, std::abs(matrix[n * i + j] - matrix[n * j + i]));
          }
      }
    const double h = 1e-5;
    for (unsigned int j = 0; j < n; ++j)
      {
        Array plus(u), minus(u);
        plus[j] += h;
        minus[j] -= h;
        kernel.reinit(X.data(), plus.data());
        const double energy_plus = kernel.energy();
        const Array  force_plus  = kernel.force();
        kernel.reinit(X.data(), minus.data());
        const double energy_minus = kernel.energy();
        const Array  force_minus  = kernel.force();
        residual =
          std::max(residual,
                   std::abs((energy_plus - energy_minus) / (2. * h) - force[j]) / largest_force);
        for (unsigned int i = 0; i < n; ++i)
          tangent =
            std::max(tangent,
                     std::abs((force_plus[i] - force_minus[i]) / (2. * h) - matrix[n * i + j]) /
                       largest);
      }

    // Rotate the deformed cell: x -> Q x + c.
    kernel.reinit(X.data(), u.data());
    std::vector<SymmetricTensor<2, dim>> stress;
    for (unsigned int q = 0; q < kernel.n_quadrature_points(); ++q)
      stress.push_back(kernel.stress(q));
    const Tensor<2, dim> Q =
      Physics::Transformations::Rotations::rotation_matrix_3d(Point<dim>(0.6, 0., 0.8), 2.);
    Array turned(n), rigid(n);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        {
          turned[dim * a + i] = rigid[dim * a + i] = 5. - X[dim * a + i];
          for (unsigned int j = 0; j < dim; ++j)
            {
              turned[dim * a + i] += Q[i][j] * (X[dim * a + j] + u[dim * a + j]);
              rigid[dim * a + i] += Q[i][j] * X[dim * a + j];
            }
        }
    kernel.reinit(X.data(), turned.data());
    double      rotation     = std::abs(kernel.energy() / energy - 1.);
    const Array turned_force = kernel.force();
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        {
          double expected = 0.;
          for (unsigned int j = 0; j < dim; ++j)
            expected += Q[i][j] * force[dim * a + j];
          rotation = std::max(rotation, std::abs(turned_force[dim * a + i] - expected) / largest);
        }
    for (unsigned int q = 0; q < kernel.n_quadrature_points(); ++q)
      rotation = std::max(
        rotation,
        (Tensor<2, dim>(kernel.stress(q)) - Q * Tensor<2, dim>(stress[q]) * transpose(Q)).norm() /
          stress[q].norm());
    kernel.reinit(X.data(), rigid.data());
    for (const double f : kernel.force())
      rotation = std::max(rotation, std::abs(f) / largest);

    // Homogeneous deformation.
    const auto     law = HyperelasticRegistry::make(law_name, material);
    Tensor<2, dim> F   = Q;
    F[0][1] += 0.3;
    F[2][2] += 0.5;
    Array affine(n);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        {
          affine[dim * a + i] = -X[dim * a + i];
          for (unsigned int j = 0; j < dim; ++j)
            affine[dim * a + i] += F[i][j] * X[dim * a + j];
        }
    kernel.reinit(X.data(), affine.data());
    const Tensor<2, dim> cauchy = law->stress(F) * transpose(F) / dealii::determinant(F);
    double               patch = 0., volume = 0.;
    for (unsigned int q = 0; q < kernel.n_quadrature_points(); ++q)
      {
        patch = std::max(patch, (Tensor<2, dim>(kernel.stress(q)) - cauchy).norm() / cauchy.norm());
        volume += kernel.volume(q);
      }
    patch =
      std::max(patch,
               std::abs(kernel.energy() / law->energy(F) * dealii::determinant(F) / volume - 1.));

    // Inside out.
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        affine[dim * a + i] = i == 0 ? -2. * X[dim * a] : 0.;
    const bool inverted = kernel.reinit(X.data(), affine.data()) > 0.;

    std::cout << law_name << ", " << name << ", nu = " << nu << ": det F "
              << (determinant > 0. ? "positive" : "negative FAILED") << ", forces from energy "
              << small(residual, 1e-7) << ", tangent from forces " << small(tangent, 1e-7)
              << ", asymmetry " << small(asymmetry / largest, 1e-14) << ", rotations "
              << small(rotation, 1e-12) << ", homogeneous deformation " << small(patch, 1e-12)
              << (inverted ? ", inversion not seen FAILED" : "") << std::endl;
  }
} // namespace

int
main()
{
  for (const auto &[law, record] : HyperelasticRegistry::records())
    for (const double nu : {0.3, 0.4999})
      {
        check(law, "full", 1, ElementType::full, nu);
        check(law, "F-bar", 1, ElementType::f_bar, nu);
        check(law, "degree 2", 2, ElementType::full, nu);
      }
  return 0;
}
