// SPDX-License-Identifier: LGPL-2.1-or-later
// Material laws for finite strain: stress is the derivative of the energy and
// tangent that of the stress, the undeformed state is that of linear elasticity,
// and a rotation turns the stress with it.

#include <touchstone/scene/scene.h>
#include <touchstone/solid/hyperelastic_law.h>

#include <deal.II/physics/transformations.h>

#include "mesh_common.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** The material of a scene with E = 2: keys of laws with moduli of their own. */
  MaterialParameters
  material(const std::string &law, const double nu)
  {
    const double       mu = 1. / (1. + nu);
    std::ostringstream keys;
    keys.precision(17);
    if (law == "Mooney-Rivlin")
      keys << "set C10 = " << 0.35 * mu << "\nset C01 = " << 0.15 * mu << '\n';
    else if (law == "Gent")
      keys << "set Shear modulus = " << mu << "\nset Locking stretch = 3\n";
    else if (law == "Ogden")
      keys << "set Moduli = " << 0.7 * mu << ", " << 0.1 * mu << ", " << -0.2 * mu
           << "\nset Exponents = 2, 4, -1\n";
    else
      keys << "set Young modulus = 2\n";
    keys << "set Poisson ratio = " << nu << '\n';
    return Scene("set Bodies = x\nsubsection Body x\nsubsection Geometry\nset Type = box\nend\n"
                 "subsection Material\nset Law = " +
                   law + "\n" + keys.str() + "end\nend\n",
                 "scene.prm",
                 {})
      .bodies.front()
      .material;
  }



  /** Largest deviations from central differences, relative to the largest entry. */
  void
  differences(const HyperelasticLaw &law, const Tensor<2, dim> &F, double &stress, double &tangent)
  {
    const double         h     = 1e-5;
    const Tensor<2, dim> P     = law.stress(F);
    const Tensor<4, dim> A     = law.tangent(F);
    double               scale = 0.;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        scale = std::max(scale, std::abs(A[i][j][i][j]));
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int l = 0; l < dim; ++l)
        {
          Tensor<2, dim> plus = F, minus = F;
          plus[k][l] += h;
          minus[k][l] -= h;
          stress =
            std::max(stress,
                     std::abs((law.energy(plus) - law.energy(minus)) / (2. * h) - P[k][l]) / scale);
          const Tensor<2, dim> change = (law.stress(plus) - law.stress(minus)) / (2. * h);
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              {
                tangent = std::max(tangent, std::abs(change[i][j] - A[i][j][k][l]) / scale);
                if (A[i][j][k][l] != A[k][l][i][j] &&
                    std::abs(A[i][j][k][l] - A[k][l][i][j]) > 1e-14 * scale)
                  std::cout << "the tangent is not symmetric FAILED\n";
              }
        }
  }



  void
  check(const std::string &name, const double nu)
  {
    const MaterialParameters parameters = material(name, nu);
    const auto               law        = parameters.law.make<HyperelasticRegistry>(parameters);
    const double             mu = 1. / (1. + nu), lambda = 2. * nu / ((1. + nu) * (1. - 2. * nu));
    Tensor<2, dim>           identity, F;
    for (unsigned int i = 0; i < dim; ++i)
      {
        identity[i][i] = 1.;
        for (unsigned int j = 0; j < dim; ++j)
          F[i][j] = (i == j ? 1.3 - 0.2 * i : 0.) + 0.15 * std::sin(1. + 3. * i + 7. * j);
      }

    double stress = 0., tangent = 0.;
    differences(*law, F, stress, tangent);
    differences(*law, identity, stress, tangent);

    // The undeformed state.
    const Tensor<4, dim> A     = law->tangent(identity);
    double               start = std::abs(law->energy(identity)) + law->stress(identity).norm();
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            start = std::max(start,
                             std::abs(A[i][j][k][l] - lambda * (i == j) * (k == l) -
                                      mu * ((i == k) * (j == l) + (i == l) * (j == k))) /
                               (lambda + 2. * mu));

    // Rotations, of the deformed state and alone.
    Tensor<1, dim> axis;
    axis[0] = axis[1] = 0.6;
    axis[2]           = std::sqrt(1. - 0.72);
    const Tensor<2, dim> Q =
      Physics::Transformations::Rotations::rotation_matrix_3d(Point<dim>(axis), 2.);
    const Tensor<2, dim> P       = law->stress(F);
    double               rotated = (law->stress(Q * F) - Q * P).norm() / P.norm();
    rotated = std::max(rotated, std::abs(law->energy(Q * F) / law->energy(F) - 1.));
    rotated = std::max(rotated, law->stress(Q).norm());
    // Isotropic: the same material in other axes.
    rotated = std::max(rotated, (law->stress(F * Q) - P * Q).norm() / P.norm());
    // The Cauchy stress P F^T is symmetric.
    const Tensor<2, dim> tau = P * transpose(F);
    rotated                  = std::max(rotated, (tau - transpose(tau)).norm() / tau.norm());

    std::cout << name << ", nu = " << nu << ": stress from energy " << small(stress, 1e-8)
              << ", tangent from stress " << small(tangent, 1e-8) << ", undeformed state "
              << small(start, 1e-14) << ", rotations " << small(rotated, 1e-13) << std::endl;
  }
} // namespace

int
main()
{
  for (const auto &[name, record] : HyperelasticRegistry::records())
    for (const double nu : {-0.3, 0.3, 0.49})
      check(name, nu);
  return 0;
}
