// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/stable_step.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

// The largest frequency of one-point cells in closed form (doc/explicit.md, section 4).
namespace Touchstone
{
  using namespace dealii;

  std::array<Tensor<1, dim>, Hexahedron::n_nodes>
  volume_derivative(const Hexahedron::Corners &x)
  {
    // dV/dx_a is the integral of N_a n over the faces of the cell, which are bilinear: of a face
    // the shapes times the cross product of the tangents integrate to products of 1/3 and 1/6.
    std::array<Tensor<1, dim>, Hexahedron::n_nodes> result;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int side = 0; side < 2; ++side)
        {
          const unsigned int e = (d + 1) % dim, g = (d + 2) % dim;
          const unsigned int first   = side << d;
          const unsigned int p[2][2] = {{first, first | (1U << g)},
                                        {first | (1U << e), first | (1U << e) | (1U << g)}};
          // Edges along the first tangent at both ends of the second one, and the other way round.
          const Tensor<1, dim> along[2]  = {x[p[1][0]] - x[p[0][0]], x[p[1][1]] - x[p[0][1]]};
          const Tensor<1, dim> across[2] = {x[p[0][1]] - x[p[0][0]], x[p[1][1]] - x[p[1][0]]};
          for (unsigned int i = 0; i < 2; ++i)
            for (unsigned int j = 0; j < 2; ++j)
              {
                const Tensor<1, dim> part =
                  cross_product_3d(Tensor<1, dim>(along[j] / 3. + along[1 - j] / 6.),
                                   Tensor<1, dim>(across[i] / 3. + across[1 - i] / 6.));
                result[p[i][j]] += side == 1 ? part : -part;
              }
        }
    return result;
  }



  double
  one_point_frequency(const Hexahedron::Corners     &x,
                      const MaterialParameters      &material,
                      const CellForces::NodalMasses &masses)
  {
    const auto b      = volume_derivative(x);
    double     volume = 0.;
    for (unsigned int a = 0; a < Hexahedron::n_nodes; ++a)
      volume += b[a] * x[a] / dim;
    if (!(volume > 0.))
      return 0.;
    SymmetricTensor<2, dim> G;
    for (unsigned int a = 0; a < Hexahedron::n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          G[i][j] += b[a][i] * b[a][j] / masses[a];
    return one_point_frequency(G, volume, material);
  }



  double
  one_point_frequency(const SymmetricTensor<2, dim> &G,
                      const double                   volume,
                      const MaterialParameters      &material)
  {
    if (!(volume > 0.))
      return 0.;
    const double mu = material.shear_modulus(), lambda = material.bulk_modulus() - 2. / 3. * mu;
    const auto   g = eigenvalues(G);
    SymmetricTensor<2, dim> reduced;
    for (unsigned int i = 0; i < dim; ++i)
      {
        for (unsigned int j = i; j < dim; ++j)
          reduced[i][j] = lambda * std::sqrt(std::max(0., g[i]) * std::max(0., g[j]));
        reduced[i][i] += 2. * mu * std::max(0., g[i]);
      }
    // The shear strains count where Poisson's ratio is negative. b holds the gradients times the
    // volume; eigenvalues in closed form have round-off.
    return (1. + 1e-12) * std::max(eigenvalues(reduced)[0], mu * (g[0] + g[1])) / volume;
  }
} // namespace Touchstone
