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

  /** A cell, its displacement, and what its element says of it. */
  struct DeformedCell
  {
    DeformedCell(const std::string        &law,
                 const unsigned int        degree,
                 const ElementType         type,
                 const MaterialParameters &material)
      : law(HyperelasticRegistry::make(law, material))
      , kernel(degree, type, material)
      , n(kernel.n_dofs())
      , n_nodes(kernel.nodes_per_cell())
      , X(n)
      , u(n)
    {
      std::mt19937                           generator(42);
      std::uniform_real_distribution<double> random(-0.1, 0.1);
      const std::vector<Point<dim>>          unit = FE_Q<dim>(degree).get_unit_support_points();
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          {
            // A large stretch and shear, and noise on both.
            X[dim * a + d] = (1. + 0.5 * d) * unit[a][d] + random(generator) / degree;
            u[dim * a + d] =
              0.4 * unit[a][(d + 1) % dim] + 0.2 * unit[a][d] + random(generator) / degree;
          }
      determinant = kernel.reinit(X.data(), u.data());
      force       = kernel.force();
      matrix      = kernel.stiffness();
      energy      = kernel.energy();
      for (const double k : matrix)
        largest = std::max(largest, std::abs(k));
    }

    const std::shared_ptr<HyperelasticLaw> law;
    FiniteStrainKernel                     kernel;
    const unsigned int                     n, n_nodes;
    Array                                  X, u, force, matrix;
    double                                 determinant, energy, largest = 0.;
  };



  double
  asymmetry(const DeformedCell &cell)
  {
    double result = 0.;
    for (unsigned int i = 0; i < cell.n; ++i)
      for (unsigned int j = 0; j < cell.n; ++j)
        result =
          std::max(result, std::abs(cell.matrix[cell.n * i + j] - cell.matrix[cell.n * j + i]));
    return result / cell.largest;
  }



  /** Errors of the forces as derivative of the energy, and of the tangent as derivative of the
   * forces. */
  std::pair<double, double>
  errors_of_derivatives(DeformedCell &cell)
  {
    double largest_force = 0., residual = 0., tangent = 0.;
    for (const double f : cell.force)
      largest_force = std::max(largest_force, std::abs(f));
    const unsigned int n = cell.n;
    const double       h = 1e-5;
    for (unsigned int j = 0; j < n; ++j)
      {
        Array plus(cell.u), minus(cell.u);
        plus[j] += h;
        minus[j] -= h;
        cell.kernel.reinit(cell.X.data(), plus.data());
        const double energy_plus = cell.kernel.energy();
        const Array  force_plus  = cell.kernel.force();
        cell.kernel.reinit(cell.X.data(), minus.data());
        const double energy_minus = cell.kernel.energy();
        const Array  force_minus  = cell.kernel.force();
        residual                  = std::max(residual,
                            std::abs((energy_plus - energy_minus) / (2. * h) - cell.force[j]) /
                              largest_force);
        for (unsigned int i = 0; i < n; ++i)
          tangent = std::max(tangent,
                             std::abs((force_plus[i] - force_minus[i]) / (2. * h) -
                                      cell.matrix[n * i + j]) /
                               cell.largest);
      }
    return {residual, tangent};
  }



  /** The displacement x -> Q x + 5 of the cell, deformed by @p u before. */
  Array
  turned(const DeformedCell &cell, const Tensor<2, dim> &Q, const Array &u)
  {
    Array result(cell.n);
    for (unsigned int a = 0; a < cell.n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        {
          result[dim * a + i] = 5. - cell.X[dim * a + i];
          for (unsigned int j = 0; j < dim; ++j)
            result[dim * a + i] += Q[i][j] * (cell.X[dim * a + j] + u[dim * a + j]);
        }
    return result;
  }



  /** A rotation of the deformed cell turns forces and stress and does no work; of the cell at rest
   * it leaves none. */
  double
  error_of_rotation(DeformedCell &cell, const Tensor<2, dim> &Q)
  {
    FiniteStrainKernel &kernel = cell.kernel;
    kernel.reinit(cell.X.data(), cell.u.data());
    std::vector<SymmetricTensor<2, dim>> stress;
    for (unsigned int q = 0; q < kernel.n_quadrature_points(); ++q)
      stress.push_back(kernel.stress(q));
    kernel.reinit(cell.X.data(), turned(cell, Q, cell.u).data());
    double      result       = std::abs(kernel.energy() / cell.energy - 1.);
    const Array turned_force = kernel.force();
    for (unsigned int a = 0; a < cell.n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        {
          double expected = 0.;
          for (unsigned int j = 0; j < dim; ++j)
            expected += Q[i][j] * cell.force[dim * a + j];
          result = std::max(result, std::abs(turned_force[dim * a + i] - expected) / cell.largest);
        }
    for (unsigned int q = 0; q < kernel.n_quadrature_points(); ++q)
      result = std::max(
        result,
        (Tensor<2, dim>(kernel.stress(q)) - Q * Tensor<2, dim>(stress[q]) * transpose(Q)).norm() /
          stress[q].norm());
    kernel.reinit(cell.X.data(), turned(cell, Q, Array(cell.n)).data());
    for (const double f : kernel.force())
      result = std::max(result, std::abs(f) / cell.largest);
    return result;
  }



  /** A homogeneous deformation gives the stress and the energy of the law at every point. */
  double
  error_of_patch_test(DeformedCell &cell, const Tensor<2, dim> &F)
  {
    Array affine(cell.n);
    for (unsigned int a = 0; a < cell.n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        {
          affine[dim * a + i] = -cell.X[dim * a + i];
          for (unsigned int j = 0; j < dim; ++j)
            affine[dim * a + i] += F[i][j] * cell.X[dim * a + j];
        }
    cell.kernel.reinit(cell.X.data(), affine.data());
    const double         J      = dealii::determinant(F);
    const Tensor<2, dim> cauchy = cell.law->stress(F) * transpose(F) / J;
    double               result = 0., volume = 0.;
    for (unsigned int q = 0; q < cell.kernel.n_quadrature_points(); ++q)
      {
        result =
          std::max(result, (Tensor<2, dim>(cell.kernel.stress(q)) - cauchy).norm() / cauchy.norm());
        volume += cell.kernel.volume(q);
      }
    return std::max(result, std::abs(cell.kernel.energy() / cell.law->energy(F) * J / volume - 1.));
  }



  /** Whether a cell that is turned inside out is taken for a valid one. */
  bool
  inversion_is_missed(DeformedCell &cell)
  {
    Array inside_out(cell.n);
    for (unsigned int a = 0; a < cell.n_nodes; ++a)
      inside_out[dim * a] = -2. * cell.X[dim * a];
    return cell.kernel.reinit(cell.X.data(), inside_out.data()) > 0.;
  }



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
    DeformedCell         cell(law_name, degree, type, material);
    const auto           derivatives = errors_of_derivatives(cell);
    const Tensor<2, dim> Q =
      Physics::Transformations::Rotations::rotation_matrix_3d(Point<dim>(0.6, 0., 0.8), 2.);
    const double   rotation = error_of_rotation(cell, Q);
    Tensor<2, dim> F        = Q;
    F[0][1] += 0.3;
    F[2][2] += 0.5;
    const double patch    = error_of_patch_test(cell, F);
    const bool   inverted = inversion_is_missed(cell);

    std::cout << law_name << ", " << name << ", nu = " << nu << ": det F "
              << (cell.determinant > 0. ? "positive" : "negative FAILED") << ", forces from energy "
              << small(derivatives.first, 1e-7) << ", tangent from forces "
              << small(derivatives.second, 1e-7) << ", asymmetry " << small(asymmetry(cell), 1e-14)
              << ", rotations " << small(rotation, 1e-12) << ", homogeneous deformation "
              << small(patch, 1e-12) << (inverted ? ", inversion not seen FAILED" : "")
              << std::endl;
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
