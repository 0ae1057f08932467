// SPDX-License-Identifier: LGPL-2.1-or-later
// Elements of plastic material on a distorted cell in a non-proportional step that begins
// with plastic strain: the tangent is the derivative of the forces, for each law, hardening
// and element; the forces are that of the step's energy, where that exists; a tangent is
// symmetric but with Armstrong and Frederick's recovery, and then its symmetric part can be
// had. A rotation that is laid over the step turns forces and stress and leaves the plastic
// strain alone. What is committed gives the same forces again.

#include <touchstone/solid/finite_strain_kernel.h>
#include <touchstone/solid/small_strain_kernel.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/physics/transformations.h>

#include "mesh_common.h"
#include "plasticity_support.h"
#include <random>

using namespace Touchstone;
using namespace dealii;

namespace
{
  using Array = std::vector<double>;

  struct Figures
  {
    double energy = 0., tangent = 0., asymmetry = 0., symmetric_part = 0., rotation = 0.,
           again = 0., state = 0., plastic = 1., dilatation = 0.;
  };

  double
  distance(const Array &a, const Array &b)
  {
    double result = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
      result = std::max(result, std::abs(a[i] - b[i]));
    return result;
  }

  Figures
  check(CellKernel &kernel, const unsigned int degree, const bool recovery)
  {
    Figures            figures;
    const bool         finite = kernel.finite_strain();
    const unsigned int n = kernel.n_dofs(), n_nodes = kernel.nodes_per_cell();

    std::mt19937                           generator(42);
    std::uniform_real_distribution<double> random(-0.1, 0.1);
    const std::vector<Point<dim>>          unit = FE_Q<dim>(degree).get_unit_support_points();
    Array                                  X(n), first(n), u(n);
    const double                           size = finite ? 0.3 : 0.01;
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int d = 0; d < dim; ++d)
        {
          X[dim * a + d]     = (1. + 0.5 * d) * unit[a][d] + random(generator) / degree;
          first[dim * a + d] = size * (unit[a][(d + 1) % dim] + random(generator) / degree);
          u[dim * a + d] =
            first[dim * a + d] + size * (0.7 * unit[a][(d + 2) % dim] -
                                         0.4 * unit[a][d] * (d == 0) + random(generator) / degree);
        }
    kernel.reinit(X.data(), first.data());
    kernel.force();
    const Array committed = kernel.present();

    kernel.reinit(X.data(), u.data(), committed.data());
    const Array        force     = kernel.force();
    const Array        state     = kernel.present();
    const Array        matrix    = kernel.stiffness();
    const Array        symmetric = kernel.stiffness(true);
    const unsigned int n_state   = kernel.material()->n_state();
    for (unsigned int q = 0; q < kernel.n_quadrature_points(); ++q)
      figures.plastic = std::min(
        {figures.plastic, committed[q * n_state], state[q * n_state] - committed[q * n_state]});

