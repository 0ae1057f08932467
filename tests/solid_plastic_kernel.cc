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

  /** A cell in a step from @p committed, at the end of which it has the displacement u. */
  struct PlasticStep
  {
    PlasticStep(CellKernel &kernel, const unsigned int degree)
      : kernel(kernel)
      , finite(kernel.finite_strain())
      , n(kernel.n_dofs())
      , n_nodes(kernel.nodes_per_cell())
      , n_state(kernel.material()->n_state())
      , X(n)
      , u(n)
    {
      std::mt19937                           generator(42);
      std::uniform_real_distribution<double> random(-0.1, 0.1);
      const std::vector<Point<dim>>          unit = FE_Q<dim>(degree).get_unit_support_points();
      Array                                  first(n);
      const double                           size = finite ? 0.3 : 0.01;
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          {
            X[dim * a + d]     = (1. + 0.5 * d) * unit[a][d] + random(generator) / degree;
            first[dim * a + d] = size * (unit[a][(d + 1) % dim] + random(generator) / degree);
            u[dim * a + d]     = first[dim * a + d] +
                             size * (0.7 * unit[a][(d + 2) % dim] - 0.4 * unit[a][d] * (d == 0) +
                                     random(generator) / degree);
          }
      kernel.reinit(X.data(), first.data());
      kernel.force();
      committed = kernel.present();
      kernel.reinit(X.data(), u.data(), committed.data());
      force     = kernel.force();
      state     = kernel.present();
      matrix    = kernel.stiffness();
      symmetric = kernel.stiffness(true);
      for (const double k : matrix)
        largest = std::max(largest, std::abs(k));
      for (const double f : force)
        largest_force = std::max(largest_force, std::abs(f));
    }

    CellKernel        &kernel;
    const bool         finite;
    const unsigned int n, n_nodes, n_state;
    Array              X, u, committed, force, state, matrix, symmetric;
    double             largest = 0., largest_force = 0.;
  };



  /** All points yield before the step and in it; the tangent is symmetric, or its symmetric part
   * can be had. */
  void
  check_state_and_symmetry(const PlasticStep &step, Figures &figures)
  {
    const unsigned int n = step.n;
    for (unsigned int q = 0; q < step.kernel.n_quadrature_points(); ++q)
      figures.plastic = std::min({figures.plastic,
                                  step.committed[q * step.n_state],
                                  step.state[q * step.n_state] - step.committed[q * step.n_state]});
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          const double here = step.matrix[n * i + j], there = step.matrix[n * j + i];
          figures.asymmetry = std::max(figures.asymmetry, std::abs(here - there) / step.largest);
          figures.symmetric_part =
            std::max(figures.symmetric_part,
                     std::abs(step.symmetric[n * i + j] - 0.5 * (here + there)) / step.largest);
        }
  }



  /** Forces are the derivative of the energy, the tangent is that of the forces. */
  void
  check_derivatives(PlasticStep &step, const bool recovery, Figures &figures)
  {
    const unsigned int n = step.n;
    const double       h = step.finite ? 1e-6 : 1e-7;
    for (unsigned int j = 0; j < n; ++j)
      {
        Array  forces[2];
        double energies[2];
        for (const unsigned int side : {0, 1})
          {
            Array moved(step.u);
            moved[j] += side == 0 ? h : -h;
            step.kernel.reinit(step.X.data(), moved.data(), step.committed.data());
            energies[side] = step.kernel.energy();
            forces[side]   = step.kernel.force();
          }
        if (!recovery)
          figures.energy =
            std::max(figures.energy,
                     std::abs((energies[0] - energies[1]) / (2. * h) - step.force[j]) /
                       step.largest_force);
        for (unsigned int i = 0; i < n; ++i)
          figures.tangent =
            std::max(figures.tangent,
                     std::abs((forces[0][i] - forces[1][i]) / (2. * h) - step.matrix[n * i + j]) /
                       step.largest);
      }
  }



  /** What is committed, again. */
  void
  check_committed(PlasticStep &step, Figures &figures)
  {
    step.kernel.reinit(step.X.data(), step.u.data(), step.state.data());
    figures.again = distance(step.kernel.force(), step.force) / step.largest_force;
    figures.state = distance(step.kernel.present(), step.state);
  }



  /** A rotation over the step turns forces and stress and leaves the plastic strain alone, which
   * keeps the volume. */
  void
  check_rotation(PlasticStep &step, Figures &figures)
  {
    CellKernel &kernel = step.kernel;
    kernel.reinit(step.X.data(), step.u.data(), step.committed.data());
    std::vector<SymmetricTensor<2, dim>> stress;
    for (unsigned int q = 0; q < kernel.n_quadrature_points(); ++q)
      stress.push_back(kernel.stress(q));
    const Tensor<2, dim> Q =
      Physics::Transformations::Rotations::rotation_matrix_3d(Point<dim>(0.6, 0., 0.8), 2.);
    Array turned(step.n);
    for (unsigned int a = 0; a < step.n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        {
          turned[dim * a + i] = 5. - step.X[dim * a + i];
          for (unsigned int j = 0; j < dim; ++j)
            turned[dim * a + i] += Q[i][j] * (step.X[dim * a + j] + step.u[dim * a + j]);
        }
    kernel.reinit(step.X.data(), turned.data(), step.committed.data());
    const Array turned_force = kernel.force();
    figures.rotation         = distance(kernel.present(), step.state);
    for (unsigned int a = 0; a < step.n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        {
          double expected = 0.;
          for (unsigned int j = 0; j < dim; ++j)
            expected += Q[i][j] * step.force[dim * a + j];
          figures.rotation =
            std::max(figures.rotation,
                     std::abs(turned_force[dim * a + i] - expected) / step.largest);
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
            inverse[i][j] = step.state[q * step.n_state + 2 + dim * i + j];
        figures.dilatation = std::max(figures.dilatation, std::abs(determinant(inverse) - 1.));
      }
  }



  Figures
  check(CellKernel &kernel, const unsigned int degree, const bool recovery)
  {
    Figures     figures;
    PlasticStep step(kernel, degree);
    check_state_and_symmetry(step, figures);
    check_derivatives(step, recovery, figures);
    check_committed(step, figures);
    if (step.finite)
      check_rotation(step, figures);
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
