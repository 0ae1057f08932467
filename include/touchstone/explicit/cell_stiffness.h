// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_cell_stiffness_h
#define touchstone_explicit_cell_stiffness_h

#include <touchstone/explicit/cell_forces.h>
#include <touchstone/explicit/hexahedron.h>
#include <touchstone/solid/element_stiffness.h>

namespace Touchstone
{
  /** @brief The stiffness of single cells of isotropic elasticity, 24 x 24. */
  class CellStiffness
  {
  public:
    static constexpr unsigned int n = dim * NodeMap::nodes_per_cell;

    /** @param type full, b_bar (which stands for F-bar, too) or incompatible_modes. */
    CellStiffness(ElementType type, const MaterialParameters &material);

    /** @brief Set the cell. @return whether it is not inverted. */
    bool
    reinit(const Hexahedron::Corners &positions);
    /** @brief The same of a cell that had its energy by volume with other positions of its corners,
     * as F-bar has: a point that has become thin has gradients that are as steep, but not as little
     * to say. */
    bool
    reinit(const Hexahedron::Corners &positions, const Hexahedron::Corners &reference);

    double
    operator()(const unsigned int i, const unsigned int j) const
    {
      return stiffness(i, j);
    }

  private:
    /** Points count by these volumes. */
    bool
    assemble(const Hexahedron::Corners                      &positions,
             const std::array<double, Hexahedron::n_points> *volumes);

    const bool          averaged;
    const unsigned int  n_modes;
    Hexahedron          shapes, reference;
    ElementStiffness<1> stiffness;
  };

  /**
   * @brief An upper bound of the largest eigenvalue of M^{-1} K for a symmetric, positive
   * semidefinite K, at most 0.7 % above it.
   *
   * (tr A^p)^(1/p) with A = M^{-1/2} K M^{-1/2} and p = 512: never below the largest eigenvalue,
   * and above it by the factor k^(1/p) at most if k eigenvalues are as large. See doc/explicit.md,
   * section 4.
   * @param entry Entries of K.
   */
  double
  largest_eigenvalue(const std::function<double(unsigned int, unsigned int)> &entry,
                     const CellForces::NodalMasses                           &masses);
} // namespace Touchstone

#endif