    double largest = 0.;
    for (const double k : matrix)
      largest = std::max(largest, std::abs(k));
    double largest_force = 0.;
    for (const double f : force)
      largest_force = std::max(largest_force, std::abs(f));
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          figures.asymmetry =
            std::max(figures.asymmetry, std::abs(matrix[n * i + j] - matrix[n * j + i]) / largest);
          figures.symmetric_part =
            std::max(figures.symmetric_part,
                     std::abs(symmetric[n * i + j] -
                              0.5 * (matrix[n * i + j] + matrix[n * j + i])) /
                       largest);
        }
    const double h = finite ? 1e-6 : 1e-7;
    for (unsigned int j = 0; j < n; ++j)
      {
        Array  forces[2];
        double energies[2];
        for (const unsigned int side : {0, 1})
          {
            Array moved(u);
            moved[j] += side == 0 ? h : -h;
            kernel.reinit(X.data(), moved.data(), committed.data());
            energies[side] = kernel.energy();
            forces[side]   = kernel.force();
          }
        if (!recovery)
          figures.energy =
            std::max(figures.energy,
                     std::abs((energies[0] - energies[1]) / (2. * h) - force[j]) / largest_force);
        for (unsigned int i = 0; i < n; ++i)
          figures.tangent =
            std::max(figures.tangent,
                     std::abs((forces[0][i] - forces[1][i]) / (2. * h) - matrix[n * i + j]) /
                       largest);
      }
    // What is committed, again.
    kernel.reinit(X.data(), u.data(), state.data());
    figures.again = distance(kernel.force(), force) / largest_force;
    figures.state = distance(kernel.present(), state);

    if (!finite)
      return figures;
    kernel.reinit(X.data(), u.data(), committed.data());
    std::vector<SymmetricTensor<2, dim>> stress;
    for (unsigned int q = 0; q < kernel.n_quadrature_points(); ++q)
      stress.push_back(kernel.stress(q));
    const Tensor<2, dim> Q =
      Physics::Transformations::Rotations::rotation_matrix_3d(Point<dim>(0.6, 0., 0.8), 2.);
    Array turned(n);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        {
          turned[dim * a + i] = 5. - X[dim * a + i];
          for (unsigned int j = 0; j < dim; ++j)
            turned[dim * a + i] += Q[i][j] * (X[dim * a + j] + u[dim * a + j]);
        }
    kernel.reinit(X.data(), turned.data(), committed.data());
    const Array turned_force = kernel.force();
    figures.rotation         = distance(kernel.present(), state);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        {
          double expected = 0.;
          for (unsigned int j = 0; j < dim; ++j)
            expected += Q[i][j] * force[dim * a + j];
          figures.rotation =
            std::max(figures.rotation, std::abs(turned_force[dim * a + i] - expected) / largest);
        }
    for (unsigned int q = 0; q < kernel.n_quadrature_points(); ++q)
      {
        figures.rotation = std::max(
          figures.rotation,
          (Tensor<2, dim>(kernel.stress(q)) - Q * Tensor<2, dim>(stress[q]) * transpose(Q)).norm() /
            stress[q].norm());
        Tensor<2, dim> inverse;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            inverse[i][j] = state[q * n_state + 2 + dim * i + j];
        figures.dilatation = std::max(figures.dilatation, std::abs(determinant(inverse) - 1.));
      }
    return figures;
  }

  void
  check(const std::string &law, const std::string &element, const unsigned int degree)
  {
    for (const HardeningCase &hardening : hardening_cases)
      {
        const auto                  material = plastic_material(law, hardening.entries);
        const ElementType           type     = element == "F-bar"   ? ElementType::f_bar
                                               : element == "b-bar" ? ElementType::b_bar
                                                                    : ElementType::full;
        std::unique_ptr<CellKernel> kernel;
        if (material.finite_strain())
          kernel = std::make_unique<FiniteStrainKernel>(degree, type, material);
        else
          kernel = std::make_unique<SmallStrainKernel>(degree, type, material);
        const bool    recovery = material.kinematic_recovery > 0.;
        const Figures figures  = check(*kernel, degree, recovery);
        std::cout << law << ", " << element << ", degree " << degree << ", " << hardening.name
                  << ": plastic at all points " << (figures.plastic > 1e-4 ? "yes" : "NO")
                  << ", tangent from forces " << small(figures.tangent, 2e-6);
        if (recovery)
          std::cout << ", " << (figures.asymmetry > 1e-4 ? "unsymmetric" : "SYMMETRIC")
                    << ", symmetric part " << small(figures.symmetric_part, 1e-13);
        else
          std::cout << ", forces from energy " << small(figures.energy, 1e-6) << ", asymmetry "
                    << small(figures.asymmetry, 1e-14);
        // With back stress the elastic strains at the begin and the end of a step are not
        // coaxial: there the stress is that of an energy at the begin.
        const bool coaxial = material.kinematic_modulus == 0. || !material.finite_strain();
        std::cout << ", committed and again: state " << small(figures.state, 1e-9) << ", forces "
                  << small(figures.again, coaxial ? 1e-9 : 1e-3);
        if (kernel->finite_strain())
          std::cout << ", rotation " << small(figures.rotation, 1e-11) << ", det Fp - 1 "
                    << small(figures.dilatation, 1e-12);
        std::cout << std::endl;
      }
  }
} // namespace

int
main()
{
  check("small-strain von Mises", "full", 1);
  check("small-strain von Mises", "b-bar", 1);
  check("small-strain von Mises", "full", 2);
  check("finite-strain von Mises", "full", 1);
  check("finite-strain von Mises", "F-bar", 1);
  check("finite-strain von Mises", "full", 2);
  return 0;
}
