// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/vectorised.h>
#include <touchstone/explicit/cell_stiffness.h>

#include <algorithm>
#include <cmath>

// Stiffness of a cell by itself and its largest eigenvalue, for the stable step (doc/explicit.md,
// section 4).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int size = CellStiffness::n;

    /** C = A A of a symmetric matrix. */
    TOUCHSTONE_VECTORISED
    void
    square(const double *A, double *C)
    {
      for (unsigned int i = 0; i < size; ++i)
        {
          double row[size] = {};
          for (unsigned int k = 0; k < size; ++k)
            {
              const double a = A[size * i + k];
              for (unsigned int j = 0; j < size; ++j)
                row[j] += a * A[size * k + j];
            }
          std::copy(row, row + size, C + size * i);
        }
    }
  } // namespace



  CellStiffness::CellStiffness(const ElementType type, const MaterialParameters &material)
    : averaged(type == ElementType::b_bar)
    , n_modes(type == ElementType::incompatible_modes ? dim : 0)
    , stiffness(type, material, Hexahedron::n_nodes, n_modes, Hexahedron::n_points)
  {
  }



  bool
  CellStiffness::reinit(const Hexahedron::Corners &positions)
  {
    return assemble(positions, nullptr);
  }



  bool
  CellStiffness::reinit(const Hexahedron::Corners &positions, const Hexahedron::Corners &of_energy)
  {
    reference.reinit(of_energy);
    std::array<double, Hexahedron::n_points> volumes;
    for (unsigned int q = 0; q < Hexahedron::n_points; ++q)
      volumes[q] = reference.weight(q);
    return assemble(positions, &volumes);
  }



  bool
  CellStiffness::assemble(const Hexahedron::Corners                      &positions,
                          const std::array<double, Hexahedron::n_points> *volumes)
  {
    // False for what is not a number, too.
    if (!(shapes.reinit(positions) > 0.))
      return false;
    for (unsigned int q = 0; q < Hexahedron::n_points; ++q)
      {
        const double factor = std::sqrt(volumes ? (*volumes)[q] : shapes.weight(q));
        for (unsigned int i = 0; i < dim; ++i)
          {
            for (unsigned int a = 0; a < Hexahedron::n_nodes; ++a)
              stiffness.gradient(q, a, i) = factor * shapes.gradient(q, a)[i];
            for (unsigned int k = 0; k < n_modes; ++k)
              stiffness.gradient(q, Hexahedron::n_nodes + k, i) =
                factor * shapes.mode_gradient(q, k)[i];
          }
      }
    if (averaged)
      for (unsigned int a = 0; a < Hexahedron::n_nodes; ++a)
        {
          const Tensor<1, dim> mean = shapes.mean_gradient(a);
          for (unsigned int i = 0; i < dim; ++i)
            stiffness.mean_gradient(a, i) = std::sqrt(shapes.volume()) * mean[i];
        }
    stiffness.compute();
    return true;
  }



  double
  largest_eigenvalue(const std::function<double(unsigned int, unsigned int)> &entry,
                     const CellForces::NodalMasses                           &masses)
  {
    double A[size * size], B[size * size], root[NodeMap::nodes_per_cell];
    for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
      root[a] = std::sqrt(masses[a]);
    for (unsigned int i = 0; i < size; ++i)
      for (unsigned int j = 0; j < size; ++j)
        A[size * i + j] = 0.5 * (entry(i, j) + entry(j, i)) / (root[i / dim] * root[j / dim]);
    // The trace is taken out before each squaring, so that no number overflows: with A = s A', the
    // logarithm of tr(A^p)^(1/p) is the sum of log(s_k) / 2^k.
    double logarithm = 0., power = 1.;
    for (unsigned int k = 0;; ++k)
      {
        double trace = 0.;
        for (unsigned int i = 0; i < size; ++i)
          trace += A[size * i + i];
        if (!(trace > 0.))
          return trace; // no stiffness, or not a number
        logarithm += std::log(trace) / power;
        if (k == 9)
          break;
        for (double &a : A)
          a /= trace;
        square(A, B);
        std::copy(B, B + size * size, A);
        power *= 2.;
      }
    return std::exp(logarithm) * (1. + 1e-13);
  }
} // namespace Touchstone
